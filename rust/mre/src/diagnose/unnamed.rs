//! Smooth forces that no effect of the catalogue has: where one of them, with a coefficient or two, explains more
//! than the effects named, their names are not to be trusted.

use std::f64::consts::TAU;

use super::distribution::chi_square_tail;
use super::screen::Null;
use crate::effect::Scene;

/// Waves over the largest displacement: lowest, highest, and how far apart.
const WAVES: (f64, f64, f64) = (1.25, 10.0, 0.25);
/// Share of a column's square that the projection has to leave.
const SMALLEST_SHARE: f64 = 1e-6;

/// Terms of displacement and velocity together, of unit size.
const TERMS: [fn(f64, f64) -> f64; 4] =
    [|x, v| x * v, |x, v| x * x * v, |x, v| x.abs() * v, |x, v| x * v * v];

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
    let single = TERMS.iter().map(|term| {
        let of = |i: usize, scene: &Scene| {
            let (x, v) = state(i, scene);
            term(x, v)
        };
        let gain = gain(null, &[&of]);
        (chi_square_tail(gain, 1), gain - cost)
    });
    let (low, high, apart) = WAVES;
    let count = ((high - low) / apart).round() as usize;
    let waves = (0..=count).map(|k| {
        let wave = TAU * (low + apart * k as f64);
        let sine = |i: usize, scene: &Scene| (wave * state(i, scene).0).sin();
        let cosine = |i: usize, scene: &Scene| (wave * state(i, scene).0).cos();
        let gain = gain(null, &[&sine, &cosine]);
        // The length of the wave is a parameter too.
        (chi_square_tail(gain, 2), gain - 3.0 * cost)
    });
    let tests = TERMS.len() + count + 1;
    let mut found = Unnamed::NONE;
    for (p, improvement) in single.chain(waves) {
        found.p_value = found.p_value.min(p * tests as f64);
        found.improvement = found.improvement.max(improvement);
    }
    found
}

/// Squared standard deviations that one or two columns take off.
fn gain(null: &Null, columns: &[Force]) -> f64 {
    let (gram, right, squares) = null.project(columns.len(), |r| {
        let scene = null.scene(r);
        let of = |column: &Force| (0..scene.len()).map(|i| column(i, &scene)).collect();
        columns.iter().map(of).enumerate().collect()
    });
    if (0..columns.len()).any(|i| gram[(i, i)] <= SMALLEST_SHARE * squares[i]) {
        return 0.0;
    }
    gram.cholesky().map_or(0.0, |factor| right.dot(&factor.solve(&right)))
}
