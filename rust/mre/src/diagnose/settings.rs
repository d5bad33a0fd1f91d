//! What a diagnosis is asked.

use crate::assembly::Base;
use crate::effect::{CATALOGUE, Effect};

/// Rate of false alarms, seed, and the laws that may be named.
#[derive(Clone)]
pub struct Settings {
    /// Chance that something is named although nothing is missing.
    pub false_alarm: f64,
    /// Seed of the simulated corrections.
    pub seed: u64,
    /// Laws of the effects that are not ruled out.
    pub laws: Vec<&'static dyn Effect>,
}

impl Settings {
    /// The catalogue beside a base model, less the effects of these ids.
    pub fn new(false_alarm: f64, seed: u64, ruled_out: &[String], base: &Base) -> Self {
        let hysteretic = base.is_hysteretic();
        let open = |e: &&'static dyn Effect| {
            (hysteretic || !e.on_springs_alone()) && !ruled_out.iter().any(|id| id == e.about().effect)
        };
        Self { false_alarm, seed, laws: CATALOGUE.iter().copied().filter(open).collect() }
    }
}
