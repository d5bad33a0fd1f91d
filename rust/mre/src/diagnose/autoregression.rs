//! Autoregressions by least squares (covariance method), their order by Akaike's criterion.

use nalgebra::{DMatrix, DVector};

use crate::kernel::filter::dot;

/// Length of the autoregression, s.
const LENGTH: f64 = 0.3;
/// Shortest of the longest, in samples: those of a slow rate have a resonance or a memory of some samples as well.
const SHORTEST: usize = 6;
/// Longest, in samples.
const LONGEST: usize = 100;
/// Samples for each of its coefficients, at least.
const SAMPLES_EACH: usize = 25;
/// White noise beside every other, as a share of its mean square: behind a filter of the recorder there is next to none at some
/// frequencies, and no law, slope or number is so exact.
pub(super) const FLOOR: f64 = 1e-5;
/// Orders that are compared, as shares of the longest.
const ORDERS: [f64; 6] = [0.0, 0.05, 0.12, 0.25, 0.5, 1.0];

/// Products of a residual with itself at all lags (covariance method).
pub(super) struct Products {
    /// Entry (i, j): sum over t of `y[t - i] y[t - j]`, over all complete windows.
    lags: DMatrix<f64>,
    rows: f64,
}

impl Products {
    pub(super) fn of(y: &[f64], step: f64) -> Self {
        let n = y.len();
        let p = ((LENGTH / step).round() as usize).clamp(SHORTEST, LONGEST).min(n / SAMPLES_EACH).max(1);
        let mut lags = DMatrix::zeros(p + 1, p + 1);
        for j in 0..=p {
            lags[(0, j)] = dot(&y[p..], &y[p - j..n - j]);
        }
        // Each diagonal from its predecessor.
        for i in 1..=p {
            for j in i..=p {
                lags[(i, j)] = lags[(i - 1, j - 1)] + y[p - i] * y[p - j] - y[n - i] * y[n - j];
            }
        }
        for i in 0..=p {
            for j in 0..i {
                lags[(i, j)] = lags[(j, i)];
            }
        }
        Self { lags, rows: (n - p) as f64 }
    }

    /// The same with a white noise of a share of the mean square.
    pub(super) fn with_a_floor(&self) -> Self {
        let mut lags = self.lags.clone();
        for i in 0..lags.nrows() {
            lags[(i, i)] *= 1.0 + FLOOR;
        }
        Self { lags, rows: self.rows }
    }

    pub(super) fn order(&self) -> usize {
        self.lags.nrows() - 1
    }

    /// Variance that coefficients leave.
    pub(super) fn variance(&self, a: &[f64]) -> f64 {
        let full = DVector::from_iterator(a.len() + 1, [1.0].into_iter().chain(a.iter().map(|a| -a)));
        let part = self.lags.view((0, 0), (full.len(), full.len()));
        (full.dot(&(part * &full)) / self.rows).max(f64::MIN_POSITIVE)
    }
}

/// An autoregression of some recordings, and Akaike's criterion of it.
pub(super) struct Choice {
    pub(super) coefficients: Vec<f64>,
    pub(super) criterion: f64,
}

impl Choice {
    /// Of one recording.
    pub(super) fn of(recording: &Products) -> Self {
        Self::best(&[recording], recording.order())
    }

    /// The order with the lowest criterion, up to one that all recordings have.
    pub(super) fn best(recordings: &[&Products], longest: usize) -> Self {
        // Weighted so that every recording counts by its samples, not by its size.
        let weights: Vec<f64> = recordings.iter().map(|p| 1.0 / p.variance(&[])).collect();
        let mut sum = DMatrix::zeros(longest + 1, longest + 1);
        for (p, w) in recordings.iter().zip(&weights) {
            sum += p.lags.view((0, 0), (longest + 1, longest + 1)) * *w;
        }
        let tried = ORDERS.iter().map(|share| {
            let order = ((share * longest as f64).round() as usize).max(usize::from(*share > 0.0));
            let coefficients = solve(&sum, order);
            let likelihood: f64 = recordings.iter().map(|p| p.rows * p.variance(&coefficients).ln()).sum();
            let criterion = likelihood + 2.0 * (order + recordings.len()) as f64;
            Self { coefficients, criterion }
        });
        tried
            .min_by(|a, b| a.criterion.total_cmp(&b.criterion))
            .unwrap_or(Self { coefficients: Vec::new(), criterion: 0.0 })
    }
}

/// Coefficients of an order by least squares.
fn solve(lags: &DMatrix<f64>, order: usize) -> Vec<f64> {
    if order == 0 {
        return Vec::new();
    }
    let ridge = 1e-10 * lags[(0, 0)].max(f64::MIN_POSITIVE);
    let matrix =
        DMatrix::from_fn(order, order, |i, j| lags[(i + 1, j + 1)] + if i == j { ridge } else { 0.0 });
    let right = DVector::from_fn(order, |i, _| lags[(0, i + 1)]);
    matrix.cholesky().map_or_else(|| vec![0.0; order], |factor| factor.solve(&right).as_slice().to_vec())
}
