//! A or B: effects that the recordings cannot tell from one that was named.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, scores, smallest};
use super::held::Held;
use super::joint::joint;
use super::least_squares::Data;
use super::next_test::Rival;
use super::null::Null;
use super::screen::Score;
use super::search::{Named, REFITTED, Search};
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
    /// Models of those that fit as well within the noise.
    pub(super) rivals: Vec<Rival<'a>>,
    /// Other laws of the effect named.
    pub(super) laws: Vec<Rival<'a>>,
}

/// Models with another law in the place of an effect that was named: those of other effects, of which one law at least
/// fits as well within the noise, and other laws of the same. A law that only its number of parameters rules out now may
/// be the one that a further test leaves.
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
    let others: Vec<&Score> = scored
        .iter()
        .filter(|score| {
            let about = score.effect.about();
            let in_doubt = about.effect == known.effect || doubted.contains(&about.effect);
            in_doubt && about != known && found.iter().all(|model| model.law() != Some(about))
        })
        .collect();
    let null = (!others.is_empty()).then(|| Null::new(&without.assembly, data, unit)).flatten();
    if let Some(null) = null {
        let starts: Vec<Held> = others.into_par_iter().map(|score| null.held(score)).collect();
        drop(null);
        found.par_extend(
            starts
                .into_par_iter()
                .map(|held| joint(&without.assembly, data, unit, held.score.effect, &held.shape)),
        );
    }
    found.sort_by(|a, b| a.criterion().total_cmp(&b.criterion()));
    let within = |far: f64| {
        let near = found.iter().filter(move |model| model.as_the_smallest() <= own + far);
        near.filter_map(Candidate::added).filter(|effect| *effect != known.effect)
    };
    let mut close: Vec<&'static str> = Vec::new();
    for effect in within(APART) {
        if !close.contains(&effect) {
            close.push(effect);
        }
    }
    // Of those that are nearly as good the best.
    let mut effects = close.clone();
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
        if *count <= LAWS && (effect == known.effect || close.contains(&effect)) {
            rivals.push(Rival { effect, place, model });
        }
    }
    let (rivals, laws) = rivals.into_iter().partition(|rival| rival.effect != known.effect);
    Alternatives { effects, rivals, laws }
}

/// Effects that may come within a criterion: some law of theirs would, had it no more parameters than the plainest. A
/// larger law that takes the place of a plain one among those that are fitted leaves no more than that, at a higher price.
fn doubted(found: &[Candidate], scored: &[Score], limit: f64) -> Vec<&'static str> {
    let spared = |model: &Candidate| {
        let of_effect = scored.iter().filter(|score| Some(score.effect.about().effect) == model.added());
        let fewest = of_effect.map(Score::parameters).min();
        let own =
            scored.iter().find(|score| Some(score.effect.about()) == model.law()).map(Score::parameters);
        own.zip(fewest).map_or(0, |(own, fewest)| own - fewest)
    };
    let could = |model: &&Candidate| model.criterion() - model.fitted.price() * spared(model) as f64 <= limit;
    found.iter().filter(could).filter_map(Candidate::added).collect()
}
