//! Force drift: the zero of the load cell wanders, or is off from the start.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | D, `D_0`, `D_k` | drift throughout, over the longest recording, in the end, at first, or of a half cosine | N | any, in each recording |
//! | `tau_d` | time over which it settles | s | 3 % to 200 % of the longest recording |
//!
//! Of the measurement, not of the device: a simulation leaves it out.
//! Known limit: under a mean displacement it cannot be told from creep.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use super::{About, Effect, Scene, Sizes, ideal_above, order_within, signed};
use crate::parameter::Parameter;

/// Half-cosines over a recording that make a drift.
pub(crate) const DRIFT: RangeInclusive<usize> = 1..=3;
/// The mean as a half-cosine.
pub(crate) const MEAN: RangeInclusive<usize> = 0..=0;

/// Form of the drift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Drift {
    /// The same throughout a recording.
    Constant,
    /// In proportion to the time.
    Linear,
    /// In proportion to the time, from a zero that is off.
    Offset,
    /// Settling.
    Decaying,
    /// Three half cosines over the recording.
    Slow,
}

impl Effect for Drift {
    fn about(&self) -> About {
        let linear = About {
            effect: "force_drift",
            law: "linear",
            plain: "the zero of the measured force drifts with time",
            equation: "F_measured = F + D t/T",
            reference: "general",
            limit: "under a mean displacement it cannot be told from creep",
        };
        match self {
            Self::Constant => About {
                law: "constant",
                plain: "the zero of the measured force is off",
                equation: "F_measured = F + D",
                limit: "a force that the device exerts at rest is the same",
                ..linear
            },
            Self::Linear => linear,
            Self::Offset => About {
                law: "linear from an offset",
                plain: "the zero of the measured force is off and drifts with time",
                equation: "F_measured = F + D_0 + D t/T",
                ..linear
            },
            Self::Decaying => {
                About { law: "settling", equation: "F_measured = F + D (1 - exp(-t/tau_d))", ..linear }
            }
            Self::Slow => About {
                law: "slow wander",
                equation: "F_measured = F + sum_k D_k cos(pi k t/T), k = 1 to 3",
                ..linear
            },
        }
    }

    fn slow(&self) -> Option<RangeInclusive<usize>> {
        Some(if matches!(self, Self::Constant) { MEAN } else { DRIFT })
    }

    fn of_the_measurement(&self) -> bool {
        true
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Constant | Self::Linear | Self::Decaying => vec![signed("D", "N")],
            Self::Offset => vec![signed("D_0", "N"), signed("D", "N")],
            Self::Slow => DRIFT.map(|k| signed(&format!("D_{k}"), "N")).collect(),
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Decaying => {
                vec![ideal_above(order_within("tau_d", "s", 0.03 * sizes.duration, 2.0 * sizes.duration))]
            }
            Self::Constant | Self::Linear | Self::Offset | Self::Slow => Vec::new(),
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Decaying => [0.05, 0.15, 0.5].iter().map(|share| vec![share * sizes.duration]).collect(),
            Self::Constant | Self::Linear | Self::Offset | Self::Slow => vec![Vec::new()],
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let column =
            |value: &dyn Fn(f64) -> f64| scene.time.iter().map(|t| value(t - scene.time[0])).collect();
        match self {
            Self::Constant => vec![column(&|_| 1.0)],
            Self::Linear => vec![column(&|t| t / scene.sizes.duration)],
            Self::Offset => vec![column(&|_| 1.0), column(&|t| t / scene.sizes.duration)],
            Self::Decaying => vec![column(&|t| -(-t / shape[0]).exp_m1())],
            Self::Slow => {
                let turn = PI / scene.duration();
                DRIFT.map(|k| column(&|t| (turn * k as f64 * t).cos())).collect()
            }
        }
    }
}
