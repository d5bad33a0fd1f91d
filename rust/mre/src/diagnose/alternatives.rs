//! A or B: effects that the recordings cannot tell from one that was named.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, scores, smallest};
use super::intervals::estimates;
use super::least_squares::{Data, Fitted};
use super::next_test::Rival;
use super::noise::Noise;
use super::other_laws::{doubted, each_once, fits, unfitted};
use super::search::{Named, REFITTED, Search};
use super::shaken::{MOST as MOST_OF_NOISE, left_by_noise};
use super::strained::strained;
use crate::effect::About;

/// A rival that leaves less than this much more (in squared standard deviations, a parameter's price
/// included) cannot be told apart: the odds against it are below 150 to 1.
pub(super) const APART: f64 = 10.0;

/// Effects that are listed beside the one named at most, where its law is not exact.
const MOST: usize = 2;

/// Laws of an effect that a further test is imagined with at most: those that fit best.
const LAWS: usize = 10;

/// What may stand in the place of an effect that was named.
pub(super) struct Alternatives<'a> {
    /// Ids of effects that cannot be told from it.
    pub(super) effects: Vec<&'static str>,
    /// Models of those.
    pub(super) rivals: Vec<Rival<'a>>,
    /// Other laws of the effect named.
    pub(super) laws: Vec<Rival<'a>>,
}

/// Models with another law in the place of an effect that was named: those of other effects, of which one law at least
/// fits as well within the noise or nearly where no law is exact, and other laws of the same. A law that only its number of
/// parameters rules out now may be the one that a further test leaves.
///
/// `left` is what the model named leaves beyond chance, in squared standard deviations: where no law is exact, one that
/// leaves less than twice as much may be nearer to the truth all the same.
pub(super) fn rivals<'a>(
    search: &Search<'_, 'a>,
    named: &Named<'a>,
    place: usize,
    left: f64,
    data: Data,
) -> Alternatives<'a> {
    let without = search.drop(named, place);
    let known = named.assembly.effects()[place].about();
    let unit = &without.fitted.unit;
    let scored = scores(&without.assembly, data, unit, search.settings);
    let own = smallest(&named.assembly, &named.fitted, place);
    let mut found = candidates(&without.assembly, data, unit, &scored, REFITTED);
    let doubted = doubted(&found, &scored, own + APART);
    let in_doubt = |effect| effect == known.effect || doubted.contains(&effect);
    let mut others = unfitted(&scored, &found, in_doubt);
    others.retain(|score| score.effect.about() != known);
    found.extend(fits(&without.assembly, data, unit, &others));
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    let as_rival = |model: &Candidate| {
        let paid = model.as_the_smallest();
        let apart = model.added() != Some(known.effect) && paid > own + APART;
        if apart && fits_better(model, &named.fitted, data) { own } else { paid }
    };
    let of_noise = left_by_noise(&named.assembly, data, &named.fitted);
    // A filter smooths noise of the motion or of the current that a delay follows, whichever is true.
    let behind = |model: &Candidate| {
        let far = as_rival(model) - own;
        if far <= APART {
            return far;
        }
        let more = left_by_noise(&model.assembly, data, &model.fitted) - of_noise;
        far - MOST_OF_NOISE * more.max(0.0)
    };
    let behind: Vec<f64> = found.par_iter().map(behind).collect();
    let within = |far: f64| {
        let near = found.iter().zip(&behind).filter(move |(_, behind)| **behind <= far);
        near.filter_map(|(model, _)| model.added()).filter(|effect| *effect != known.effect)
    };
    let mut effects = each_once(within(APART));
    // Of those that are nearly as good the best.
    for effect in within(left) {
        if effects.len() < MOST && !effects.contains(&effect) {
            effects.push(effect);
        }
    }
    let mut laws: BTreeMap<&str, usize> = BTreeMap::new();
    let mut rivals: Vec<Rival> = Vec::new();
    for model in found {
        let Some(About { effect, .. }) = model.law().filter(|about| *about != known) else { continue };
        let count = laws.entry(effect).or_default();
        *count += 1;
        if *count <= LAWS && (effect == known.effect || effects.contains(&effect)) {
            rivals.push(Rival { effect, place, model });
        }
    }
    let (rivals, laws) = rivals.into_iter().partition(|rival| rival.effect != known.effect);
    Alternatives { effects, rivals, laws }
}

/// True where a model leaves less by Akaike's criterion: what a parameter costs where one law is to be named says little of
/// which is true (IEEE Trans. Autom. Control 19 (1974) 716). Not so where its law is pressed to an end of its range, or the
/// parameter that makes it this effect cannot be told from nothing: there it is a larger form of another.
fn fits_better(model: &Candidate, known: &Fitted, data: Data) -> bool {
    let better = model.fitted.beyond_chance() < known.beyond_chance();
    if !better || !may_fit_better(model, data.noise) {
        return false;
    }
    let last = model.assembly.effects().len() - 1;
    strained(&model.assembly, &estimates(&model.assembly, data, &model.fitted.unit), last).is_empty()
}

/// True where a better fit may speak for a last law with more parameters: likelihoods of a noise that is not known say
/// nothing so fine, and a column in every recording fits better by its number.
pub(super) fn may_fit_better(model: &Candidate, noise: &Noise) -> bool {
    let law = model.assembly.effects().last();
    !noise.hidden() && law.is_some_and(|law| !law.of_the_measurement())
}
