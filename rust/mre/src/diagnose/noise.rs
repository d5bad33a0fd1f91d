//! Noise of each recording as a long autoregression, fitted by least squares.
//!
//! Its length is 0.3 s, which keeps tests on white, strongly correlated, 1/f and narrow-band noise
//! near their level; short or Yule-Walker ones do not.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::kernel::filter::{dot, prediction_error};

/// Length of the autoregression, s.
const LENGTH: f64 = 0.3;
/// Longest, in samples.
const LONGEST: usize = 100;
/// Samples for each of its coefficients, at least.
const SAMPLES_EACH: usize = 25;

/// An autoregression for each recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    filters: Vec<Filter>,
}

#[derive(Debug, Clone, PartialEq)]
struct Filter {
    coefficients: Vec<f64>,
    /// Inverse of the standard deviation of what cannot be predicted, 1/N.
    scale: f64,
}

impl Noise {
    /// Noise of residuals in N; `steps` are the time steps in s, `freedom` the parameters that were fitted
    /// to all residuals together.
    pub fn of(residuals: &[Vec<f64>], steps: &[f64], freedom: usize) -> Self {
        let total: usize = residuals.iter().map(Vec::len).sum();
        let filters = residuals
            .par_iter()
            .zip(steps)
            .map(|(residual, step)| {
                let share = freedom as f64 * residual.len() as f64 / total as f64;
                Filter::of(residual, *step, share)
            })
            .collect();
        Self { filters }
    }

    /// White noise of one size in all recordings.
    pub fn white(recordings: usize, deviation: f64) -> Self {
        let filter = Filter { coefficients: Vec::new(), scale: 1.0 / deviation };
        Self { filters: vec![filter; recordings] }
    }

    /// Number of samples lost at the start of a recording.
    pub fn lost(&self, r: usize) -> usize {
        self.filters[r].coefficients.len()
    }

    /// What the noise of a recording cannot predict of a series, in standard deviations; its first value
    /// belongs to sample [`Noise::lost`].
    pub fn whiten(&self, r: usize, series: &[f64]) -> Vec<f64> {
        prediction_error(series, &self.filters[r].coefficients, self.filters[r].scale)
    }

    /// Coefficients of the autoregression of a recording, and the standard deviation in N of what it cannot
    /// predict.
    pub fn autoregression(&self, r: usize) -> (&[f64], f64) {
        (&self.filters[r].coefficients, 1.0 / self.filters[r].scale)
    }
}

impl Filter {
    fn of(residual: &[f64], step: f64, freedom: f64) -> Self {
        let n = residual.len();
        let order = ((LENGTH / step).round() as usize).min(LONGEST).min(n / SAMPLES_EACH).max(1);
        let floor = residual.iter().map(|e| e * e).sum::<f64>() / n as f64;
        let coefficients = autoregression(residual, order);
        let errors = prediction_error(residual, &coefficients, 1.0);
        let left = (errors.len() as f64 - order as f64 - freedom).max(0.5 * errors.len() as f64);
        let variance = errors.iter().map(|e| e * e).sum::<f64>() / left;
        // A residual of zeros is no noise: keep the numbers finite.
        let variance = variance.max(1e-24 * floor).max(f64::MIN_POSITIVE);
        Self { coefficients, scale: 1.0 / variance.sqrt() }
    }
}

/// Coefficients by the covariance method: least squares over all complete windows.
fn autoregression(y: &[f64], order: usize) -> Vec<f64> {
    let (n, p) = (y.len(), order);
    // products[i][j] = sum over t from p to n of y[t - i] y[t - j], each diagonal from its predecessor.
    let mut products = DMatrix::zeros(p + 1, p + 1);
    for j in 0..=p {
        products[(0, j)] = dot(&y[p..], &y[p - j..n - j]);
    }
    for i in 1..=p {
        for j in i..=p {
            let (first, last) = (y[p - i] * y[p - j], y[n - i] * y[n - j]);
            products[(i, j)] = products[(i - 1, j - 1)] + first - last;
        }
    }
    let ridge = 1e-10 * products[(0, 0)].max(f64::MIN_POSITIVE);
    let matrix = DMatrix::from_fn(p, p, |i, j| {
        let (a, b) = (i.min(j) + 1, i.max(j) + 1);
        products[(a, b)] + if i == j { ridge } else { 0.0 }
    });
    let right = DVector::from_fn(p, |i, _| products[(0, i + 1)]);
    matrix.cholesky().map_or_else(|| vec![0.0; p], |factor| factor.solve(&right).as_slice().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Deterministic noise of unit variance.
    fn white(n: usize) -> Vec<f64> {
        let mut state = 1_u64;
        (0..n)
            .map(|_| {
                (0..12)
                    .map(|_| {
                        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                        (state >> 11) as f64 / (1_u64 << 53) as f64
                    })
                    .sum::<f64>()
                    - 6.0
            })
            .collect()
    }

    #[test]
    fn a_first_order_process_is_found() {
        let shocks = white(20_000);
        let mut y = vec![0.0; shocks.len()];
        for t in 1..y.len() {
            y[t] = 0.9 * y[t - 1] + 0.5 * shocks[t];
        }
        let noise = Noise::of(&[y.clone()], &[0.1], 0);
        let (a, sigma) = noise.autoregression(0);
        assert_eq!(a.len(), 3);
        assert!((a[0] - 0.9).abs() < 0.02, "{a:?}");
        assert!(a[1].abs() < 0.03 && a[2].abs() < 0.03, "{a:?}");
        assert!((sigma - 0.5).abs() < 0.01, "{sigma}");
        let whitened = noise.whiten(0, &y);
        let variance = whitened.iter().map(|e| e * e).sum::<f64>() / whitened.len() as f64;
        assert!((variance - 1.0).abs() < 1e-3, "{variance}");
    }
}
