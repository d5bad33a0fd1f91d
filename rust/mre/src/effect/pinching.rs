//! Pinching: the loop is narrow near the middle, where cracks close or a clearance is crossed.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost in the middle | - | 0 to 0.95 |
//! | w | half width of the middle | mm | 5 % to 60 % of the largest stroke |
//! | p | sharpness of its edges | - | 0.7 to 8 |
//! | `x_s` | displacement past the middle, in the direction of motion, where most is lost | mm | 0 to 50 % |
//!
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411, eq. for h(z), with x in place of z.
//! Known limit: on the stiffness and without a shift it is an odd elastic law.

use super::operators::sign;
use super::{About, Effect, Factors, Scene, Sizes, ideal_above, ideal_below, order_within, within};
use crate::parameter::Parameter;

/// Half widths from which a fit starts, as shares of the largest stroke.
const WIDTHS: [f64; 3] = [0.08, 0.17, 0.35];

/// Where most is lost, and how little beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Middle {
    /// In the middle, by a normal curve.
    Centred,
    /// Past the middle, in the direction of motion.
    Shifted,
    /// In the middle, with sharp edges or none.
    Edged,
    /// In the middle, and far beside it.
    Wide,
}

/// A law of pinching.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pinching {
    /// Where.
    pub(super) at: Middle,
    /// True where damping is pinched like stiffness.
    pub(super) whole: bool,
}

impl Effect for Pinching {
    fn about(&self) -> About {
        let (laws, equation) = match self.at {
            Middle::Centred => {
                (["centred, stiffness", "centred, whole force"], "k -> k (1 - s exp(-(x/w)^2))")
            }
            Middle::Shifted => {
                (["shifted, stiffness", "shifted, whole force"], "k -> k (1 - s exp(-((x - x_s sgn v)/w)^2))")
            }
            Middle::Edged => (["edged, stiffness", "edged, whole force"], "k -> k (1 - s exp(-|x/w|^p))"),
            Middle::Wide => (["wide, stiffness", "wide, whole force"], "k -> k (1 - s/(1 + (x/w)^2))"),
        };
        About {
            effect: "pinching",
            law: laws[usize::from(self.whole)],
            plain: "the loop is pinched near the middle position",
            equation,
            reference: "Baber and Noori 1986",
            limit: "on the stiffness and without a shift it is an odd elastic law",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let own = match self.at {
            Middle::Centred | Middle::Wide => None,
            Middle::Shifted => Some(ideal_below(within("x_s", "mm", 0.0, 0.5 * x))),
            Middle::Edged => Some(within("p", "", 0.7, 8.0)),
        };
        let s = ideal_above(within("s", "", 0.0, 0.95));
        [s, order_within("w", "mm", 0.05 * x, 0.6 * x)].into_iter().chain(own).collect()
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        let with = |own: [f64; 2]| {
            WIDTHS.iter().flat_map(|w| own.map(|own| vec![0.3, w * x, own])).collect::<Vec<_>>()
        };
        match self.at {
            Middle::Centred | Middle::Wide => WIDTHS.iter().map(|w| vec![0.3, w * x]).collect(),
            Middle::Shifted => with([0.1 * x, 0.3 * x]),
            Middle::Edged => with([1.0, 5.0]),
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let middle = |(x, v): (&f64, &f64)| match self.at {
            Middle::Centred => (-(x / shape[1]).powi(2)).exp(),
            Middle::Shifted => (-((x - shape[2] * sign(*v)) / shape[1]).powi(2)).exp(),
            Middle::Edged => (-(x / shape[1]).abs().powf(shape[2])).exp(),
            Middle::Wide => 1.0 / (1.0 + (x / shape[1]).powi(2)),
        };
        let lost: Vec<f64> = scene.displacement.iter().zip(scene.velocity).map(middle).collect();
        Some(Factors::losing(shape[0], &lost, self.whole))
    }
}
