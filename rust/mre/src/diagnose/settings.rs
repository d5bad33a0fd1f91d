//! What a diagnosis is asked.

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
    /// The catalogue less the effects of these ids.
    pub fn new(false_alarm: f64, seed: u64, ruled_out: &[String]) -> Self {
        let open = |e: &&'static dyn Effect| !ruled_out.iter().any(|id| id == e.about().effect);
        Self { false_alarm, seed, laws: CATALOGUE.iter().copied().filter(open).collect() }
    }
}
