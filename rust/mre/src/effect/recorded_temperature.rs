//! Thermal softening over the temperature that was recorded: of the room, or of the device itself.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the highest temperature | - | 0 to 0.95, of an exponential law its logarithm: 0 to 3 |
//! | r | the same of the damping, over that of the stiffness | - | 0 to 10 |
//!
//! Reference: Ferry, Viscoelastic Properties of Polymers, 3rd ed., Wiley 1980.
//! Known limit: a temperature that only rises is wear, one that follows the dissipation is heat of its own.

use super::{About, Effect, Factors, Scene, Sizes, within};
use crate::parameter::Parameter;

/// Least span of a temperature, K: less may be a thermometer's noise.
const LEAST_SPAN: f64 = 1.0;
/// Most that the damping loses, over what the stiffness does.
const MOST: f64 = 10.0;

/// What is softer where it is warmer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Softer {
    /// What stores energy.
    Stiffness,
    /// The whole force.
    Whole,
    /// What is viscous.
    Damping,
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
            (Softer::Damping, false) => {
                ("recorded temperature, damping", "c -> c (1 - s u), u = (T - T_low)/(T_high - T_low)")
            }
            (Softer::Each, false) => (
                "recorded temperature, damping by a share of its own",
                "k -> k (1 - s u), c -> c (1 - r s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Stiffness, true) => (
                "recorded temperature, exponential, stiffness",
                "k -> k exp(-s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Whole, true) => (
                "recorded temperature, exponential, whole force",
                "F -> F exp(-s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Damping, true) => (
                "recorded temperature, exponential, damping",
                "c -> c exp(-s u), u = (T - T_low)/(T_high - T_low)",
            ),
            (Softer::Each, true) => (
                "recorded temperature, exponential, damping by a share of its own",
                "k -> k exp(-s u), c -> c exp(-r s u), u = (T - T_low)/(T_high - T_low)",
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
        let mut shape = vec![within("s", "", 0.0, if self.exponential { 3.0 } else { 0.95 })];
        if self.softer == Softer::Each {
            shape.push(within("r", "", 0.0, MOST));
        }
        shape
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        match self.softer {
            Softer::Each => vec![vec![0.1, 2.0], vec![0.5, 1.5]],
            Softer::Stiffness | Softer::Whole | Softer::Damping => vec![vec![0.1], vec![0.5]],
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let warmth = warmth(scene);
        let factors = self.softened(&warmth, shape[0]);
        Some(match self.softer {
            Softer::Stiffness | Softer::Whole => factors,
            Softer::Damping => factors.of_damping(),
            Softer::Each => {
                let damping = Some(self.softened(&warmth, shape[0] * shape[1]).stiffness);
                Factors { damping, ..factors }
            }
        })
    }
}
