//! Naming: which effects, added to the base and refitted together with it, explain the recordings.
//!
//! The law with the lowest whitened BIC enters if its effect's p-value passes Holm's threshold (Holm 1979).
//! Then other laws of the effects already named are tried in their place, and the noise is estimated anew
//! from the best model so far. A further effect enters only if it also helps on data that took no part. Pairs
//! are searched from several firsts, because the best single effect may be neither of two; at the end an
//! effect that the others make unnecessary leaves.

use rayon::prelude::*;

use super::begin::Begun;
use super::candidates::{Candidate, by_effect, candidates, fit, joint, noise_left, residuals, scores};
use super::least_squares::{Data, Fitted};
use super::noise::Noise;
use super::normal::Rows;
use super::prove::{Split, prove};
use super::screen::Score;
use super::settings::Settings;
use crate::assembly::Assembly;
use crate::effect::Effect;

/// Most effects that are named.
const MOST: usize = 4;
/// Candidates that are refitted jointly.
pub(super) const REFITTED: usize = 8;
/// The same where only the best is wanted, roughly.
const FEW: usize = 3;
/// Effects after the best that are tried where that fails.
const LATER: usize = 3;
/// Candidates for the first of a pair.
const FIRSTS: usize = 5;
/// A further effect lowers the held-out rms by more than this share of the noise's rms.
const LEAST_OF_NOISE: f64 = 0.1;
/// And by more than this share of what the first one lowered it.
const LEAST_OF_FIRST: f64 = 0.2;
/// Advantage in the criterion that counts.
const CLEAR: f64 = 10.0;

/// A model with its fit and the noise that it leaves.
#[derive(Clone)]
pub struct Named<'a> {
    /// The base and the effects named.
    pub assembly: Assembly<'a>,
    /// Its fit.
    pub fitted: Fitted,
    /// Noise of the recordings, after the best model that was tried.
    pub noise: Noise,
    /// What the scores beside this model found, for each law.
    pub scores: Vec<Score>,
    /// The best candidate beside this model, whether it is significant or not.
    pub next: Option<Candidate<'a>>,
    /// The best of the effects that come after it.
    pub later: Vec<Candidate<'a>>,
    /// For each effect, the p-value with which it entered.
    pub p_values: Vec<f64>,
}

/// What the search works on.
pub(super) struct Search<'s, 'a> {
    pub(super) begun: &'s Begun<'a>,
    pub(super) rows: &'s [Rows],
    pub(super) splits: &'s [Split],
    pub(super) settings: &'s Settings,
}

