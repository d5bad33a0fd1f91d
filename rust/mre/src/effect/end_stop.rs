//! End stop: beyond a gap the device meets a second, stiff spring.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_c` | stiffness of the stop | N/mm, or N/mm^1.5 for Hertz contact | >= 0 |
//! | g | gap | mm | 30 % to 99.5 % of the largest stroke |
//!
//! Reference: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440.
//! Known limit: with few samples past the gap it is a stiffening spring.

use super::operators::each;
use super::{About, Effect, Scene, Sizes, positive, within};
use crate::parameter::Parameter;

/// Where the stop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EndStop {
    /// At both ends.
    Both,
    /// At the positive end.
    Positive,
    /// At the negative end.
    Negative,
    /// At both ends, round.
    Hertz,
}

impl Effect for EndStop {
    fn about(&self) -> About {
        let both = About {
            effect: "end_stop",
            law: "both ends",
            plain: "near its largest displacement the device runs into a stop",
            equation: "F_s = k_c max(|x| - g, 0) sgn x",
            reference: "Hunt and Crossley 1975",
            limit: "with few samples past the gap it is a stiffening spring",
        };
        match self {
            Self::Both => both,
            Self::Positive => About { law: "positive end", equation: "F_s = k_c max(x - g, 0)", ..both },
            Self::Negative => About { law: "negative end", equation: "F_s = -k_c max(-x - g, 0)", ..both },
            Self::Hertz => About {
                law: "Hertz contact",
                equation: "F_s = k_c max(|x| - g, 0)^1.5 sgn x",
                reference: "Hertz 1882; Hunt and Crossley 1975",
                ..both
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_c", if *self == Self::Hertz { "N/mm^1.5" } else { "N/mm" })]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![within("g", "mm", 0.3 * sizes.displacement, 0.995 * sizes.displacement)]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        [0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.975]
            .iter()
            .map(|share| vec![share * sizes.displacement])
            .collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let g = shape[0];
        vec![each(scene.displacement, |x| match self {
            Self::Both => (x.abs() - g).max(0.0) * x.signum(),
            Self::Positive => (x - g).max(0.0),
            Self::Negative => (x + g).min(0.0),
            Self::Hertz => (x.abs() - g).max(0.0).powf(1.5) * x.signum(),
        })]
    }
}
