//! Initial hysteretic variable: where a recording starts in motion, that of the base has an unknown value there.
//!
//! What is left of it fades with the way and not with the time, and stands still where the motion turns: no sum of a few
//! exponentials. Its columns are the differences between variables that start elsewhere and one from rest, at what is known of
//! the base; between them what starts anywhere is nearly a sum of them.

use super::{About, Effect, Scene, Sizes, signed};
use crate::parameter::Parameter;

/// Normalised variables at the first sample whose remainders are the columns.
pub(crate) const STARTS: [f64; 4] = [-1.0, -0.5, 0.5, 1.0];

/// Fading remainders of an unknown hysteretic variable.
#[derive(Debug, Clone, Copy)]
pub struct InitialHysteresis;

impl Effect for InitialHysteresis {
    fn about(&self) -> About {
        About {
            effect: "initial_state",
            law: "hysteretic",
            plain: "the recording starts in motion, with an unknown hysteretic variable",
            equation: "F += sum_i a_i (w(t; w_i) - w(t; 0))",
            reference: "general",
            limit: "variables that start between those of the columns",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        (1..=STARTS.len()).map(|i| signed(&format!("a_{i}"), "N")).collect()
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        if scene.fading.is_empty() {
            vec![vec![0.0; scene.len()]; STARTS.len()]
        } else {
            scene.fading.to_vec()
        }
    }

    fn known_of_coefficients(&self, sizes: &Sizes) -> f64 {
        // No remainder is larger than the force.
        sizes.force.powi(-2)
    }

    fn of_the_measurement(&self) -> bool {
        true
    }
}
