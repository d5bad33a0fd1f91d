//! Candidates: every law of the catalogue is scored beside a fitted model, and the strongest are refitted
//! together with it.

use rayon::prelude::*;

use super::above::fastest;
use super::coherent::without_the_coherent;
use super::drift::{beside, without_drift};
use super::extrapolated::{Beside, Extent};
use super::gaps::LeftOut;
use super::joint::{joint, unbent};
use super::least_squares::{AKAIKE, Data, Fitted};
use super::noise::Noise;
use super::null::Null;
use super::other_laws;
use super::plain_mismatch;
use super::point::forces;
use super::promising::promising;
use super::screen::Score;
use super::search::REFITTED;
use super::settings::Settings;
use super::slow::temper;
use super::starts::{calm, without_initial_state};
use crate::assembly::{Assembly, Campaign};
use crate::effect::{About, CATALOGUE, Effect};

/// The best of them are also fitted from other shapes of the base.
const UNBENT: usize = 2;
/// Candidates closer than this in the criterion fit about equally well.
pub(super) const TIE: f64 = 4.0;
/// Differences in the criterion below this come from where a fit stops.
const NUMERICAL: f64 = 0.1;
/// No law is exact: a difference below this share of what a candidate explains is no reason to prefer it.
const EXACT: f64 = 3e-5;

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
        self.fitted.criterion()
    }

    /// What is known of the last law.
    pub(super) fn law(&self) -> Option<About> {
        self.assembly.effects().last().map(|e| e.about())
    }

    /// Id of the last effect.
    pub(super) fn added(&self) -> Option<&'static str> {
        self.law().map(|about| about.effect)
    }

    /// The criterion without what the last law pays for parameters that stand at an ideal of their own.
    pub(super) fn as_the_smallest(&self) -> f64 {
        self.last().map_or(self.criterion(), |last| smallest(&self.assembly, &self.fitted, last))
    }

    /// Akaike's criterion, likewise.
    pub(super) fn akaike_as_the_smallest(&self) -> f64 {
        let of = |last| akaike_of_the_smallest(&self.assembly, &self.fitted, last);
        self.last().map_or(self.fitted.beyond_chance(), of)
    }

    fn last(&self) -> Option<usize> {
        self.assembly.effects().len().checked_sub(1)
    }

    /// Place of the last law in the catalogue.
    fn place(&self) -> usize {
        let last = self.law();
        CATALOGUE.iter().position(|e| Some(e.about()) == last).unwrap_or(usize::MAX)
    }

    /// True where the last law is the plainest of its effect.
    fn plainest(&self) -> bool {
        let id = self.added();
        CATALOGUE.iter().position(|e| Some(e.about().effect) == id) == Some(self.place())
    }
}

/// The criterion of a model whose effect at a place pays for no parameter that stands at an ideal of its own: there it
/// is a smaller law.
pub(super) fn smallest(assembly: &Assembly, fitted: &Fitted, place: usize) -> f64 {
    fitted.criterion() - fitted.price() * idle(assembly, fitted, place) as f64
}

/// The same by Akaike's criterion: what a parameter costs where one law is to be named says little of which is true (IEEE
/// Trans. Autom. Control 19 (1974) 716).
pub(super) fn akaike_of_the_smallest(assembly: &Assembly, fitted: &Fitted, place: usize) -> f64 {
    fitted.beyond_chance() - AKAIKE * idle(assembly, fitted, place) as f64
}

/// Parameters of an effect that stand at an ideal of their own.
fn idle(assembly: &Assembly, fitted: &Fitted, place: usize) -> usize {
    let (_, own) = assembly.of_effect(place);
    let all = assembly.shapes()[own.clone()].iter().zip(&fitted.unit[own]);
    all.filter(|(p, unit)| p.is_ideal(**unit)).count()
}

/// Advantage in the criterion that counts between candidates that explain so much.
pub(super) fn margin(least: f64, explained: f64) -> f64 {
    least.max(EXACT * explained)
}

/// Time steps of the recordings, s.
pub(super) fn steps(assembly: &Assembly) -> Vec<f64> {
    assembly.campaign().recordings().iter().map(|r| 1.0 / r.sampling_rate()).collect()
}

