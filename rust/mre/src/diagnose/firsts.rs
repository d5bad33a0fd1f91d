//! Other firsts of a pair: the best single effect may be neither of two.

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, margin, scores};
use super::exchange::CLEAR;
use super::monitor::Stage;
use super::search::{FEW, Named, REFITTED, Search};
use super::worth::SLIGHT;

/// Candidates for the first of a pair.
const FIRSTS: usize = 5;
/// A pair takes off more than this share of what the best single effect does beyond it.
const LEAST_SHARE: f64 = 0.05;

impl<'a> Search<'_, 'a> {
    /// The first of the best pair, where the pair from another first is clearly better than the pair from
    /// the best single effect; or another first that is clearly better under the noise that the pair left.
    pub(super) fn best_first(
        &self,
        before: &Named<'a>,
        single: Named<'a>,
        known: &str,
        second: &Candidate<'a>,
    ) -> Option<Named<'a>> {
        self.monitor.begins(Stage::Pairs);
        let data = self.data(&single.noise);
        let mut firsts: Vec<Candidate> = Vec::new();
        for candidate in candidates(&before.assembly, data, &before.fitted.unit, &before.scores, REFITTED) {
            let id = candidate.added();
            let seen = firsts.iter().any(|first| first.added() == id);
            if id != Some(known) && !seen && firsts.len() < FIRSTS {
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
        let below = |size: &dyn Fn(&(Candidate<'a>, Candidate<'a>)) -> f64, least: f64| {
            let tried = pairs.iter().map(|pair| (size(pair), pair)).filter(|(size, _)| *size < least);
            tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, pair)| pair)
        };
        let other = if single.noise.hidden() {
            let error = |c: &Candidate<'a>| self.held_out(&single.noise, c);
            let least = (1.0 - SLIGHT) * error(second);
            // A first that needs no second is no first of a pair.
            let of_pair = |(first, pair): &(Candidate<'a>, Candidate<'a>)| {
                let size = error(pair);
                if size < (1.0 - SLIGHT) * error(first) { size } else { f64::INFINITY }
            };
            below(&of_pair, least)
        } else {
            let explained = before.next.as_ref().map_or(0.0, |next| before.fitted.left - next.fitted.left);
            let clear = margin(CLEAR, explained);
            let of_pair = below(&|(_, pair)| pair.criterion(), second.criterion() - clear);
            let worth = of_pair.is_some_and(|(_, pair)| self.worth_both(before, &single, pair));
            of_pair
                .filter(|_| worth)
                .or_else(|| below(&|(first, _)| first.criterion(), single.itself().criterion() - clear))
        };
        let Some((first, _)) = other else { return Some(single) };
        let mut named = self.look(first.assembly.clone(), &first.fitted.unit, &single.noise)?;
        named.p_values = single.p_values;
        Some(named)
    }

    /// True where a pair is worth two names in the place of one: two forms always bend closer than one.
    fn worth_both(&self, before: &Named<'a>, single: &Named<'a>, pair: &Candidate<'a>) -> bool {
        let worth = || {
            if self.share(single, pair) < LEAST_SHARE {
                return None;
            }
            let by_single = self.improvement(before, single)?.held_out;
            let mut both = self.look(pair.assembly.clone(), &pair.fitted.unit, &single.noise)?;
            both.p_values = vec![f64::NAN; self.found(&both)];
            self.worth(single, pair, &self.best_law(both)?, by_single)
        };
        worth().unwrap_or(false)
    }
}
