//! What a diagnosis is asked.

use super::next_test::GivenLimits;
use crate::assembly::Base;
use crate::effect::{CATALOGUE, Effect};

/// Rate of false alarms, seed, the laws that may be named, and the limits of a test that is proposed.
#[derive(Clone)]
pub struct Settings {
    /// Chance that something is named although nothing is missing.
    pub false_alarm: f64,
    /// Seed of the simulated corrections.
    pub seed: u64,
    /// Laws of the effects that are not ruled out.
    pub laws: Vec<&'static dyn Effect>,
    /// Limits of the next test.
    pub limits: GivenLimits,
}

impl Settings {
    /// The catalogue beside a base model, less the effects of these ids.
    pub fn new(false_alarm: f64, seed: u64, ruled_out: &[String], base: &Base) -> Self {
        let hysteretic = base.is_hysteretic();
        let open = |e: &&'static dyn Effect| {
            (hysteretic || !e.on_a_part()) && !ruled_out.iter().any(|id| id == e.about().effect)
        };
        let laws = CATALOGUE.iter().copied().filter(open).collect();
        Self { false_alarm, seed, laws, limits: GivenLimits::default() }
    }
}
