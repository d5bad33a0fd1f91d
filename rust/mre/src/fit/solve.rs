//! The exact optimum of a problem, and the hybrid of a swarm with it.

use std::sync::atomic::AtomicBool;

use super::certified::{self, Kind};
use super::descent::{Point, descend};
use super::projection::Projection;
use crate::error::Result;
use crate::fitness::Problem;
use crate::swarm::{Budget, FishSettings, FishSwarm, History, Monitor, StopReason, Swarm, run};

/// Points of the first scan along each shape, by the number of shapes.
const SCAN: [usize; 4] = [0, 64, 12, 6];
/// Places of the scan from which is descended.
const STARTS: usize = 4;

/// Outcome of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// All parameters, in the problem's order.
    pub values: Vec<f64>,
    /// Their fitness in N^2.
    pub cost: f64,
    /// Shapes for which the best coefficients were found.
    pub evaluations: u64,
    /// Why the fit stopped.
    pub reason: StopReason,
    /// History of the swarm, if there was one.
    pub history: History,
}

/// The best parameters in the box: over the whole interval of beta where the model has no other shape,
/// else by a scan of the shapes and descent from the best places, coefficients solved exactly.
///
/// After `cancel` is set it ends soon, with the best so far.
pub fn exact(problem: &Problem, cancel: &AtomicBool) -> Fit {
    let certified::Exact { values, cost, evaluations } = match Kind::of(problem) {
        Kind::Linear => certified::linear(problem),
        Kind::Sinh => certified::sinh(problem),
        Kind::Other => return scan_and_descend(problem, cancel),
    };
    Fit { values, cost, evaluations, reason: StopReason::Iterations, history: History::default() }
}

fn scan_and_descend(problem: &Problem, cancel: &AtomicBool) -> Fit {
    let projection = Projection::new(problem, cancel);
    let d = projection.dimension();
    if d == 0 {
        return polish(problem, &projection, Vec::new(), 0.0, 1, StopReason::Iterations);
    }
    let mut scan = Vec::new();
    let per_axis = SCAN.get(d).copied().unwrap_or(5);
    for code in 0..per_axis.pow(d as u32) {
        scan.extend(
            (0..d)
                .map(|i| (code / per_axis.pow(i as u32) % per_axis) as f64 + 0.5)
                .map(|k| k / per_axis as f64),
        );
    }
    let values = projection.rough().costs(&scan);
    let mut points: Vec<Point> = values
        .iter()
        .enumerate()
        .map(|(i, v)| Point { at: scan[i * d..(i + 1) * d].to_vec(), value: *v })
        .collect();
    points.sort_by(|a, b| a.value.total_cmp(&b.value));
    let mut starts = separate(&points, 1.5 / per_axis as f64);
    let places: Vec<f64> = starts.iter().flat_map(|start| start.at.clone()).collect();
    for (start, cost) in starts.iter_mut().zip(projection.costs(&places)) {
        start.value = cost;
    }
    polish(
        problem,
        &projection,
        starts,
        0.5 / per_axis as f64,
        (values.len() + places.len() / d) as u64,
        StopReason::Iterations,
    )
}

/// The best parameters in the box, from a start near them: exact where [`exact`] is, else by descent.
///
/// After `cancel` is set it ends soon, with the best so far.
pub(crate) fn refit(problem: &Problem, start: &[f64], cancel: &AtomicBool) -> Vec<f64> {
    if let Ok(found) = certified::exact(problem) {
        return found.values;
    }
    let projection = Projection::new(problem, cancel);
    if projection.dimension() == 0 {
        return projection.solve(&[]).0;
    }
    let at = projection.unit_shapes(start);
    let value = projection.solve(&at).1;
    polish(problem, &projection, vec![Point { at, value }], 0.02, 1, StopReason::Iterations).values
}

/// MAFSA over the shapes with exact coefficients, then descent; with all its iterations never above [`exact`].
///
/// # Errors
/// A setting outside its range.
pub fn hybrid(
    problem: &Problem,
    settings: FishSettings,
    seed: u64,
    start: Option<&[f64]>,
    budget: &Budget,
    monitor: &mut dyn Monitor,
    cancel: &AtomicBool,
) -> Result<Fit> {
    let projection = Projection::new(problem, cancel);
    let d = projection.dimension();
    if d == 0 {
        settings.check()?;
        return Ok(exact(problem, cancel));
    }
    let start = start.map(|parameters| projection.unit_shapes(parameters));
    let mut swarm = FishSwarm::new(settings, d, seed, start.as_deref())?;
    let mut seen: Vec<Point> = Vec::new();
    let mut evaluate = |rows: &[f64], costs: &mut [f64]| {
        costs.copy_from_slice(&projection.costs(rows));
        seen.extend(
            rows.chunks_exact(d).zip(costs.iter()).map(|(row, c)| Point { at: row.to_vec(), value: *c }),
        );
    };
    let reason = run(&mut swarm, &mut evaluate, d, budget, monitor);
    seen.sort_by(|a, b| a.value.total_cmp(&b.value));
    let starts = separate(&seen, 0.1);
    let mut fit = polish(problem, &projection, starts, 0.02, swarm.bulletin().evaluations, reason);
    if reason == StopReason::Iterations {
        // Where the hysteresis is as small as the noise, a small swarm can miss the best of several minima.
        let scanned = exact(problem, cancel);
        fit.evaluations += scanned.evaluations;
        if scanned.cost < fit.cost {
            (fit.values, fit.cost) = (scanned.values, scanned.cost);
        }
    }
    Ok(Fit { history: swarm.history().clone(), ..fit })
}

/// The best of sorted points that are not near a better one.
fn separate(sorted: &[Point], distance: f64) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for point in sorted {
        let near = |other: &Point| point.at.iter().zip(&other.at).all(|(a, b)| (a - b).abs() < distance);
        if kept.len() < STARTS && point.value.is_finite() && !kept.iter().any(near) {
            kept.push(point.clone());
        }
    }
    kept
}

fn polish(
    problem: &Problem,
    projection: &Projection,
    starts: Vec<Point>,
    radius: f64,
    mut evaluations: u64,
    reason: StopReason,
) -> Fit {
    let values = |rows: &[f64]| projection.costs(rows);
    let (best, more) = descend(starts, radius, &|rows| projection.models(rows), &values);
    evaluations += more;
    let shapes = best.map_or_else(
        || vec![0.5; projection.dimension()],
        |best| {
            let (refined, more) = projection.refine(best);
            evaluations += more;
            refined.at
        },
    );
    let (values, _) = projection.solve(&shapes);
    // The cost as every other result has it, not through the normal equations.
    let mut cost = [0.0];
    problem.fitness(&values, &mut cost, &AtomicBool::new(false));
    Fit { values, cost: cost[0], evaluations, reason, history: History::default() }
}
