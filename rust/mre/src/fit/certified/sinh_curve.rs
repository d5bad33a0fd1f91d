//! The sinh problem as a curve: the least cost over the linear coefficients, as a function of beta.
//!
//! In the coordinates of a triangular factor the residual is `F - c0 v - F0 1 - k0 x - alpha w(b)` with
//! `b = beta xm`. Only w depends on b, and all but the first three coordinates belong to w and F alone.

use std::sync::Arc;

use crate::fit::bounded::factor;
use crate::fitness::Problem;
use crate::kernel::SinhCompressed;
use crate::kernel::bessel::MOST_NODES;
use crate::kernel::elementary::sinh;
use crate::kernel::sinh_compressed::farthest;
use crate::kernel::triangle::{ROWS, Triangle};
use crate::recording::Recording;

/// Most coordinates: those of the largest factor.
pub(crate) const MOST: usize = MOST_NODES + 3;
/// A vector in the coordinates of the factor.
pub(crate) type Vector = [f64; MOST];
/// Derivatives of w that can be asked for, itself included.
pub(crate) const DERIVATIVES: usize = 4;

/// The curve of a problem.
#[derive(Debug)]
pub(crate) struct Curve<'a> {
    problem: &'a Problem,
    source: Source<'a>,
    /// Largest displacement, mm.
    pub(crate) farthest: f64,
    /// Lower bounds of c0, F0, k0, alpha.
    pub(crate) lower: [f64; 4],
    /// Upper bounds of c0, F0, k0, alpha.
    pub(crate) upper: [f64; 4],
}

#[derive(Debug)]
enum Source<'a> {
    Shared(&'a SinhCompressed),
    Own(Box<SinhCompressed>),
    /// Columns sample by sample: b is too large for a compressed factor.
    Samples,
}

/// The coordinates at one b.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    /// Coordinates in use.
    pub(crate) used: usize,
    /// v, 1, x: zero after the first three.
    pub(crate) base: [[f64; 3]; 3],
    pub(crate) target: Vector,
    /// w and its derivatives in b, divided by `scale`.
    pub(crate) w: [Vector; DERIVATIVES],
    pub(crate) scale: f64,
}

/// The best linear coefficients at one b.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) b: f64,
    /// c0, F0, k0, alpha.
    pub(crate) u: [f64; 4],
    pub(crate) cost: f64,
    /// Derivative of the least cost in b. Bounds in force do not change its form.
    pub(crate) slope: f64,
    pub(crate) residual: Vector,
}

impl<'a> Curve<'a> {
    pub(crate) fn new(problem: &'a Problem) -> Self {
        let (low, high) = (problem.bounds().lower(), problem.bounds().upper());
        let largest = low[3].abs().max(high[3].abs());
        let own = || SinhCompressed::new(problem.recordings(), problem.weights(), largest);
        let source = match problem.compressed() {
            Some(compressed) => Source::Shared(compressed),
            None => own().map_or(Source::Samples, |c| Source::Own(Box::new(c))),
        };
        let pick = |from: &[f64]| [from[0], from[4], from[1], from[2]];
        let farthest = match &source {
            Source::Shared(compressed) => compressed.farthest(),
            Source::Own(compressed) => compressed.farthest(),
            // Scored samples that do not move: any length does.
            Source::Samples => match farthest(problem.recordings()) {
                0.0 => 1.0 / high[3],
                far => far,
            },
        };
        Self { problem, source, farthest, lower: pick(low), upper: pick(high) }
    }

    /// True where a point costs the same for any number of samples.
    pub(crate) fn is_compressed(&self) -> bool {
        !matches!(self.source, Source::Samples)
    }

    /// Values in the order of the problem.
    pub(crate) fn values(&self, point: &Point) -> Vec<f64> {
        let [c0, f0, k0, alpha] = point.u;
        vec![c0, k0, alpha, point.b / self.farthest, f0]
    }

    /// w and its derivatives up to the one before `count`.
    pub(crate) fn columns(&self, b: f64, count: usize) -> Columns {
        match &self.source {
            Source::Shared(compressed) => self.compressed(compressed, b, count),
            Source::Own(compressed) => self.compressed(compressed, b, count),
            Source::Samples => self.sampled(b, count),
        }
    }

