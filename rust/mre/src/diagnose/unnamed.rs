//! Smooth forces that no effect of the catalogue has: where one of them, with a coefficient or two, explains more
//! than the effects named, their names are not to be trusted.

use std::f64::consts::TAU;

use super::distribution::{CAUTION, chi_square_tail};
use super::null::Null;
use super::projection::Projection;
use crate::effect::Scene;

/// Waves over the largest displacement: lowest, highest, and how far apart.
const WAVES: (f64, f64, f64) = (1.25, 10.0, 0.25);
/// Share of a column's square that the projection has to leave.
const SMALLEST_SHARE: f64 = 1e-6;

/// A function of displacement and velocity over their largest.
type Term = fn(f64, f64) -> f64;

/// Terms of displacement and velocity together, of unit size, and whether they are odd. Even ones have a slow
/// part, which slow noise has too: a test of them would find that.
const TERMS: [(Term, bool); 4] =
    [(|x, v| x * v, false), (|x, v| x * x * v, true), (|x, v| x.abs() * v, true), (|x, v| x * v * v, true)];

/// A force at a sample of a recording.
type Force<'f> = &'f dyn Fn(usize, &Scene) -> f64;

/// What smooth forces do beside a fitted model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Unnamed {
    /// Chance of the strongest under the null.
    pub(super) p_value: f64,
    /// The most that one of them improves the whitened Bayesian information criterion.
    pub(super) improvement: f64,
}

impl Unnamed {
    /// No test could be made.
    pub(super) const NONE: Self = Self { p_value: 1.0, improvement: 0.0 };
}

/// Test them all.
pub(super) fn best(null: &Null, rows: usize) -> Unnamed {
    let cost = (rows as f64).ln();
    let sizes = null.assembly().campaign().sizes();
    let state = |i: usize, scene: &Scene| {
        (scene.displacement[i] / sizes.displacement, scene.velocity[i] / sizes.velocity)
    };
    let (mut smallest, mut tests, mut most) = (1.0_f64, 0.0, 0.0_f64);
    let mut heard = |gain: f64| {
        tests += 1.0;
        smallest = smallest.min(chi_square_tail(gain / CAUTION, 1));
    };
    for (term, odd) in TERMS {
        let of = |i: usize, scene: &Scene| {
            let (x, v) = state(i, scene);
            term(x, v)
        };
        let [gain, _] = gains(null, &[&of]);
        most = most.max(gain - cost);
        if odd {
            heard(gain);
        }
    }
    let (low, high, apart) = WAVES;
    for k in 0..=((high - low) / apart).round() as usize {
        let wave = TAU * (low + apart * k as f64);
        let sine = |i: usize, scene: &Scene| (wave * state(i, scene).0).sin();
        let cosine = |i: usize, scene: &Scene| (wave * state(i, scene).0).cos();
        // The length of the wave is a parameter too.
        let [alone, both] = gains(null, &[&sine, &cosine]);
        most = most.max(both - 3.0 * cost);
        heard(alone);
    }
    Unnamed { p_value: (smallest * tests).min(1.0), improvement: most }
}

/// Squared standard deviations that the first column takes off, and all of them; zero where the projection leaves
/// none of one.
fn gains(null: &Null, columns: &[Force]) -> [f64; 2] {
    let projected = null.project(columns.len(), |view, r| {
        let scene = view.scene(r);
        let of = |column: &Force| (0..scene.len()).map(|i| column(i, &scene)).collect();
        columns.iter().map(of).enumerate().collect()
    });
    let Projection { gram, right, tame, squares, .. } = &projected;
    let left = |i: usize| gram[(i, i)] > SMALLEST_SHARE * squares[i];
    let first = if left(0) { projected.strength(0).powi(2) } else { 0.0 };
    let all = (0..columns.len()).all(left).then(|| gram.clone().cholesky()).flatten();
    [first, all.map_or(0.0, |factor| right.dot(&factor.solve(right)).min(tame.dot(&factor.solve(tame))))]
}
