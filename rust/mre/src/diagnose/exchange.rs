//! What might stand in the place of effects that were named: other laws of them, and other effects.

use super::candidates::{Candidate, candidates, margin, scores};
use super::least_squares::Data;
use super::monitor::Stage;
use super::noise::Noise;
use super::other_laws::fits_from;
use super::search::{FEW, Named, REFITTED, Search};
use super::worth::SLIGHT;
use crate::effect::Effect;

/// Advantage in the criterion that counts.
pub(super) const CLEAR: f64 = 10.0;

impl<'a> Search<'_, 'a> {
    /// The same effects, each with the law that leaves least.
    pub(super) fn best_law(&self, named: Named<'a>) -> Option<Named<'a>> {
        self.monitor.begins(Stage::Laws);
        let mut place = 0;
        let mut best = named;
        for _ in 0..self.found(&best) {
            let known = best.assembly.effects()[self.given() + place];
            let others = self.settings.laws.iter().copied().filter(|e| {
                e.about().effect == known.about().effect
                    && e.about() != known.about()
                    && e.applies(best.assembly.campaign().sizes())
            });
            let data = self.data(&best.noise);
            let without = self.drop(&best, self.given() + place);
            let tried = self.best_starts(&without, data, &others.collect::<Vec<_>>());
            let better = self.better(&best.noise, &best.itself(), tried);
            if let Some(better) = self.monitor.whole(better)? {
                // The law comes last, and so does its p-value; the next effect takes its place.
                let mut p_values = best.p_values.clone();
                p_values[place..].rotate_left(1);
                best = self.look(better.assembly, &better.fitted.unit, &best.noise)?;
                best.p_values = p_values;
            } else {
                place += 1;
            }
        }
        Some(best)
    }

    /// The best of other candidates, if it is clearly better than a known one, or better and simpler.
    fn better(
        &self,
        noise: &Noise,
        known: &Candidate<'a>,
        mut others: Vec<Candidate<'a>>,
    ) -> Option<Candidate<'a>> {
        // What is simpler need not be better by much.
        let clear = |c: &Candidate<'a>| {
            if c.fitted.parameters() < known.fitted.parameters() { 0.0 } else { CLEAR }
        };
        others.retain(|c| c.criterion() < known.criterion() - clear(c));
        others.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
        if !noise.hidden() {
            return others.into_iter().next();
        }
        let least = (1.0 - SLIGHT) * self.held_out(noise, known);
        let tried = others.into_iter().take(FEW).map(|c| (self.held_out(noise, &c), c));
        tried.filter(|(error, _)| *error < least).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, c)| c)
    }

    /// The same number of effects, with the best candidate in the place of one that it makes unnecessary.
    pub(super) fn replaced(&self, here: &Named<'a>) -> Option<Named<'a>> {
        // Likelihoods of a noise that is not known do not choose between models.
        let next = here.next.as_ref().filter(|_| !here.noise.hidden())?;
        let p_value = self.significant(here, next)?;
        let wider = Named::bare(next.assembly.clone(), next.fitted.clone(), here.noise.clone());
        let own = here.itself();
        let tried = self.monitor.stage(Stage::Needless, || {
            let places = self.given()..here.assembly.effects().len();
            places.map(|place| (place, self.drop(&wider, place))).collect::<Vec<_>>()
        })?;
        let (place, best) = tried
            .into_iter()
            .filter(|(_, c)| c.criterion() < own.criterion() - CLEAR)
            .min_by(|a, b| a.1.criterion().total_cmp(&b.1.criterion()))?;
        self.best_law(self.with_last(here, place, best, p_value)?)
    }

    /// Several effects, each the best beside the others: the first were chosen before these were known.
    pub(super) fn best_beside_each_other(&self, named: Named<'a>) -> Named<'a> {
        let (mut here, mut place) = (named, self.given());
        for _ in 0..2 * self.found(&here) {
            let last = place == here.assembly.effects().len();
            if last || self.found(&here) < 2 || here.noise.hidden() {
                break;
            }
            match self.better_at(&here, place) {
                Some(better) => (here, place) = (better, self.given()),
                None => place += 1,
            }
        }
        here
    }

    /// The same with another effect in one place, or the same one fitted anew, if that leaves clearly less.
    fn better_at(&self, here: &Named<'a>, place: usize) -> Option<Named<'a>> {
        let own = here.itself();
        let data = self.data(&here.noise);
        let (without, best) = self.monitor.stage(Stage::Pairs, || {
            let Candidate { assembly, fitted } = self.drop(here, place);
            let scores = scores(&assembly, data, &fitted.unit, self.settings);
            let clear = margin(CLEAR, fitted.left - own.fitted.left);
            let best = candidates(&assembly, data, &fitted.unit, &scores, REFITTED)
                .into_iter()
                .find(|c| c.criterion() < own.criterion() - clear);
            (Named { scores, ..Named::bare(assembly, fitted, here.noise.clone()) }, best)
        })?;
        let best = best?;
        let p_value = self.significant(&without, &best)?;
        self.with_last(here, place, best, p_value)
    }

    /// A model whose last effect came in the place of one of another model.
    fn with_last(
        &self,
        other: &Named<'a>,
        place: usize,
        model: Candidate<'a>,
        p_value: f64,
    ) -> Option<Named<'a>> {
        let mut named = self.look(model.assembly, &model.fitted.unit, &other.noise)?;
        named.p_values.clone_from(&other.p_values);
        named.p_values.remove(place - self.given());
        named.p_values.push(p_value);
        Some(named)
    }

    /// Joint fits of a model with each of some laws, from the law's strongest start.
    fn best_starts(
        &self,
        without: &Candidate<'a>,
        data: Data,
        laws: &[&'static dyn Effect],
    ) -> Vec<Candidate<'a>> {
        fits_from(&without.assembly, data, &without.fitted.unit, laws, |null, effect| {
            let score = null.score(*effect, self.settings.seed)?;
            Some((*effect, null.held(&score).shape))
        })
    }
}