    fn compressed(&self, on: &SinhCompressed, b: f64, count: usize) -> Columns {
        let triangle = on.triangle();
        let mut columns = self.empty(triangle, triangle.columns() - 1, 1.0);
        let mut orders = on.bessel().all(b);
        for w in &mut columns.w[..count] {
            on.series(&orders, w);
            let before = orders; // 2 I_n' = I_(n-1) + I_(n+1)
            for k in 0..orders.len() {
                let above = before.get(k + 1).unwrap_or(&0.0);
                orders[k] = 0.5 * (before[k.abs_diff(1)] + above);
            }
        }
        columns
    }

    fn sampled(&self, b: f64, count: usize) -> Columns {
        let scale = (-b).exp();
        let mut triangle = Triangle::new(4 + count);
        for (recording, weight) in self.problem.recordings().iter().zip(self.problem.weights()) {
            self.add(&mut triangle, recording, weight.sqrt(), b, scale);
        }
        let mut columns = self.empty(&triangle, 3, 1.0 / scale);
        for (k, w) in columns.w[..count].iter_mut().enumerate() {
            for (i, w) in w[..4 + count].iter_mut().enumerate() {
                *w = triangle.at(i, 4 + k);
            }
        }
        columns
    }

    /// Rows `[v, 1, t, F, sinh(b t), t cosh(b t), t^2 sinh(b t), ...]`, hyperbolic functions scaled.
    fn add(&self, triangle: &mut Triangle, recording: &Arc<Recording>, weight: f64, b: f64, scale: f64) {
        let (scored, force) = (recording.scored(), recording.force().unwrap_or_default());
        for first in scored.clone().step_by(ROWS) {
            let rows = (scored.end - first).min(ROWS);
            triangle.absorb(rows, |block| {
                for i in 0..rows {
                    let t = recording.displacement()[first + i] / self.farthest;
                    let row = [recording.velocity()[first + i], 1.0, t, force[first + i]];
                    let turn = [sinh(b * t) * scale, (b * t).cosh() * scale];
                    let hyperbolic = (0..).map(|k| t.powi(k) * turn[k as usize % 2]);
                    let columns = block.chunks_exact_mut(ROWS);
                    for (column, value) in columns.zip(row.into_iter().chain(hyperbolic)) {
                        column[i] = weight * value;
                    }
                }
            });
        }
    }

    fn empty(&self, triangle: &Triangle, target: usize, scale: f64) -> Columns {
        let size = [1.0, 1.0, self.farthest];
        let mut columns = Columns {
            used: triangle.columns(),
            base: std::array::from_fn(|i| std::array::from_fn(|j| triangle.at(i, j) * size[j])),
            target: [0.0; MOST],
            w: [[0.0; MOST]; DERIVATIVES],
            scale,
        };
        for (i, to) in columns.target[..triangle.columns()].iter_mut().enumerate() {
            *to = triangle.at(i, target);
        }
        columns
    }

    /// The best linear coefficients at b.
    pub(crate) fn point(&self, b: f64) -> Point {
        self.solve(b, &self.columns(b, 2))
    }

    /// The best linear coefficients in these coordinates.
    pub(crate) fn solve(&self, b: f64, on: &Columns) -> Point {
        let (w, target) = (&on.w[0][..on.used], &on.target[..on.used]);
        let height = dot(&w[3..], &w[3..]).sqrt();
        let beyond = if height > 0.0 { dot(&w[3..], &target[3..]) / height } else { 0.0 };
        let mut r = [[0.0; 4]; 4];
        for i in 0..3 {
            r[i][..3].copy_from_slice(&on.base[i]);
            r[i][3] = w[i];
        }
        r[3][3] = height;
        let (mut lower, mut upper) = (self.lower, self.upper);
        (lower[3], upper[3]) = (lower[3] * on.scale, upper[3] * on.scale);
        let mut u = factor::minimise(&r, &[target[0], target[1], target[2], beyond], &lower, &upper);
        let mut residual = [0.0; MOST];
        for i in 0..on.used {
            residual[i] = target[i] - u[3] * w[i];
            if i < 3 {
                residual[i] -= dot(&on.base[i], &u[..3]);
            }
        }
        let slope = -2.0 * u[3] * dot(&residual, &on.w[1]);
        u[3] = (u[3] / on.scale).clamp(self.lower[3], self.upper[3]);
        Point { b, u, cost: dot(&residual, &residual), slope, residual }
    }
}

/// Scalar product over the shorter length.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
