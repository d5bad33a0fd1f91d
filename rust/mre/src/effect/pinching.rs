//! Pinching: the loop is narrow near the middle, where cracks close or a clearance is crossed.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost in the middle | - | 0 to 0.95 |
//! | w | half width of the middle | mm | 5 % to 60 % of the largest stroke |
//! | `x_s` | displacement past the middle, in the direction of motion, where most is lost | mm | 0 to 50 % |
//!
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411, eq. for h(z), with x in place of z.
//! Known limit: on the stiffness and without a shift it is an odd elastic law.

use super::operators::sign;
use super::{About, Effect, Factors, Scene, Sizes, ideal_above, ideal_below, order_within, within};
use crate::parameter::Parameter;

/// A law of pinching.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pinching {
    /// True where the middle is shifted in the direction of motion.
    pub(super) shifted: bool,
    /// True where damping is pinched like stiffness.
    pub(super) whole: bool,
}

impl Effect for Pinching {
    fn about(&self) -> About {
        About {
            effect: "pinching",
            law: match (self.shifted, self.whole) {
                (false, false) => "centred, stiffness",
                (false, true) => "centred, whole force",
                (true, false) => "shifted, stiffness",
                (true, true) => "shifted, whole force",
            },
            plain: "the loop is pinched near the middle position",
            equation: if self.shifted {
                "k -> k (1 - s exp(-((x - x_s sgn v)/w)^2))"
            } else {
                "k -> k (1 - s exp(-(x/w)^2))"
            },
            reference: "Baber and Noori 1986",
            limit: "on the stiffness and without a shift it is an odd elastic law",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let mut shape =
            vec![ideal_above(within("s", "", 0.0, 0.95)), order_within("w", "mm", 0.05 * x, 0.6 * x)];
        if self.shifted {
            shape.push(ideal_below(within("x_s", "mm", 0.0, 0.5 * x)));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        let widths = [0.08, 0.17, 0.35];
        if self.shifted {
            widths.iter().flat_map(|w| [0.1, 0.3].map(|shift| vec![0.3, w * x, shift * x])).collect()
        } else {
            widths.iter().map(|w| vec![0.3, w * x]).collect()
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let shift = if self.shifted { shape[2] } else { 0.0 };
        let middle = |(x, v): (&f64, &f64)| (-((x - shift * sign(*v)) / shape[1]).powi(2)).exp();
        let lost: Vec<f64> = scene.displacement.iter().zip(scene.velocity).map(middle).collect();
        Some(Factors::losing(shape[0], &lost, self.whole))
    }
}
