//! Naming: which effects, added to the base and refitted together with it, explain the recordings.
//!
//! Forward: every law of the catalogue is scored, the strongest are refitted jointly, and the one with the
//! lowest whitened BIC enters if its effect's p-value passes Holm's threshold (Holm 1979). Then the noise is
//! estimated anew from what is left. Backward: an effect that the others make unnecessary leaves.

use rayon::prelude::*;

use super::least_squares::{Data, Fitted, Point, refine};
use super::noise::Noise;
use super::normal::Rows;
use super::screen::{Null, Score};
use crate::assembly::Assembly;
use crate::effect::{CATALOGUE, Effect};

/// Most effects that are named.
const MOST: usize = 4;
/// Candidates that are refitted jointly at each step.
const REFITTED: usize = 12;
/// A candidate whose score is below this share of the best is not refitted.
const PROMISING: f64 = 0.15;

/// A model with its fit and the noise that it leaves.
#[derive(Clone)]
pub struct Named<'a> {
    /// The base and the effects named.
    pub assembly: Assembly<'a>,
    /// Its fit.
    pub fitted: Fitted,
    /// Noise of the recordings.
    pub noise: Noise,
    /// What the last scores found, for each law.
    pub scores: Vec<Score>,
    /// Joint fits of each step, best first.
    pub steps: Vec<Vec<Candidate<'a>>>,
}

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
        assembly.effects().iter().any(|known| known.about() == e.about())
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
    let mut sorted: Vec<&Score> = scores.iter().collect();
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
) -> Vec<Candidate<'a>> {
    let mut found: Vec<Candidate> = promising(scores, REFITTED)
        .into_par_iter()
        .map(|score| joint(assembly, data, unit, score.effect, &score.start))
        .collect();
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    found
}

/// Name the effects that the recordings show at a false-alarm rate.
pub fn name<'a>(
    base: &Assembly<'a>,
    rows: &[Rows],
    first: (&Noise, &Fitted),
    false_alarm: f64,
    seed: u64,
) -> Named<'a> {
    let mut noise = first.0.clone();
    let mut assembly = base.clone();
    let mut fitted = first.1.clone();
    let (mut found, mut steps) = (Vec::new(), Vec::new());
    for step in 0..=MOST {
        // Twice: with the noise as it was, and with the noise that the best candidate leaves.
        let mut best = None;
        for _ in 0..2 {
            let data = Data { noise: &noise, rows };
            fitted = refine(&assembly, data, &fitted.unit);
            found = scores(&assembly, data, &fitted.unit, seed);
            let tried = candidates(&assembly, data, &fitted.unit, &found);
            best = tried.first().cloned();
            steps.truncate(step);
            steps.push(tried);
            if let Some(best) = &best {
                noise = noise_left(&best.assembly, data, &best.fitted);
            }
        }
        let data = Data { noise: &noise, rows };
        fitted = refine(&assembly, data, &fitted.unit);
        let effects = by_effect(&found);
        let significant = effects.iter().any(|(_, p)| p * effects.len() as f64 <= false_alarm);
        let Some(best) = best.filter(|_| significant && step < MOST) else { break };
        let next = refine(&best.assembly, data, &best.fitted.unit);
        (assembly, fitted) = (best.assembly, next);
    }
    Named { assembly, fitted, noise, scores: found, steps }
}
