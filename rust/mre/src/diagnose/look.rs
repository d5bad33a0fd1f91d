//! A look at what the catalogue offers beside a model, and whether the best of it is significant.

use super::candidates::{Candidate, by_effect, candidates, noise_left, scores};
use super::joint::fit;
use super::least_squares::{AKAIKE, Fitted};
use super::monitor::Stage;
use super::noise::Noise;
use super::point::Point;
use super::resolution::nothing_left;
use super::search::{FEW, LATER, Named, REFITTED, Search, WAYS};
use crate::assembly::Assembly;

impl<'a> Search<'_, 'a> {
    /// Score the catalogue beside a model, with the noise that the best of a few candidates leaves.
    pub(super) fn look(&self, assembly: Assembly<'a>, unit: &[f64], noise: &Noise) -> Option<Named<'a>> {
        let beside = Stage::Catalogue(assembly.effects().len() - self.given());
        let (assembly, noise, fitted, found) = self.monitor.stage(beside, || {
            let data = self.data(noise);
            let here = fit(assembly, data, unit);
            let found = scores(&here.assembly, data, &here.fitted.unit, self.settings);
            let few = candidates(&here.assembly, data, &here.fitted.unit, &found, FEW);
            let best = few.first().unwrap_or(&here);
            let left = noise_left(&best.assembly, data, &best.fitted);
            if self.alike(best, noise, &left) {
                return (here.assembly, noise.clone(), here.fitted, found);
            }
            let data = self.data(&left);
            let Candidate { assembly, fitted } = fit(here.assembly, data, &here.fitted.unit);
            let found = scores(&assembly, data, &fitted.unit, self.settings);
            (assembly, left, fitted, found)
        })?;
        let data = self.data(&noise);
        let beside = |most: usize| candidates(&assembly, data, &fitted.unit, &found, most);
        let most = if nothing_left(&assembly, data, &fitted) { 0 } else { REFITTED };
        let mut tried = self.monitor.stage(Stage::Candidates, || beside(most))?.into_iter();
        let next = tried.next();
        let mut later: Vec<Candidate> = Vec::new();
        // Likelihoods of a noise that is not known may put an effect first that fails on other data.
        for candidate in tried.filter(|_| noise.hidden()) {
            let id = candidate.added();
            if later.len() < LATER && later.iter().chain(&next).all(|c| c.added() != id) {
                later.push(candidate);
            }
        }
        Some(Named { assembly, fitted, noise, scores: found, next, later, p_values: Vec::new() })
    }

    /// True where two noises say the same of what a candidate fitted under the first leaves: their likelihoods differ by
    /// less than a parameter is worth.
    fn alike(&self, candidate: &Candidate, first: &Noise, second: &Noise) -> bool {
        if first.hidden() != second.hidden() || !first.keeps_the_samples_of(second) {
            return false;
        }
        let Candidate { assembly, fitted } = candidate;
        let under = |noise: &Noise, fitted: &Fitted| {
            let samples = |r: usize| {
                let lost = noise.lost(r);
                self.rows[r].iter().map(|range| range.end.max(lost) - range.start.max(lost)).sum()
            };
            fitted.left + noise.logarithm_of_covariance(samples)
        };
        let other = Point::at(assembly, self.data(second), fitted.unit.clone()).fitted;
        (under(first, fitted) - under(second, &other)).abs() < AKAIKE
    }

    /// The p-value of a candidate, if its effect passes Holm's threshold at half of the false alarms: the smallest
    /// p-value against the number of effects does, or the candidate's own does in its turn.
    pub(super) fn significant(&self, here: &Named<'a>, next: &Candidate<'a>) -> Option<f64> {
        let id = next.added()?;
        let mut effects = by_effect(&here.scores);
        effects.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut adjusted: f64 = 0.0;
        for (turn, (effect, p)) in effects.iter().enumerate() {
            adjusted = adjusted.max(WAYS * p * (effects.len() - turn) as f64);
            if adjusted > self.settings.false_alarm {
                return None;
            }
            if *effect == id {
                return Some(adjusted);
            }
        }
        None
    }
}
