//! Recordings weighted against each other.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::recording::{Recording, mean};

/// How recordings are weighted against each other.
#[derive(Debug, Clone, PartialEq)]
pub enum Weights {
    /// Every sample counts the same: eq. 5 over all samples.
    Samples,
    /// Every recording by the inverse of its mean squared force, so that a strong test does not drown
    /// a weak one.
    Force,
    /// The user's own, one a recording.
    Given(Vec<f64>),
}

impl Weights {
    /// Weights such that equal ones give the mean over all samples.
    pub(super) fn scaled(&self, recordings: &[Arc<Recording>]) -> Result<Vec<f64>> {
        let count = |r: &Recording| r.scored().len() as f64;
        let raw: Vec<f64> = match self {
            Self::Samples => vec![1.0; recordings.len()],
            Self::Force => recordings
                .iter()
                .map(|r| {
                    let squares: Vec<f64> =
                        r.force().unwrap_or_default()[r.scored()].iter().map(|f| f * f).collect();
                    1.0 / mean(&squares).max(f64::MIN_POSITIVE)
                })
                .collect(),
            Self::Given(given) => {
                if given.len() != recordings.len() {
                    return Err(Error::setting(
                        "weights",
                        format!("{} numbers", given.len()),
                        format!("{}, one a recording", recordings.len()),
                    ));
                }
                if let Some(bad) = given.iter().find(|w| !(w.is_finite() && **w > 0.0)) {
                    return Err(Error::setting("weight", bad, "a positive number"));
                }
                given.clone()
            }
        };
        let total: f64 = raw.iter().zip(recordings).map(|(w, r)| w * count(r)).sum();
        Ok(raw.into_iter().map(|w| w / total).collect())
    }
}
