//! Proof that no parameters in the box are better than those found.
//!
//! For any unit vector y and any candidate u, `||F - D(b) u|| >= y (F - D(b) u)`, which is linear in the
//! coefficients. Over an interval of b and the box it is at least
//! `y F - sum_j max(l_j (y D_j), h_j (y D_j))` over c0, F0, k0, and for alpha the largest of
//! `alpha q(b)`, `q(b) = y w(b)`. With y along the best residual at the middle c of the interval of
//! half width h the bound meets the cost there, and
//! `|q(b) - q(c)| <= |q'(c)| h + |q''(c)| h^2 / 2 + e^h ||w'''(c)|| h^3 / 6`,
//! because `|t^3 cosh(b t)| <= e^|b - c| |t^3 cosh(c t)|` for |t| <= 1 in every sample.
//!
//! A box of alpha far wider than its estimate would make that loose. But alpha alone explains what lies
//! outside the span of v, 1, x: with the tails w, f of the columns there, and `||w(b) - w(c)|| <= rho`,
//! any candidate below a known cost C has `||f - alpha w(c)|| <= sqrt C + |alpha| rho`, which leaves an
//! interval of alpha. Candidates outside it do not go below C.
//!
//! Intervals of b are halved until the bound reaches the cost that was found. True to rounding (about
//! 1e-12 of the cost).

use std::sync::atomic::{AtomicBool, Ordering};

use super::sinh_curve::{Columns, Curve, dot};
use super::{Kind, sinh_exact};
use crate::error::{Error, Result};
use crate::fitness::Problem;

/// Most intervals: some tenths of a second on a compressed problem.
const MOST: u64 = 500_000;
/// The same where every interval takes a pass over the samples.
const MOST_PASSES: u64 = 10_000;
/// Share of the squared force below which a cost is rounding.
const NOTHING: f64 = 1e-26;

/// How much better than what was found any other parameters can be at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// Fitness that nothing in the box can go below, N^2.
    pub lower: f64,
    /// `1 - lower / cost`.
    pub gap: f64,
    /// True where the gap is within what was asked for.
    pub certified: bool,
    /// Intervals of beta that were bounded.
    pub evaluations: u64,
}

/// Bound the fitness from below over the whole box, until the gap to `cost`, the fitness that some
/// parameters have, or to the optimum is within `tolerance` (such as 1e-9), or the effort is spent.
///
/// The linear model needs no search: its cost is convex. After `cancel` is set it ends soon.
///
/// # Errors
/// As [`super::exact`], a cost that is not finite, or a tolerance that is not above 0 and below 1.
pub fn certificate(problem: &Problem, cost: f64, tolerance: f64, cancel: &AtomicBool) -> Result<Certificate> {
    if !(tolerance > 0.0 && tolerance < 1.0) {
        return Err(Error::setting("tolerance", tolerance, "a number above 0 and below 1"));
    }
    if !cost.is_finite() {
        return Err(Error::setting("fitness", cost, "a finite number, as parameters in the box have it"));
    }
    match Kind::of(problem) {
        Kind::Linear => Ok(Certificate::new(cost, super::linear(problem).cost.min(cost), tolerance, 1)),
        Kind::Sinh => Ok(sinh(problem, cost, tolerance, cancel)),
        Kind::Other => Err(super::unknown(problem)),
    }
}

impl Certificate {
    fn new(cost: f64, lower: f64, tolerance: f64, evaluations: u64) -> Self {
        let gap = if cost > lower { 1.0 - lower / cost } else { 0.0 };
        Self { lower, gap, certified: gap <= tolerance, evaluations }
    }
}

