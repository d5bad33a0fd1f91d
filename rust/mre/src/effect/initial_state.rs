//! Initial state: a recording that starts in motion starts with unknown states of everything with memory.
//!
//! No effect of the catalogue, but a part of the model of such a recording: what is left of the unknown
//! states decays, here as a sum of exponentials with free coefficients in every recording.

use super::{About, Effect, Scene, Sizes, orders, signed};
use crate::parameter::Parameter;
use crate::recording::Recording;

/// Number of decay times, evenly in the logarithm: enough that a springpot's memory of a cycle is a sum of them.
const DECAYS: usize = 8;
/// A recording starts at rest where its first speed and displacement are below this share of its largest.
const REST: f64 = 0.05;

/// Decaying remainders of unknown initial states.
#[derive(Debug, Clone, Copy)]
pub struct InitialState;

/// True where a recording starts in motion or away from its middle.
pub fn starts_in_motion(recording: &Recording) -> bool {
    in_motion(recording.displacement(), recording.velocity())
}

pub(super) fn in_motion(x: &[f64], v: &[f64]) -> bool {
    let share = |series: &[f64], first: f64| {
        let far = series.iter().fold(0.0_f64, |far, v| far.max(v.abs()));
        first.abs() > REST * far
    };
    share(x, x[0]) || share(v, v[0])
}

impl Effect for InitialState {
    fn about(&self) -> About {
        About {
            effect: "initial_state",
            law: "decaying",
            plain: "the recording starts in motion, with unknown internal states",
            equation: "F += sum_i a_i exp(-t/t_i)",
            reference: "general",
            limit: "slow decays are drift",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        (1..=DECAYS).map(|i| signed(&format!("a_{i}"), "N")).collect()
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        if !in_motion(scene.displacement, scene.velocity) {
            return vec![vec![0.0; scene.len()]; DECAYS]; // its states are those of rest
        }
        let start = scene.time[0];
        let times = orders(0.5 * scene.sizes.step, scene.sizes.duration / 3.0, DECAYS);
        times.iter().map(|d| scene.time.iter().map(|t| (-(t - start) / d).exp()).collect()).collect()
    }

    fn known_of_coefficients(&self, sizes: &Sizes) -> f64 {
        // No remainder is larger than the force.
        sizes.force.powi(-2)
    }

    fn of_the_measurement(&self) -> bool {
        true
    }
}
