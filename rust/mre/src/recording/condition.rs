//! A condition of a test: coil current, temperature.

use super::{extent, mean};

/// A quantity that is not recorded, constant, or recorded sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// Not known.
    Missing,
    /// One value for the whole recording.
    Constant(f64),
    /// One value a sample.
    Series(Vec<f64>),
}

impl Condition {
    /// The constant value: given as such, or a measured series that varies by noise only
    /// (standard deviation below 0.01 plus 2 % of the mean).
    pub fn level(&self) -> Option<f64> {
        match self {
            Self::Missing => None,
            Self::Constant(value) => Some(*value),
            Self::Series(values) => {
                let mean = mean(values);
                let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
                (variance.sqrt() <= 0.01 + 0.02 * mean.abs()).then_some(mean)
            }
        }
    }

    /// One value a sample, so many of them.
    pub(crate) fn sampled(&self, samples: usize) -> Option<Vec<f64>> {
        match self {
            Self::Missing => None,
            Self::Constant(value) => Some(vec![*value; samples]),
            Self::Series(values) => Some(values.clone()),
        }
    }

    /// The smallest and the largest value, noise included.
    pub(crate) fn extent(&self) -> Option<(f64, f64)> {
        match self {
            Self::Missing => None,
            Self::Constant(value) => Some((*value, *value)),
            Self::Series(values) => Some(extent(values)),
        }
    }

    /// True where the quantity changes during the recording.
    pub fn varies(&self) -> bool {
        self.changing().is_some()
    }

    /// The samples of a quantity that changes during the recording.
    pub(crate) fn changing(&self) -> Option<&[f64]> {
        match self {
            Self::Series(values) if self.level().is_none() => Some(values),
            _ => None,
        }
    }
}
