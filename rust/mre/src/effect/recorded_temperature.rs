//! Thermal softening over the temperature that was recorded: of the room, or of the device itself.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s, `s_c` | share that is lost at the highest temperature, of the stiffness and of the damping | - | 0 to 0.95 |
//! | the same | of an exponential law: its logarithm | - | 0 to 3 |
//!
//! Reference: Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley 1980.
//! Known limit: a temperature that only rises is wear, one that follows the dissipation is heat of its own.

use super::{About, Effect, Factors, Scene, Sizes, within};
use crate::parameter::Parameter;

/// Least span of a temperature, K: less may be a thermometer's noise.
const LEAST_SPAN: f64 = 1.0;

/// What is softer where it is warmer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Softer {
    /// What stores energy.
    Stiffness,
    /// The whole force.
    Whole,
    /// Stiffness and damping, each by a share of its own.
    Each,
}

/// Softening over the temperature that was recorded.
#[derive(Debug, Clone, Copy)]
pub(super) struct RecordedTemperature {
    /// What is softer.
    pub(super) softer: Softer,
    /// True for an exponential law, false for a linear one.
    pub(super) exponential: bool,
}

/// The temperature, from 0 at the lowest to 1 at the highest; 0 where none is known.
fn warmth(scene: &Scene) -> Vec<f64> {
    match (scene.temperature, scene.sizes.temperature) {
        (Some(temperature), Some((low, high))) if high > low => {
            temperature.iter().map(|t| (t - low) / (high - low)).collect()
        }
        _ => vec![0.0; scene.len()],
    }
}

impl RecordedTemperature {
    fn softened(self, warmth: &[f64], share: f64) -> Factors {
        let whole = self.softer == Softer::Whole;
        if self.exponential {
            Factors::kept(warmth.iter().map(|u| (-share * u).exp()).collect(), whole)
        } else {
            Factors::losing(share, warmth, whole)
        }
    }
}

impl Effect for RecordedTemperature {
    fn about(&self) -> About {
        let (law, equation) = match (self.softer, self.exponential) {
            (Softer::Stiffness, false) => {
                ("recorded temperature, stiffness", "k -> k (1 - s u), u = (T - T_low)/(T_high - T_low)")
            }
            (Softer::Whole, false) => {
                ("recorded temperature, whole force", "F -> F (1 - s u), u = (T - T_low)/(T_high - T_low)")
            }
            (Softer::Each, false) => (
                "recorded temperature, each its own",
                "k -> k (1 - s u), c -> c (1 - s_c u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Stiffness, true) => (
                "recorded temperature, exponential, stiffness",
                "k -> k exp(-s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Whole, true) => (
                "recorded temperature, exponential, whole force",
                "F -> F exp(-s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Each, true) => (
                "recorded temperature, exponential, each its own",
                "k -> k exp(-s u), c -> c exp(-s_c u), u = (T - T_low)/(T_high - T_low)",
            ),
        };
        About {
            effect: "thermal_softening",
            law,
            plain: "the device is softer where the temperature that was recorded is higher",
            equation,
            reference: "Ferry 1980",
            limit: "a recorded temperature that only rises is cyclic degradation",
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.temperature.is_some_and(|(low, high)| high - low >= LEAST_SPAN)
    }

    fn feels_temperature(&self) -> bool {
        true
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        let share = |name| within(name, "", 0.0, if self.exponential { 3.0 } else { 0.95 });
        let mut shape = vec![share("s")];
        if self.softer == Softer::Each {
            shape.push(share("s_c"));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let count = self.shape(sizes).len();
        [0.1, 0.5].map(|share| vec![share; count]).to_vec()
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let warmth = warmth(scene);
        let factors = self.softened(&warmth, shape[0]);
        Some(match self.softer {
            Softer::Each => {
                let damping = Some(self.softened(&warmth, shape[1]).stiffness);
                Factors { damping, ..factors }
            }
            Softer::Stiffness | Softer::Whole => factors,
        })
    }
}
