//! A loose spring: one beside the device has free play, and the device has none.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | g | half the free play | mm | 0 to 0.3 of the largest stroke: a wider one is an end stop |
//! | `k_g` | stiffness beyond it | N/mm | >= 0 |
//!
//! Reference: Nordin and Gutman, Automatica 38 (2002) 1633.
//! Known limit: where g is small against all strokes it is part of the stiffness and a faint kink.

use super::backlash::{Backlash, beyond};
use super::operators::each;
use super::{About, Effect, Scene, Sizes, positive, within};
use crate::parameter::Parameter;

/// A spring with a dead zone.
#[derive(Debug, Clone, Copy)]
pub(super) struct LooseSpring;

impl Effect for LooseSpring {
    fn about(&self) -> About {
        About {
            law: "spring with a dead zone",
            plain: "there is free play: near the middle a part of the stiffness is missing",
            equation: "F_g = k_g (x - min(max(x, -g), g))",
            ..Backlash::DeadZone.about()
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_g", "N/mm")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![Parameter { smallest: 0.0, ..within("g", "mm", 0.0, 0.3 * sizes.displacement) }]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        [0.003, 0.01, 0.03, 0.07, 0.13, 0.22].map(|share| vec![share * sizes.displacement]).to_vec()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![each(scene.displacement, |x| beyond(x, shape[0]))]
    }
}
