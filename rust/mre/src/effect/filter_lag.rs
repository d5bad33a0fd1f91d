//! Filter lag: one channel is smoothed by a low-pass filter.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | T | time constant | s | 0.1 ms to 15 ms |
//! | `f_c` | corner frequency of a Butterworth filter | Hz | 10 to 2000: slower is no filter of a measurement |
//!
//! Exact for series that are linear between samples.
//! Reference: Butterworth, Wireless Engineer 7 (1930) 536.
//! Known limit: with all frequencies far below the corner it is a time delay.

use std::f64::consts::{SQRT_2, TAU};

use nalgebra::Complex;

use super::operators::lag;
use super::{About, Effect, Motion, Scene, Sizes, order_within};
use crate::parameter::Parameter;

/// Which channel is filtered, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FilterLag {
    /// The force, by a first-order lag.
    Force,
    /// The displacement, by a first-order lag.
    Displacement,
    /// The force, by a second-order Butterworth filter.
    Butterworth,
}

/// Second-order Butterworth filter, at rest at the first value.
///
/// With the pole `p = w (-1 + i)/sqrt(2)` the output is `sqrt(2) w Im z`, `z' = p z + u`.
fn butterworth(time: &[f64], input: &[f64], corner: f64) -> Vec<f64> {
    let w = TAU * corner;
    let pole = Complex::new(-w / SQRT_2, w / SQRT_2);
    let mut z = -Complex::from(input[0]) / pole;
    let mut out = vec![input[0]];
    for i in 1..input.len() {
        let h = pole * (time[i] - time[i - 1]);
        let decay = h.exp();
        // Integrals of the kernel against one and against the share of the step.
        let whole = (decay - 1.0) / pole;
        let late = (whole / (time[i] - time[i - 1]) - 1.0) / pole;
        z = z * decay + (whole - late) * input[i - 1] + late * input[i];
        out.push(SQRT_2 * w * z.im);
    }
    out
}

impl Effect for FilterLag {
    fn about(&self) -> About {
        let force = About {
            effect: "filter_lag",
            law: "force, first order",
            plain: "a low-pass filter smooths and delays the measured force",
            equation: "T dF_measured/dt + F_measured = F",
            reference: "general",
            limit: "with all frequencies far below the corner it is a time delay",
        };
        match self {
            Self::Force => force,
            Self::Displacement => About {
                law: "displacement, first order",
                plain: "a low-pass filter smooths and delays the measured displacement",
                equation: "T dx/dt + x = x_device",
                ..force
            },
            Self::Butterworth => About {
                law: "force, Butterworth",
                equation: "F_measured'' + sqrt(2) w F_measured' + w^2 F_measured = w^2 F, w = 2 pi f_c",
                reference: "Butterworth 1930",
                ..force
            },
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Force | Self::Displacement => vec![order_within("T", "s", 1e-4, 0.015)],
            Self::Butterworth => vec![order_within("f_c", "Hz", 10.0, 2000.0)],
        }
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Force | Self::Displacement => vec![vec![0.0005], vec![0.002], vec![0.008]],
            Self::Butterworth => vec![vec![15.0], vec![40.0], vec![120.0]],
        }
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let ahead =
            |series: &[f64], rate: &[f64]| series.iter().zip(rate).map(|(x, v)| x + shape[0] * v).collect();
        (*self == Self::Displacement).then(|| Motion {
            displacement: ahead(scene.displacement, scene.velocity),
            velocity: ahead(scene.velocity, scene.acceleration),
        })
    }

    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        match self {
            Self::Force => Some(lag(scene.time, force, shape[0], force[0])),
            Self::Displacement => None,
            Self::Butterworth => Some(butterworth(scene.time, force, shape[0])),
        }
    }
}
