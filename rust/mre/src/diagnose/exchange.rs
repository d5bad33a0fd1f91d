//! What might stand in the place of effects that were named: other laws of them, and other firsts of a pair.

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, joint, scores};
use super::least_squares::Data;
use super::monitor::Stage;
use super::null::Null;
use super::search::{FEW, Named, REFITTED, Search};
use crate::effect::Effect;

/// Candidates for the first of a pair.
const FIRSTS: usize = 5;
/// Advantage in the criterion that counts.
const CLEAR: f64 = 10.0;

impl<'a> Search<'_, 'a> {
    /// The same effects, each with the law that leaves least.
    pub(super) fn best_law(&self, named: Named<'a>) -> Option<Named<'a>> {
        self.monitor.begins(Stage::Laws);
        let mut best = named;
        for place in self.given()..best.assembly.effects().len() {
            let known = best.assembly.effects()[place];
            let others = self.settings.laws.iter().copied().filter(|e| {
                e.about().effect == known.about().effect
                    && e.about() != known.about()
                    && e.applies(best.assembly.campaign().sizes())
            });
            let data = self.data(&best.noise);
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
            if let Some(better) = self.monitor.whole(better)? {
                let p_values = best.p_values.clone();
                best = self.look(better.assembly, &better.fitted.unit, &best.noise)?;
                best.p_values = p_values;
            }
        }
        Some(best)
    }

    /// Joint fit of a model with a law, from the law's two strongest starts.
    fn best_start(
        &self,
        without: &Candidate<'a>,
        data: Data,
        effect: &'static dyn Effect,
    ) -> Option<Candidate<'a>> {
        let null = Null::new(&without.assembly, data, &without.fitted.unit)?;
        let score = null.score(effect, self.settings.seed)?;
        Some(joint(&without.assembly, data, &without.fitted.unit, effect, &null.held(&score).shape))
    }

    /// The first of the best pair, where the pair from another first is clearly better than the pair from
    /// the best single effect; or another first that is clearly better under the noise that the pair left.
    pub(super) fn best_first(
        &self,
        before: &Named<'a>,
        single: Named<'a>,
        second: &Candidate<'a>,
    ) -> Option<Named<'a>> {
        self.monitor.begins(Stage::Pairs);
        let data = self.data(&single.noise);
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
        let pairs = self.monitor.whole(pairs)?;
        let least = |one: &dyn Fn(&(Candidate, Candidate)) -> f64| {
            pairs.iter().min_by(|a, b| one(a).total_cmp(&one(b))).map(|best| (one(best), &best.0))
        };
        let own = Candidate { assembly: single.assembly.clone(), fitted: single.fitted.clone() };
        let clearly =
            |found: Option<(f64, _)>, known: f64| found.filter(|f| f.0 < known - CLEAR).map(|f| f.1);
        let other = clearly(least(&|pair| pair.1.criterion()), second.criterion())
            .or_else(|| clearly(least(&|pair| pair.0.criterion()), own.criterion()));
        let Some(first) = other else { return Some(single) };
        let mut named = self.look(first.assembly.clone(), &first.fitted.unit, &single.noise)?;
        named.p_values = single.p_values;
        Some(named)
    }
}