fn sinh(problem: &Problem, cost: f64, tolerance: f64, cancel: &AtomicBool) -> Certificate {
    let curve = Curve::new(problem);
    let square = curve.columns(0.0, 1).target.iter().map(|f| f * f).sum::<f64>();
    if cost <= NOTHING * square {
        return Certificate { lower: 0.0, gap: 0.0, certified: true, evaluations: 1 };
    }
    let mut cells: Vec<Cell> = sinh_exact::grid(problem, &curve)
        .windows(2)
        .map(|ends| Cell { low: ends[0], high: ends[1], bound: 0.0 })
        .collect();
    // A bound that no interval can meet would take all the effort: nothing above the optimum is asked for.
    let best = super::sinh(problem).cost.min(cost);
    let wanted = cost * (1.0 - tolerance);
    // Half way, so that roundings do not keep an interval open.
    let enough = if wanted < best { 0.5 * (wanted + best) } else { best * (1.0 - 0.5 * tolerance) };
    let most = if curve.is_compressed() { MOST } else { MOST_PASSES };
    let (mut lower, mut evaluations) = (best, 0);
    while let Some(cell) = cells.pop() {
        if evaluations >= most || cancel.load(Ordering::Relaxed) {
            lower = lower.min(cell.bound);
            continue;
        }
        evaluations += 1;
        let middle = 0.5 * (cell.low + cell.high);
        let bound = bound(&curve, &cell, best).max(cell.bound);
        if bound >= enough || middle <= cell.low || middle >= cell.high {
            lower = lower.min(bound);
        } else {
            cells.push(Cell { low: cell.low, high: middle, bound });
            cells.push(Cell { low: middle, high: cell.high, bound });
        }
    }
    Certificate::new(cost, lower, tolerance, evaluations)
}

/// An interval of b.
#[derive(Debug, Clone, Copy)]
struct Cell {
    low: f64,
    high: f64,
    /// Known lower bound of the cost.
    bound: f64,
}

/// Lower bound of the cost over an interval of b, or `known` if that is less.
fn bound(curve: &Curve<'_>, cell: &Cell, known: f64) -> f64 {
    let (c, h) = (0.5 * (cell.low + cell.high), 0.5 * (cell.high - cell.low));
    let on = curve.columns(c, 4);
    let point = curve.solve(c, &on);
    let norm = point.cost.sqrt();
    if norm == 0.0 {
        return 0.0;
    }
    let third = h.exp() * length(&on.w[3]);
    // How far a function of b goes from its value in the middle.
    let reach = |first: f64, second: f64| h * (first + h * (0.5 * second + h * third / 6.0));
    let along = |column: &[f64]| dot(&point.residual, column) / norm;
    let most = |low: f64, high: f64, slope: f64| (low * slope).max(high * slope);
    let mut bound = along(&on.target);
    for j in 0..3 {
        let column = [on.base[0][j], on.base[1][j], on.base[2][j]];
        bound -= most(curve.lower[j], curve.upper[j], along(&column));
    }
    let (mut low, mut high) = (curve.lower[3] * on.scale, curve.upper[3] * on.scale);
    let rho = reach(length(&on.w[1][3..]), length(&on.w[2][3..]));
    if let Some((middle, width)) = alpha(&on, rho, known) {
        (low, high) = (low.max(middle - width), high.min(middle + width));
        if low > high {
            return known;
        }
    }
    let (q, radius) = (along(&on.w[0]), reach(along(&on.w[1]).abs(), along(&on.w[2]).abs()));
    bound -= most(low, high, q - radius).max(most(low, high, q + radius));
    bound.max(0.0).powi(2).min(known)
}

/// Middle and half width of the scaled alpha of all candidates with a cost below `known`, where w moves
/// by less than `rho`.
fn alpha(on: &Columns, rho: f64, known: f64) -> Option<(f64, f64)> {
    let (w, f) = (&on.w[0][3..on.used], &on.target[3..on.used]);
    let height = length(w);
    if height <= rho {
        return None;
    }
    let middle = dot(w, f) / (height * height);
    let rest: f64 = w.iter().zip(f).map(|(w, f)| (f - middle * w).powi(2)).sum();
    let largest = (middle.abs() * height + known.sqrt()) / (height - rho);
    let room = (known.sqrt() + largest * rho).powi(2) - rest;
    // A little wider, for what rounding does to a difference of nearly equal numbers.
    Some((middle, (room.max(0.0) + 1e-12 * known).sqrt() / height))
}

fn length(vector: &[f64]) -> f64 {
    dot(vector, vector).sqrt()
}
