//! Laws that were not fitted of effects that come close. Which laws of an effect are fitted first is told by their gains beside
//! a model that bends along its tangents only, and the best may be among the others.

use rayon::prelude::*;

use super::candidates::Candidate;
use super::joint::joint;
use super::least_squares::Data;
use super::null::Null;
use super::screen::Score;
use crate::assembly::Assembly;
use crate::effect::Effect;

/// An effect is taken to have no law that is better where those fitted are further behind than this share of what the best
/// explains.
const BEHIND: f64 = 0.01;
/// Effects beside the best whose other laws are fitted.
const EFFECTS: usize = 3;

/// Joint fits of the other laws of the best effect found and of those that come close to it, where some do.
pub(super) fn of_those_close<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    scores: &[Score],
    found: &[Candidate<'a>],
    explained: f64,
) -> Vec<Candidate<'a>> {
    let (Some(best), behind) = (found.first(), BEHIND * explained) else { return Vec::new() };
    let mut close = doubted(found, scores, best.criterion() + behind);
    // Where so little is explained, laws differ by chance.
    if close.len() < 2 || behind < 1.0 {
        return Vec::new();
    }
    close.truncate(1 + EFFECTS);
    fits(assembly, data, unit, &unfitted(scores, found, |effect| close.contains(&effect)))
}

/// Effects that may come within a criterion, best first: some law of theirs would, had it no more parameters than the
/// plainest. A larger law that takes the place of a plain one among those that are fitted leaves no more than that, at a
/// higher price.
pub(super) fn doubted(found: &[Candidate], scores: &[Score], limit: f64) -> Vec<&'static str> {
    let spared = |model: &Candidate| {
        let of_effect = scores.iter().filter(|score| Some(score.effect.about().effect) == model.added());
        let fewest = of_effect.map(Score::parameters).min();
        let own =
            scores.iter().find(|score| Some(score.effect.about()) == model.law()).map(Score::parameters);
        own.zip(fewest).map_or(0, |(own, fewest)| own - fewest)
    };
    let could = |model: &&Candidate| model.criterion() - model.fitted.price() * spared(model) as f64 <= limit;
    each_once(found.iter().filter(could).filter_map(Candidate::added))
}

/// Laws of some effects that are not among the fits.
pub(super) fn unfitted<'s>(
    scores: &'s [Score],
    found: &[Candidate],
    of: impl Fn(&'static str) -> bool,
) -> Vec<&'s Score> {
    let unfitted = |score: &&Score| {
        let about = score.effect.about();
        of(about.effect) && found.iter().all(|model| model.law() != Some(about))
    };
    scores.iter().filter(unfitted).collect()
}

/// Joint fits of laws that were scored, from shapes refined beside the model.
pub(super) fn fits<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    laws: &[&Score],
) -> Vec<Candidate<'a>> {
    fits_from(assembly, data, unit, laws, |null, score| Some((score.effect, null.held(score).shape)))
}

/// Joint fits of some laws from starts that a null gives; those without one are left out.
pub(super) fn fits_from<'a, L: Sync>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    laws: &[L],
    start: impl Fn(&Null, &L) -> Option<(&'static dyn Effect, Vec<f64>)> + Sync,
) -> Vec<Candidate<'a>> {
    if laws.is_empty() {
        return Vec::new();
    }
    let Some(null) = Null::new(assembly, data, unit) else { return Vec::new() };
    let starts: Vec<_> = laws.par_iter().filter_map(|law| start(&null, law)).collect();
    // Its samples are many, and not needed any more.
    drop(null);
    starts.into_par_iter().map(|(effect, shape)| joint(assembly, data, unit, effect, &shape)).collect()
}

/// Each effect once, in order.
pub(super) fn each_once(effects: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut once = Vec::new();
    for effect in effects {
        if !once.contains(&effect) {
            once.push(effect);
        }
    }
    once
}
