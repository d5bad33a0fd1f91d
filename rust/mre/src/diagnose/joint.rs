//! Joint fits of a model with one more law.

use rayon::prelude::*;

use super::begin::starts;
use super::candidates::Candidate;
use super::least_squares::{Data, Fitted, refine, refine_at_most};
use crate::assembly::Assembly;
use crate::effect::Effect;

/// Fits from several starts that are kept after so many steps; the best of the last is fitted to the end.
const STAGES: [(usize, usize); 3] = [(4, 1), (2, 2), (1, 3)];
/// The same of a law of rigs.
const OF_A_RIG: [(usize, usize); 2] = [(2, 0), (1, 3)];
/// Repetitions of a fit whose effect follows from the force.
const PASSES: usize = 4;

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
    let at = |start: &[f64]| wider.unit(&[known.as_slice(), start].concat());
    let unit = at(start);
    if effect.flexibility(start).is_none_or(|flexibility| flexibility == 0.0) {
        return fit(wider, data, &unit);
    }
    // The tangents of the model tell little of a rig: behind a soft one the device is another.
    let others = effect.starts(assembly.campaign().sizes());
    let all: Vec<Vec<f64>> =
        std::iter::once(unit.clone()).chain(others.iter().map(|start| at(start))).collect();
    let best = best_of(&wider, data, all, &OF_A_RIG).map_or(unit, |best| best.unit);
    fit(wider, data, &best)
}

/// Fit from a point of the unit box; repeated where an effect follows from the force that is fitted.
pub(super) fn fit<'a>(mut assembly: Assembly<'a>, data: Data, unit: &[f64]) -> Candidate<'a> {
    let mut fitted = refine(&assembly, data, unit);
    if assembly.flexibility(&assembly.physical(&fitted.unit)).is_some() {
        for _ in 0..PASSES {
            assembly = assembly.seeing_its_force(&fitted.unit, &fitted.coefficients);
            fitted = refine(&assembly, data, &fitted.unit);
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
    match best_of(&candidate.assembly, data, running, &STAGES) {
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