impl<'a> Search<'_, 'a> {
    /// Name the effects: the model found, and that of its first effect alone where there are more.
    pub(super) fn run(&self) -> (Named<'a>, Option<Named<'a>>) {
        let mut here = self.look(self.begun.assembly.clone(), &self.begun.fitted.unit, &self.begun.noise);
        let (mut first, mut removed_by_first) = (None, 0.0);
        while self.found(&here) < MOST {
            let Some(next) = here.next.as_ref() else { break };
            let Some(wider) = self.wider(&here, next) else { break };
            if self.found(&here) == 0 {
                let wider =
                    match wider.next.as_ref().filter(|second| self.significant(&wider, second).is_some()) {
                        Some(second) => self.best_first(&here, &wider, second),
                        None => wider,
                    };
                let [held_out, trained, _] = self.improvement(&here, &wider);
                // A base that fails plainly where it is carried too far is no measure of the first effect.
                removed_by_first = if wider.noise.hidden() { held_out.min(trained) } else { held_out };
                first = Some(wider.clone());
                here = wider;
            } else {
                let worth = |wider: &Named<'a>| {
                    let [removed, _, noise] = self.improvement(&here, wider);
                    removed >= (LEAST_OF_NOISE * noise).max(LEAST_OF_FIRST * removed_by_first)
                };
                let later = || here.later.iter().filter_map(|c| self.wider(&here, c)).find(&worth);
                let Some(wider) = Some(wider).filter(&worth).or_else(later) else { break };
                here = wider;
            }
        }
        let named = self.without_the_needless(here);
        let more = self.found(&named) > 1;
        (named, first.filter(|_| more))
    }

    /// A model with one more effect, if that is significant.
    fn wider(&self, here: &Named<'a>, next: &Candidate<'a>) -> Option<Named<'a>> {
        let p_value = self.significant(here, next)?;
        let mut wider = self.look(next.assembly.clone(), &next.fitted.unit, &here.noise);
        wider.p_values = here.p_values.iter().copied().chain([p_value]).collect();
        Some(self.best_law(wider))
    }

    /// Number of effects that belong to the base.
    fn given(&self) -> usize {
        self.begun.assembly.effects().len()
    }

    /// Number of effects that were found.
    fn found(&self, named: &Named) -> usize {
        named.assembly.effects().len() - self.given()
    }

    /// Score the catalogue beside a model, with the noise that the best of a few candidates leaves.
    fn look(&self, assembly: Assembly<'a>, unit: &[f64], noise: &Noise) -> Named<'a> {
        let data = Data { noise, rows: self.rows };
        let Candidate { assembly, fitted: first } = fit(assembly, data, unit);
        let found = scores(&assembly, data, &first.unit, self.settings);
        let noise = match candidates(&assembly, data, &first.unit, &found, FEW).first() {
            Some(best) => noise_left(&best.assembly, data, &best.fitted),
            None => noise_left(&assembly, data, &first),
        };
        let data = Data { noise: &noise, rows: self.rows };
        let Candidate { assembly, fitted } = fit(assembly, data, &first.unit);
        let found = scores(&assembly, data, &fitted.unit, self.settings);
        let mut tried = candidates(&assembly, data, &fitted.unit, &found, REFITTED).into_iter();
        let next = tried.next();
        let mut later: Vec<Candidate> = Vec::new();
        // Likelihoods of a noise that is not known may put an effect first that fails on other data.
        for candidate in tried.filter(|_| noise.hidden()) {
            let id = candidate.added();
            if later.len() < LATER && later.iter().chain(&next).all(|c| c.added() != id) {
                later.push(candidate);
            }
        }
        Named { assembly, fitted, noise, scores: found, next, later, p_values: Vec::new() }
    }

    /// The p-value of a candidate, if its effect passes Holm's threshold: the smallest p-value against the
    /// number of effects does, or the candidate's own does in its turn.
    fn significant(&self, here: &Named<'a>, next: &Candidate<'a>) -> Option<f64> {
        let id = next.added()?;
        let mut effects = by_effect(&here.scores);
        effects.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut adjusted: f64 = 0.0;
        for (turn, (effect, p)) in effects.iter().enumerate() {
            adjusted = adjusted.max(p * (effects.len() - turn) as f64);
            if adjusted > self.settings.false_alarm {
                return None;
            }
            if *effect == id {
                return Some(adjusted);
            }
        }
        None
    }

    /// The same effects, each with the law that leaves least.
    fn best_law(&self, named: Named<'a>) -> Named<'a> {
        let mut best = named;
        for place in self.given()..best.assembly.effects().len() {
            let known = best.assembly.effects()[place];
            let others = self.settings.laws.iter().copied().filter(|e| {
                e.about().effect == known.about().effect
                    && e.about() != known.about()
                    && e.applies(best.assembly.campaign().sizes())
            });
            let data = Data { noise: &best.noise, rows: self.rows };
            let without = self.drop(&best, place);
            let tried = others
                .collect::<Vec<_>>()
                .into_par_iter()
                .filter_map(|e| self.best_start(&without, data, e))
                .collect::<Vec<_>>();
            let now = Candidate { assembly: best.assembly.clone(), fitted: best.fitted.clone() };
            let better = tried
                .into_iter()
                .filter(|c| c.criterion() < now.criterion() - CLEAR)
                .min_by(|a, b| a.criterion().total_cmp(&b.criterion()));
            if let Some(better) = better {
                let p_values = best.p_values.clone();
                best = self.look(better.assembly, &better.fitted.unit, &best.noise);
                best.p_values = p_values;
            }
        }
        best
    }

    /// Joint fit of a model with a law, from the law's two strongest starts.
    fn best_start(
        &self,
        without: &Candidate<'a>,
        data: Data,
        effect: &'static dyn Effect,
    ) -> Option<Candidate<'a>> {
        let null = super::screen::Null::new(&without.assembly, data, &without.fitted.unit)?;
        let score = null.score(effect, self.settings.seed)?;
        Some(joint(&without.assembly, data, &without.fitted.unit, effect, &null.held(&score).shape))
    }

    /// A model without one of its effects, refitted.
    pub(super) fn drop(&self, named: &Named<'a>, place: usize) -> Candidate<'a> {
        let mut effects = named.assembly.effects().to_vec();
        effects.remove(place);
        let narrower = named.assembly.with(effects);
        let sizes = named.assembly.campaign().sizes();
        let mut shapes = named.assembly.physical(&named.fitted.unit);
        let first: usize = named.assembly.base_shapes()
            + named.assembly.effects()[..place].iter().map(|e| e.shape(sizes).len()).sum::<usize>();
        let count = named.assembly.effects()[place].shape(sizes).len();
        shapes.drain(first..first + count);
        let data = Data { noise: &named.noise, rows: self.rows };
        let unit = narrower.unit(&shapes);
        fit(narrower, data, &unit)
    }

    /// The first of the best pair, where the pair from another first is clearly better than the pair from
    /// the best single effect.
    fn best_first(&self, before: &Named<'a>, single: &Named<'a>, second: &Candidate<'a>) -> Named<'a> {
        let data = Data { noise: &single.noise, rows: self.rows };
        let given = self.given();
        let known = single.assembly.effects()[given].about().effect;
        let mut firsts: Vec<Candidate> = Vec::new();
        for candidate in candidates(&before.assembly, data, &before.fitted.unit, &before.scores, REFITTED) {
            let id = candidate.assembly.effects()[given].about().effect;
            let seen = firsts.iter().any(|f| f.assembly.effects()[given].about().effect == id);
            if id != known && !seen && firsts.len() < FIRSTS {
                firsts.push(candidate);
            }
        }
        let pairs: Vec<(Candidate, Candidate)> = firsts
            .into_par_iter()
            .filter_map(|first| {
                let found = scores(&first.assembly, data, &first.fitted.unit, self.settings);
                let best =
                    candidates(&first.assembly, data, &first.fitted.unit, &found, FEW).into_iter().next()?;
                Some((first, best))
            })
            .collect();
        let best = pairs.into_iter().min_by(|a, b| a.1.criterion().total_cmp(&b.1.criterion()));
        match best {
            Some((first, pair)) if pair.criterion() < second.criterion() - CLEAR => {
                let p_values = single.p_values.clone();
                let mut named = self.look(first.assembly, &first.fitted.unit, &single.noise);
                named.p_values = p_values;
                named
            }
            _ => single.clone(),
        }
    }

    /// How much one model lowers the held-out rms of another, that on the samples trained on, and the rms of
    /// the noise, N.
    fn improvement(&self, before: &Named<'a>, after: &Named<'a>) -> [f64; 3] {
        let proof = |n: &Named<'a>| prove(&n.assembly, &after.noise, self.splits, &n.fitted);
        let (a, b) = (proof(before), proof(after));
        let data = Data { noise: &after.noise, rows: self.rows };
        let left = match &after.next {
            Some(next) => residuals(&next.assembly, data, &next.fitted),
            None => residuals(&after.assembly, data, &after.fitted),
        };
        [a.held_out_rms - b.held_out_rms, a.train_rms - b.train_rms, rms(&left)]
    }

    /// Remove effects that the others make unnecessary.
    fn without_the_needless(&self, named: Named<'a>) -> Named<'a> {
        let mut here = named;
        let mut place = self.given();
        while self.found(&here) > 1 && place < here.assembly.effects().len() {
            let now = Candidate { assembly: here.assembly.clone(), fitted: here.fitted.clone() };
            let without = self.drop(&here, place);
            if without.criterion() < now.criterion() {
                let mut p_values = here.p_values.clone();
                p_values.remove(place - self.given());
                here = self.look(without.assembly, &without.fitted.unit, &here.noise);
                here.p_values = p_values;
                place = self.given();
            } else {
                place += 1;
            }
        }
        here
    }
}

/// Root mean square over recordings.
pub(super) fn rms(series: &[Vec<f64>]) -> f64 {
    let count: usize = series.iter().map(Vec::len).sum();
    (series.iter().flatten().map(|e| e * e).sum::<f64>() / count as f64).sqrt()
}
