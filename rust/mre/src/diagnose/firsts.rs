//! Other firsts of a pair: the best single effect may be neither of two.

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, margin, scores};
use super::exchange::CLEAR;
use super::monitor::Stage;
use super::search::{FEW, Named, REFITTED, Search};
use super::worth::SLIGHT;

/// Candidates for the first of a pair.
const FIRSTS: usize = 5;

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
            let tried = pairs.iter().map(|pair| (size(pair), &pair.0)).filter(|(size, _)| *size < least);
            tried.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, first)| first)
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
            below(&|(_, pair)| pair.criterion(), second.criterion() - clear)
                .or_else(|| below(&|(first, _)| first.criterion(), single.itself().criterion() - clear))
        };
        let Some(first) = other else { return Some(single) };
        let mut named = self.look(first.assembly.clone(), &first.fitted.unit, &single.noise)?;
        named.p_values = single.p_values;
        Some(named)
    }
}
