//! Candidates: every law of the catalogue is scored beside a fitted model, and the strongest are refitted
//! together with it.

use rayon::prelude::*;

use super::least_squares::{Data, Fitted, Point, refine};
use super::noise::Noise;
use super::screen::{Null, Score};
use crate::assembly::Assembly;
use crate::effect::{CATALOGUE, Effect};

/// A candidate whose score is below this share of the best is not refitted.
const PROMISING: f64 = 0.15;

/// A law with its joint fit.
#[derive(Clone)]
pub struct Candidate<'a> {
    /// The base, the effects before, and the law.
    pub assembly: Assembly<'a>,
    /// The joint fit.
    pub fitted: Fitted,
}

impl Candidate<'_> {
    /// Whitened Bayesian information criterion, up to a constant.
    pub fn criterion(&self) -> f64 {
        let parameters = self.fitted.coefficients.len() + self.fitted.unit.len();
        self.fitted.left + parameters as f64 * (self.fitted.rows as f64).ln()
    }
}

/// Time steps of the recordings, s.
pub(super) fn steps(assembly: &Assembly) -> Vec<f64> {
    assembly.campaign().recordings().iter().map(|r| 1.0 / r.sampling_rate()).collect()
}

/// Residuals in N of a fit.
pub(super) fn residuals(assembly: &Assembly, data: Data, fitted: &Fitted) -> Vec<Vec<f64>> {
    let point = Point::at(assembly, data, fitted.unit.clone());
    let recordings = assembly.campaign().recordings();
    recordings
        .iter()
        .zip(point.recordings)
        .map(|(r, local)| {
            let measured = r.force().unwrap_or_default();
            measured.iter().zip(local.force).map(|(f, model)| f - model).collect()
        })
        .collect()
}

/// The noise that a fit leaves.
pub(super) fn noise_left(assembly: &Assembly, data: Data, fitted: &Fitted) -> Noise {
    let freedom = fitted.coefficients.len() + fitted.unit.len();
    Noise::of(&residuals(assembly, data, fitted), &steps(assembly), freedom)
}

/// Scores of every law beside a fitted model.
pub(super) fn scores(assembly: &Assembly, data: Data, unit: &[f64], seed: u64) -> Vec<Score> {
    let Some(null) = Null::new(assembly, data, unit) else { return Vec::new() };
    let named = |e: &&'static dyn Effect| {
        assembly.effects().iter().any(|known| known.about().effect == e.about().effect)
    };
    let laws: Vec<&'static dyn Effect> = CATALOGUE.iter().copied().filter(|e| !named(e)).collect();
    laws.into_par_iter().enumerate().filter_map(|(i, e)| null.score(e, seed ^ i as u64)).collect()
}

/// p-value of every effect: the smallest over its laws, times their number.
pub(super) fn by_effect(scores: &[Score]) -> Vec<(&'static str, f64)> {
    let mut found: Vec<(&'static str, f64, usize)> = Vec::new();
    for score in scores {
        let id = score.effect.about().effect;
        match found.iter_mut().find(|(known, ..)| *known == id) {
            Some((_, p, count)) => (*p, *count) = (p.min(score.p_value), *count + 1),
            None => found.push((id, score.p_value, 1)),
        }
    }
    found.into_iter().map(|(id, p, count)| (id, (p * count as f64).min(1.0))).collect()
}

/// The laws that are worth a joint fit, strongest first.
fn promising(scores: &[Score], most: usize) -> Vec<&Score> {
    let mut sorted: Vec<&Score> = scores.iter().filter(|s| s.gain > 0.0).collect();
    sorted.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    let best = sorted.first().map_or(0.0, |s| s.gain);
    sorted.retain(|s| s.gain >= PROMISING * best);
    sorted.truncate(most);
    sorted
}

/// Joint fit of a model with one more law, from the law's strongest start.
pub(super) fn joint<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    effect: &'static dyn Effect,
    start: &[f64],
) -> Candidate<'a> {
    let mut effects = assembly.effects().to_vec();
    effects.push(effect);
    let wider = assembly.with(effects);
    let mut shapes = assembly.physical(unit);
    shapes.extend_from_slice(start);
    let fitted = refine(&wider, data, &wider.unit(&shapes));
    Candidate { assembly: wider, fitted }
}

/// Joint fits of the most promising laws, best first.
pub(super) fn candidates<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    scores: &[Score],
    most: usize,
) -> Vec<Candidate<'a>> {
    let mut found: Vec<Candidate> = promising(scores, most)
        .into_par_iter()
        .map(|score| joint(assembly, data, unit, score.effect, &score.start))
        .collect();
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    found
}
