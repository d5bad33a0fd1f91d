//! Naming: which effects, added to the base and refitted together with it, explain the recordings.
//!
//! The law with the lowest whitened BIC enters if its effect's p-value passes Holm's threshold (Holm 1979).
//! Then other laws of the effects already named are tried in their place, and the noise is estimated anew
//! from the best model so far. A further effect enters only if it also helps on data that took no part, or two that
//! help together; beside a hum alone it need not. Pairs are searched from several firsts, because the best single
//! effect may be neither of two. An effect that a later one makes unnecessary is replaced by it; at the end each of
//! several gives way to one that is better beside the others, and one that the others make unnecessary leaves.

use super::begin::Begun;
use super::candidates::{Candidate, residuals};
use super::least_squares::{Data, Fitted};
use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::Rows;
use super::screen::Score;
use super::settings::Settings;
use super::splits::Splits;
use super::worth::Improvement;
use crate::assembly::Assembly;
use crate::effect::Effect;

/// Most effects that are named.
pub(super) const MOST: usize = 4;
/// Candidates that are refitted jointly.
pub(super) const REFITTED: usize = 8;
/// The same where only the best is wanted, roughly.
pub(super) const FEW: usize = 3;
/// A mismatch is found by the statistic of an effect or by tests of any mismatch: each way has half of the false
/// alarms.
pub(super) const WAYS: f64 = 2.0;
/// Effects after the best that are tried where that fails.
pub(super) const LATER: usize = 3;
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
    /// The best of other effects after it, where the noise is hidden.
    pub later: Vec<Candidate<'a>>,
    /// For each effect, the p-value with which it entered.
    pub p_values: Vec<f64>,
}

impl<'a> Named<'a> {
    /// A model before anything was scored beside it.
    pub(super) fn bare(assembly: Assembly<'a>, fitted: Fitted, noise: Noise) -> Self {
        let (scores, later, p_values) = (Vec::new(), Vec::new(), Vec::new());
        Self { assembly, fitted, noise, scores, next: None, later, p_values }
    }

    /// The effects beside those that the base was given with.
    pub(super) fn added(&self, begun: &Begun) -> &[&'static dyn Effect] {
        &self.assembly.effects()[begun.assembly.effects().len()..]
    }

    /// The model with its fit.
    pub(super) fn itself(&self) -> Candidate<'a> {
        Candidate { assembly: self.assembly.clone(), fitted: self.fitted.clone() }
    }

    /// Rms in N of what the best candidate leaves, or the model itself where that is less: fits make what the noise
    /// cannot predict smallest, not what is left.
    pub(super) fn noise_rms(&self, data: Data) -> f64 {
        let own = rms(&residuals(&self.assembly, data, &self.fitted));
        let of_next = |next: &Candidate| rms(&residuals(&next.assembly, data, &next.fitted));
        self.next.as_ref().map_or(own, |next| own.min(of_next(next)))
    }
}

/// What the search works on.
pub(super) struct Search<'s, 'a> {
    pub(super) begun: &'s Begun<'a>,
    pub(super) rows: &'s [Rows],
    pub(super) splits: &'s Splits,
    pub(super) settings: &'s Settings,
    pub(super) monitor: &'s dyn Monitor,
}

impl<'a> Search<'_, 'a> {
    /// Name the effects: the model found, and that of its first effect alone where there are more.
    ///
    /// Where the search is broken off, the model found so far.
    pub(super) fn run(&self) -> (Named<'a>, Option<Named<'a>>) {
        let Begun { assembly, fitted, noise } = self.begun;
        let Some(mut here) = self.look(assembly.clone(), &fitted.unit, noise) else {
            return (Named::bare(assembly.clone(), fitted.clone(), noise.clone()), None);
        };
        let (mut first, mut removed_by_first) = (None, 0.0);
        let mut replacements = 0;
        while self.found(&here) < MOST {
            if self.moved(&here) > 0 {
                if let Some(wider) = self.worth_adding(&here, removed_by_first) {
                    here = wider;
                    continue;
                }
                let other = if replacements < MOST { self.replaced(&here) } else { None };
                let Some(other) = other else { break };
                here = other;
                replacements += 1;
                if self.moved(&here) == 1 {
                    first = Some(here.clone());
                }
                continue;
            }
            let single = self.in_turn(&here).into_iter().find_map(|next| self.wider(&here, next));
            let Some(single) = single else { break };
            // A hum has nothing in its form that another effect could patch: the first is the first beside it.
            if self.moved(&single) == 0 {
                let best = self.best_law(single.clone());
                here = best.unwrap_or(single);
                continue;
            }
            let Some((best, removed)) = self.best_of_first(&here, &single) else {
                here = single;
                break;
            };
            removed_by_first = removed;
            first = Some(best.clone());
            here = best;
        }
        let named = self.without_the_needless(self.best_beside_each_other(here));
        let more = self.moved(&named) > 1;
        (named, first.filter(|_| more))
    }

    /// The best first effect with its best law, and by how much it lowers the held-out rms, N.
    fn best_of_first(&self, before: &Named<'a>, single: &Named<'a>) -> Option<(Named<'a>, f64)> {
        let known = single.assembly.effects().last()?.about().effect;
        let mut best = self.best_law(single.clone())?;
        let second = best.next.clone().filter(|second| self.significant(&best, second).is_some());
        if let Some(second) = second {
            best = self.best_first(before, best, known, &second)?;
        }
        let Improvement { held_out, trained, .. } = self.improvement(before, &best)?;
        // A base that fails plainly where it is carried too far is no measure of the first effect.
        let removed = if best.noise.hidden() { held_out.min(trained) } else { held_out };
        Some((best, removed))
    }

    /// A model with one more effect, if that is significant.
    pub(super) fn wider(&self, here: &Named<'a>, next: &Candidate<'a>) -> Option<Named<'a>> {
        let p_value = self.significant(here, next)?;
        let mut wider = self.look(next.assembly.clone(), &next.fitted.unit, &here.noise)?;
        wider.p_values = here.p_values.iter().copied().chain([p_value]).collect();
        Some(wider)
    }

    /// The recordings under some noise.
    pub(super) fn data<'d>(&self, noise: &'d Noise) -> Data<'d>
    where
        Self: 'd,
    {
        Data { noise, rows: self.rows, monitor: self.monitor }
    }

    /// Number of effects that belong to the base.
    pub(super) fn given(&self) -> usize {
        self.begun.assembly.effects().len()
    }

    /// Number of effects that were found.
    pub(super) fn found(&self, named: &Named) -> usize {
        named.added(self.begun).len()
    }

    /// Number of these that follow the motion.
    pub(super) fn moved(&self, named: &Named) -> usize {
        named.added(self.begun).iter().filter(|e| e.follows_the_motion()).count()
    }
}

/// Root mean square over recordings.
pub(super) fn rms(series: &[Vec<f64>]) -> f64 {
    let count: usize = series.iter().map(Vec::len).sum();
    (series.iter().flatten().map(|e| e * e).sum::<f64>() / count as f64).sqrt()
}
