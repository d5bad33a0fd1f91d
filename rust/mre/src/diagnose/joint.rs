//! Joint fits of a model with one more law.

use rayon::prelude::*;

use super::begin::starts;
use super::candidates::Candidate;
use super::least_squares::{Data, Fitted, refine, refine_at_most};
use crate::assembly::Assembly;
use crate::effect::{Effect, Flexibility};

/// Fits from several starts that are kept after so many steps; the best of the last is fitted to the end.
const STAGES: [(usize, usize); 3] = [(4, 1), (2, 2), (1, 3)];
/// The same from starts of an effect.
const OF_AN_EFFECT: [(usize, usize); 2] = [(3, 2), (1, 6)];
/// Most repetitions of a fit whose effect follows from the force.
const PASSES: usize = 8;
/// They end where what is left changes by no more, in squared standard deviations.
const SETTLED: f64 = 0.01;

/// Joint fit of a model with one more law, from the law's strongest start.
pub(super) fn joint<'a>(
    assembly: &Assembly<'a>,
    data: Data,
    unit: &[f64],
    effect: &'static dyn Effect,
    start: &[f64],
) -> Candidate<'a> {
    let mut effects = assembly.effects().to_vec();
    effects.push(effect);
    let wider = assembly.with(effects);
    let known = assembly.physical(unit);
    let unit = wider.unit(&[known.as_slice(), start].concat());
    if !effect.flexibility(start).is_some_and(Flexibility::gives_way) {
        return fit(wider, data, &unit);
    }
    // The tangents of the model tell little of a rig: behind a soft one the device is another.
    let all: Vec<Vec<f64>> = std::iter::once(unit.clone())
        .chain(of_the_last(&wider, &known))
        .chain(behind_the_last(&wider, &known))
        .collect();
    let best = best_of(&wider, data, all, &OF_AN_EFFECT).map_or(unit, |best| best.unit);
    fit(wider, data, &best)
}

/// Starts of the last effect, beside these physical shapes of what stands before it, in the unit box.
fn of_the_last(assembly: &Assembly, before: &[f64]) -> Vec<Vec<f64>> {
    let starts = assembly.effects().last().map(|effect| effect.starts(assembly.campaign().sizes()));
    starts.unwrap_or_default().iter().map(|start| assembly.unit(&[before, start].concat())).collect()
}

/// Other shapes of a base behind the softest start of a last effect that gives way: a base alone has bent to what the two in
/// series do, to their yield or to less hardening.
fn behind_the_last(assembly: &Assembly, before: &[f64]) -> Vec<Vec<f64>> {
    let Some(effect) = assembly.effects().last() else { return Vec::new() };
    let size = |start: &[f64]| effect.flexibility(start).map_or(0.0, |f| f.size);
    let own = effect.starts(assembly.campaign().sizes()).into_iter();
    let Some(softest) = own.max_by(|a, b| size(a).total_cmp(&size(b))) else { return Vec::new() };
    let unit = assembly.unit(&[before, &softest].concat());
    let others = starts(assembly.base()).into_iter().filter(|start| !start.is_empty());
    others.map(|start| [&start, &unit[start.len()..]].concat()).collect()
}

/// Fit from a point of the unit box; repeated where an effect follows from the force that is fitted.
pub(super) fn fit<'a>(mut assembly: Assembly<'a>, data: Data, unit: &[f64]) -> Candidate<'a> {
    let mut fitted = refine(&assembly, data, unit);
    if assembly.flexibility(&assembly.physical(&fitted.unit)).is_some() {
        for _ in 0..PASSES {
            assembly = assembly.seeing_its_force(&fitted.unit, &fitted.coefficients);
            let before = fitted.left;
            fitted = refine(&assembly, data, &fitted.unit);
            if (fitted.left - before).abs() <= SETTLED {
                break;
            }
        }
    }
    Candidate { assembly, fitted }
}

/// The better of a fit and of fits from other shapes of the base: its own have bent to hide the effect. Those
/// that fall behind are given up early.
pub(super) fn unbent<'a>(candidate: Candidate<'a>, data: Data) -> Candidate<'a> {
    let known = candidate.assembly.base_shapes();
    let running = starts(candidate.assembly.base())
        .into_iter()
        .filter(|start| !start.is_empty())
        .map(|start| start.into_iter().chain(candidate.fitted.unit[known..].iter().copied()).collect())
        .collect();
    better(candidate, data, running, &STAGES)
}

/// The better of a fit and of fits from other shapes of its last effect.
pub(super) fn begun_anew<'a>(candidate: Candidate<'a>, data: Data) -> Candidate<'a> {
    let shapes = candidate.assembly.physical(&candidate.fitted.unit);
    let sizes = candidate.assembly.campaign().sizes();
    let own = candidate.assembly.effects().last().map_or(0, |effect| effect.shape(sizes).len());
    let running = of_the_last(&candidate.assembly, &shapes[..shapes.len() - own]);
    better(candidate, data, running, &OF_AN_EFFECT)
}

fn better<'a>(
    candidate: Candidate<'a>,
    data: Data,
    running: Vec<Vec<f64>>,
    stages: &[(usize, usize)],
) -> Candidate<'a> {
    match best_of(&candidate.assembly, data, running, stages) {
        Some(best) if best.left < candidate.fitted.left => fit(candidate.assembly, data, &best.unit),
        _ => candidate,
    }
}

/// The best of fits from several points of the unit box, not yet at its end: those that fall behind are given up early.
/// Of each stage so many are kept after so many steps.
pub(super) fn best_of(
    assembly: &Assembly,
    data: Data,
    mut running: Vec<Vec<f64>>,
    stages: &[(usize, usize)],
) -> Option<Fitted> {
    let mut best: Option<Fitted> = None;
    for (kept, steps) in stages.iter().copied() {
        let mut fitted: Vec<Fitted> =
            running.par_iter().map(|unit| refine_at_most(assembly, data, unit, steps)).collect();
        fitted.sort_by(|a, b| a.left.total_cmp(&b.left));
        fitted.truncate(kept);
        running = fitted.iter().map(|f| f.unit.clone()).collect();
        best = fitted.into_iter().next();
    }
    best
}