/// Residuals in N of a fit, of the samples that are scored, less what unknown initial states explain of them.
pub(super) fn residuals(assembly: &Assembly, data: Data, fitted: &Fitted) -> Vec<Vec<f64>> {
    let forces = forces(assembly, data, fitted);
    let left = forces.iter().enumerate().map(|(r, force)| residual(assembly.campaign(), r, force));
    left.enumerate().map(|(r, left)| without_initial_state(assembly, r, left)).collect()
}

/// Measured less modelled force in N, of the samples of a recording that are scored; where these tell nothing, as
/// around there.
pub(super) fn residual(campaign: &Campaign, r: usize, force: &[f64]) -> Vec<f64> {
    let recording = &campaign.recordings()[r];
    let all = recording.force().unwrap_or_default().iter().zip(force).map(|(f, model)| f - model);
    let mut left: Vec<f64> = all.skip(recording.scored().start).take(recording.scored().len()).collect();
    LeftOut::of(campaign, r).bridge(&mut left);
    left
}

/// The noise that a fit leaves: all of its residual, unless that is plainly a mismatch.
pub(super) fn noise_left(assembly: &Assembly, data: Data, fitted: &Fitted) -> Noise {
    let freedom = fitted.parameters();
    let left = residuals(assembly, data, fitted);
    if let Some(size) = plain_mismatch::find(assembly, &left, data.noise) {
        return Noise::beside_a_mismatch(left.len(), size);
    }
    let campaign = assembly.campaign();
    let left_out: Vec<LeftOut> = (0..left.len()).map(|r| LeftOut::of(campaign, r)).collect();
    let left = without_the_coherent(assembly, left);
    let beside = beside(&left, &calm(assembly, &left));
    let spectra = Beside::of(&left, &beside);
    let calm = without_drift(&left, &beside, &spectra);
    let steps = steps(assembly);
    let slow = Extent::of(&left, &steps, fastest(campaign), spectra);
    Noise::of(&calm, &steps, freedom, &left_out, |r, k| slow.power(r, k))
}

/// Scores of every law beside a fitted model.
pub(super) fn scores(assembly: &Assembly, data: Data, unit: &[f64], settings: &Settings) -> Vec<Score> {
    let Some(null) = Null::new(assembly, data, unit) else { return Vec::new() };
    let named = |e: &&'static dyn Effect| {
        assembly.effects().iter().any(|known| known.about().effect == e.about().effect)
    };
    let laws: Vec<&'static dyn Effect> = settings.laws.iter().copied().filter(|e| !named(e)).collect();
    let mut found: Vec<Score> = laws
        .into_par_iter()
        .enumerate()
        .filter_map(|(i, e)| null.score(e, settings.seed ^ i as u64))
        .collect();
    temper(&mut found, &null, assembly, data, unit, settings.false_alarm);
    found
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

/// Joint fits of the most promising laws, best first.
pub(super) fn candidates<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    scores: &[Score],
    most: usize,
) -> Vec<Candidate<'a>> {
    let Some(null) = Null::new(assembly, data, unit) else { return Vec::new() };
    let (promising, before) = (promising(&null, scores, most), null.point.fitted.left);
    drop(null);
    let mut found: Vec<Candidate> = promising
        .into_par_iter()
        .map(|held| joint(assembly, data, unit, held.score.effect, &held.shape))
        .collect();
    let sort = |found: &mut Vec<Candidate>| found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    sort(&mut found);
    if most >= REFITTED {
        let explained = found.first().map_or(0.0, |best| before - best.fitted.left);
        found.extend(other_laws::of_those_close(assembly, data, unit, scores, &found, explained));
        sort(&mut found);
    }
    let rest = found.split_off(found.len().min(UNBENT));
    found = found.into_par_iter().map(|c| unbent(c, data)).collect();
    found.extend(rest);
    sort(&mut found);
    // In a tie the plainest is named: fewest parameters, then the plainest law of an effect, then what fits best.
    let explained = found.first().map_or(0.0, |best| before - best.fitted.left);
    let best = found.first().map_or(0.0, Candidate::criterion);
    let tied = found.partition_point(|c| c.criterion() <= best + margin(TIE, explained));
    found[..tied].sort_by_key(|c| {
        let behind = ((c.criterion() - best) / NUMERICAL) as usize;
        (c.fitted.parameters(), !c.plainest(), behind, c.place())
    });
    found
}
