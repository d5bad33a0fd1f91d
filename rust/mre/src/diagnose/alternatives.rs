//! A or B: effects that the recordings cannot tell from one that was named.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::candidates::{Candidate, candidates, scores};
use super::held::Held;
use super::joint::joint;
use super::least_squares::Data;
use super::next_test::Rival;
use super::null::Null;
use super::screen::Score;
use super::search::{Named, REFITTED, Search};

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
    let own = named.fitted.criterion();
    let other = |model: Candidate<'a>| {
        let about = model.assembly.effects().last()?.about();
        (about != known).then_some(Rival { effect: about.effect, place, model })
    };
    let best = candidates(&without.assembly, data, unit, &scored, REFITTED);
    let mut found: Vec<Rival> = best.into_iter().filter_map(other).collect();
    let within = |far: f64| {
        let near = found.iter().filter(move |r| r.model.criterion() <= own + far && r.effect != known.effect);
        near.map(|r| r.effect)
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
    found.retain(|rival| rival.effect == known.effect || close.contains(&rival.effect));
    // The other laws of the same effects: one of them may be what no test tells from the effect named.
    let law = |rival: &Rival| rival.model.assembly.effects().last().map(|e| e.about().law);
    let others: Vec<&Score> = scored
        .iter()
        .filter(|score| {
            let about = score.effect.about();
            let mut alike = found.iter().filter(|rival| rival.effect == about.effect);
            let doubted = about.effect == known.effect || close.contains(&about.effect);
            doubted && about != known && alike.all(|rival| law(rival) != Some(about.law))
        })
        .collect();
    let null = (!others.is_empty()).then(|| Null::new(&without.assembly, data, unit)).flatten();
    if let Some(null) = null {
        let starts: Vec<Held> = others.into_par_iter().map(|score| null.held(score)).collect();
        drop(null);
        let others: Vec<Candidate> = starts
            .into_par_iter()
            .map(|held| joint(&without.assembly, data, unit, held.score.effect, &held.shape))
            .collect();
        found.extend(others.into_iter().filter_map(other));
    }
    found.sort_by(|a, b| a.model.criterion().total_cmp(&b.model.criterion()));
    let mut laws: BTreeMap<&str, usize> = BTreeMap::new();
    found.retain(|rival| {
        let count = laws.entry(rival.effect).or_default();
        *count += 1;
        *count <= LAWS
    });
    let (rivals, laws) = found.into_iter().partition(|rival| rival.effect != known.effect);
    Alternatives { effects, rivals, laws }
}
