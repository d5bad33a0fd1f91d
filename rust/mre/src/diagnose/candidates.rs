//! Candidates: every law of the catalogue is scored beside a fitted model, and the strongest are refitted
//! together with it.

use rayon::prelude::*;

use super::above::fastest;
use super::coherent::without_the_coherent;
use super::drift::{beside, without_drift};
use super::extrapolated::{Beside, Extent};
use super::gaps::LeftOut;
use super::held::Held;
use super::joint::{joint, unbent};
use super::least_squares::{Data, Fitted};
use super::noise::Noise;
use super::null::Null;
use super::plain_mismatch;
use super::point::forces;
use super::screen::Score;
use super::search::REFITTED;
use super::settings::Settings;
use super::slow::temper;
use super::starts::{calm, without_initial_state};
use crate::assembly::{Assembly, Campaign};
use crate::effect::{About, CATALOGUE, Effect, Flexibility};
use crate::parameter::Parameter;

/// The best of them are also fitted from other shapes of the base.
const UNBENT: usize = 2;
/// Candidates closer than this in the criterion fit about equally well.
const TIE: f64 = 4.0;
/// Differences in the criterion below this come from where a fit stops.
const NUMERICAL: f64 = 0.1;
/// No law is exact: a difference below this share of what a candidate explains is no reason to prefer it.
const EXACT: f64 = 3e-5;
/// Laws of one effect that are fitted jointly.
const LAWS_EACH: usize = 2;
/// A law whose score is below this share of the best is not looked at further.
const PROMISING: f64 = 0.1;
/// What gives way in series is looked at where one of its laws has a smaller p-value.
const SEEN: f64 = 1e-3;
/// A law that takes off less than this share of the best, the model's tangents held, is not fitted jointly.
const CLOSE: f64 = 0.4;

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
        let last = self.assembly.effects().len().checked_sub(1);
        last.map_or(self.criterion(), |last| smallest(&self.assembly, &self.fitted, last))
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
    let sizes = assembly.campaign().sizes();
    let counts: Vec<usize> = assembly.effects().iter().map(|e| e.shape(sizes).len()).collect();
    let (after, own) = (counts.iter().skip(place + 1).sum(), counts.get(place).copied().unwrap_or(0));
    let idle =
        |(p, unit): &(&Parameter, &f64)| (**unit <= 0.0 && p.ideal.lower) || (**unit >= 1.0 && p.ideal.upper);
    let shapes = assembly.shapes();
    let idle = shapes.iter().zip(&fitted.unit).rev().skip(after).take(own).filter(idle).count();
    fitted.criterion() - fitted.price() * idle as f64
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

/// The laws that are worth a joint fit, strongest first: a few of each effect, so that the many laws of one do
/// not crowd out the others.
fn promising<'s>(null: &Null, scores: &'s [Score], most: usize) -> Vec<Held<'s>> {
    let best = scores.iter().map(|s| s.gain).fold(0.0, f64::max);
    let mut refined: Vec<Held> = scores
        .par_iter()
        .filter(|s| s.gain > 0.0 && s.p_value < 0.5 && s.gain >= PROMISING * best)
        .map(|s| null.held(s))
        .collect();
    let best = refined.iter().map(|held| held.gain).fold(0.0, f64::max);
    // What changes the motion or the force acts on the model as it will be, not as it is: where much is missing, its
    // direction tells more than its size beside the tangents.
    let gain = |held: &Held| {
        if held.score.effect.coefficients().is_empty() { held.gain.max(held.score.gain) } else { held.gain }
    };
    let price = null.point.fitted.price();
    let size = |held: &Held| held.score.parameters();
    let paid = |held: &Held| gain(held) - price * size(held) as f64;
    refined.sort_by(|a, b| paid(b).total_cmp(&paid(a)));
    let mut kept: Vec<Held> = Vec::new();
    for held in refined {
        let id = held.score.effect.about().effect;
        let alike: Vec<&Held> = kept.iter().filter(|k| k.score.effect.about().effect == id).collect();
        // A simpler law that does as well may decide a tie.
        let simpler = alike.iter().all(|k| size(&held) < size(k) && paid(&held) > paid(k) - TIE);
        if (alike.len() < LAWS_EACH || simpler) && gain(&held) >= CLOSE * best && kept.len() < most {
            kept.push(held);
        }
    }
    if most >= REFITTED {
        kept.extend(in_series(null, scores, &kept));
    }
    kept
}

/// The plainest law of what gives way in series with a hysteretic base, unless one is there: behind it the base is
/// another, of which its tangents as it is tell little.
fn in_series<'s>(null: &Null, scores: &'s [Score], kept: &[Held]) -> Option<Held<'s>> {
    let gives_way =
        |score: &Score| score.effect.flexibility(&score.start).is_some_and(Flexibility::gives_way);
    let base = null.assembly().base();
    if base.groups().is_empty() || !base.is_hysteretic() || kept.iter().any(|held| gives_way(held.score)) {
        return None;
    }
    let mut of_them = scores.iter().filter(|score| gives_way(score));
    // Where no law of it is seen, it could not enter.
    let seen = of_them.clone().any(|score| score.p_value < SEEN);
    let score = of_them.next().filter(|_| seen)?;
    Some(Held { score, shape: score.start.clone(), gain: score.gain })
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
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    let rest = found.split_off(found.len().min(UNBENT));
    found = found.into_par_iter().map(|c| unbent(c, data)).collect();
    found.extend(rest);
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
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
