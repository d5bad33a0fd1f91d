//! What a diagnosis found.

use super::absorbed::Absorbed;
use super::intervals::{Estimate, Estimates};
use super::locate::Finding;
use super::next_test::NextTest;
use super::prove::Proof;
use super::refitted::Refitted;
use super::search::Named;
use super::unknown::Unknown;
use super::verdict::{Evidence, Verdict};

/// An effect that was named.
#[derive(Debug, Clone)]
pub struct Effect {
    /// Its place in the model.
    pub place: usize,
    /// p-value with which it entered.
    pub p_value: f64,
    /// What it does for held-out data; `None` where the diagnosis was broken off before.
    pub held_out: Option<HeldOut>,
    /// Ids of effects that the recordings cannot tell from it.
    pub rivals: Vec<&'static str>,
}

/// Held-out rms of a model without and with one of its effects, the others in place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// Without it, N.
    pub before: f64,
    /// With it, N.
    pub after: f64,
}

/// What the tests beside the final model say.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judgement {
    /// Verdict.
    pub verdict: Verdict,
    /// What is left beside the final model.
    pub evidence: Evidence,
    /// Rms of the noise, N.
    pub noise_rms: f64,
}

/// What a diagnosis found. Where it was broken off, what was not reached is empty.
pub struct Diagnosis<'a> {
    /// The base as fitted alone.
    pub base: Named<'a>,
    /// The base with the effects named, fitted together on everything.
    pub named: Named<'a>,
    /// The verdict.
    pub judgement: Option<Judgement>,
    /// The effects, by how much each improves the held-out fit.
    pub effects: Vec<Effect>,
    /// What an unexplained mismatch depends on.
    pub unknown: Option<Unknown>,
    /// Ids of effects that came nearest to an unexplained mismatch, and are not trusted.
    pub nearest: Vec<&'static str>,
    /// What is off of a base that was kept, where that explains as much as the effects.
    pub off: Vec<Estimate>,
    /// What a base that was kept would leave with fitted parameters.
    pub refitted: Option<Refitted>,
    /// The excitation that would best resolve what is in doubt.
    pub next_test: Option<NextTest>,
    /// Effects that the recordings would hide.
    pub absorbed: Vec<Absorbed>,
    /// Where the base model misses.
    pub places: Vec<Finding>,
    /// Parameters of the base alone.
    pub base_estimates: Estimates,
    /// Parameters of the final model.
    pub estimates: Estimates,
    /// The base alone and the final model on training and held-out samples.
    pub proofs: Option<(Proof, Proof)>,
    /// Force of the base model in N, by recording.
    pub base_force: Vec<Vec<f64>>,
    /// Force of the final model.
    pub final_force: Vec<Vec<f64>>,
    /// True where it was broken off.
    pub broken_off: bool,
}
