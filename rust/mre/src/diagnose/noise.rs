//! Noise of each recording as an autoregression, fitted by least squares.
//!
//! Up to 0.3 s long, which keeps tests on white, strongly correlated, 1/f and narrow-band noise near their
//! level where short or Yule-Walker ones do not; shorter where Akaike's criterion finds no use for the length.
//! A hum of the power mains is no noise, nor is a drift beyond what the noise's own slow part extends to: they
//! are effects of the measurement, and taken off before.
//!
//! Recordings of one sampling rate share it, each with its own size, unless they plainly differ: what is
//! estimated from more samples is estimated better, and tests far out in the tail need that.

use rayon::prelude::*;

use super::autoregression::{Choice, Products};
use super::gaps::{Gaps, LeftOut};
use super::hum::without_hum;
use crate::kernel::filter::{dot, prediction_error};

/// Rates that differ by less than this share are one.
const SAME_RATE: f64 = 0.01;

/// An autoregression for each recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    filters: Vec<Filter>,
    gaps: Vec<Gaps>,
    /// True where a mismatch is so large that the noise cannot be told from it.
    hidden: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct Filter {
    coefficients: Vec<f64>,
    /// Inverse of the standard deviation of what cannot be predicted, 1/N.
    scale: f64,
    /// Coefficients for each sample that they were estimated from.
    density: f64,
}

impl Noise {
    /// Noise of residuals in N without drift; `steps` are the time steps in s, `freedom` the parameters that were fitted
    /// to all residuals together, and `left_out` the samples of each recording that tell nothing.
    pub(super) fn of(residuals: &[Vec<f64>], steps: &[f64], freedom: usize, left_out: &[LeftOut]) -> Self {
        let products: Vec<Products> = residuals
            .par_iter()
            .zip(steps)
            .map(|(e, step)| Products::of(&without_hum(e, *step), *step))
            .collect();
        let total: usize = residuals.iter().map(Vec::len).sum();
        let mut filters: Vec<Option<Filter>> = vec![None; residuals.len()];
        let mut gaps = vec![Gaps::none(); residuals.len()];
        for r in 0..residuals.len() {
            if filters[r].is_some() {
                continue;
            }
            let alike: Vec<usize> = (r..residuals.len())
                .filter(|s| (steps[*s] / steps[r] - 1.0).abs() < SAME_RATE)
                .filter(|s| products[*s].order() == products[r].order())
                .collect();
            let own: Vec<Choice> = alike.iter().map(|s| Choice::best(&[&products[*s]])).collect();
            let together = Choice::best(&alike.iter().map(|s| &products[*s]).collect::<Vec<_>>());
            let of_alike: usize = alike.iter().map(|s| residuals[*s].len()).sum();
            let shared = together.criterion <= own.iter().map(|c| c.criterion).sum();
            for (k, s) in alike.iter().enumerate() {
                let choice = if shared { &together } else { &own[k] };
                let share = freedom as f64 * residuals[*s].len() as f64 / total as f64;
                let (members, from) = if shared { (alike.len(), of_alike) } else { (1, residuals[*s].len()) };
                let order = choice.coefficients.len() as f64;
                let used = share + order / members as f64;
                let (filter, gap) = Filter::of(&residuals[*s], steps[*s], choice, used, &left_out[*s]);
                let filter = Filter { density: order / from as f64, ..filter };
                (filters[*s], gaps[*s]) = (Some(filter), gap);
            }
        }
        Self { filters: filters.into_iter().flatten().collect(), gaps, hidden: false }
    }

    /// White noise of one size in N in all recordings.
    pub fn white(recordings: usize, deviation: f64) -> Self {
        let filter = Filter { coefficients: Vec::new(), scale: 1.0 / deviation, density: 0.0 };
        Self { filters: vec![filter; recordings], gaps: vec![Gaps::none(); recordings], hidden: false }
    }

    /// Noise that a plain mismatch hides: fits then make the rms error of the force smallest.
    pub(super) fn beside_a_mismatch(recordings: usize, size: f64) -> Self {
        Self { hidden: true, ..Self::white(recordings, size) }
    }

    /// True where a mismatch is so large that the noise cannot be told from it.
    pub fn hidden(&self) -> bool {
        self.hidden
    }

    /// The same with one more recording, whose noise is like that of a known one.
    #[must_use]
    pub(super) fn with_another_like(&self, r: usize) -> Self {
        let mut filters = self.filters.clone();
        filters.push(filters[r].clone());
        let mut gaps = self.gaps.clone();
        gaps.push(Gaps::none());
        Self { filters, gaps, hidden: self.hidden }
    }

    /// By what factor a gain by chance is larger than under a known noise: a spectrum that an autoregression of order
    /// `p` gives from `n` samples is off by `sqrt(2 p / n)` of itself (Berk 1974), and its inverse too large on average.
    pub(super) fn inflation(&self) -> f64 {
        let densities = self.filters.iter().map(|filter| filter.density);
        1.0 + 2.0 * densities.sum::<f64>() / self.filters.len().max(1) as f64
    }

    /// Number of samples lost at the start of a recording.
    pub fn lost(&self, r: usize) -> usize {
        self.filters[r].coefficients.len()
    }

    /// What the noise of a recording cannot predict of a series, in standard deviations; its first value
    /// belongs to sample [`Noise::lost`].
    pub fn whiten(&self, r: usize, series: &[f64]) -> Vec<f64> {
        let mut white = prediction_error(series, &self.filters[r].coefficients, self.filters[r].scale);
        self.gaps[r].leave_out(&mut white);
        white
    }

    /// Coefficients of the autoregression of a recording, and the standard deviation in N of what it cannot
    /// predict.
    pub fn autoregression(&self, r: usize) -> (&[f64], f64) {
        (&self.filters[r].coefficients, 1.0 / self.filters[r].scale)
    }
}

impl Filter {
    fn of(residual: &[f64], step: f64, choice: &Choice, used: f64, left_out: &LeftOut) -> (Self, Gaps) {
        let coefficients = choice.coefficients.clone();
        let floor = dot(residual, residual) / residual.len() as f64;
        let mut errors = prediction_error(&without_hum(residual, step), &coefficients, 1.0);
        let gaps = left_out.gaps_of_the_scored(&coefficients, 1.0);
        gaps.leave_out(&mut errors);
        let left = (errors.len() as f64 - used - gaps.count() as f64).max(0.5 * errors.len() as f64);
        let variance = dot(&errors, &errors) / left;
        // A residual of zeros is no noise: keep the numbers finite.
        let variance = variance.max(1e-24 * floor).max(f64::MIN_POSITIVE);
        let scale = 1.0 / variance.sqrt();
        let whole = left_out.gaps(&coefficients, scale);
        (Self { coefficients, scale, density: 0.0 }, whole)
    }
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
        let all = LeftOut { ranges: &[], scored: 0..y.len(), length: y.len() };
        let noise = Noise::of(&[y.clone()], &[0.1], 0, &[all]);
        let (a, sigma) = noise.autoregression(0);
        assert!(!a.is_empty() && (a[0] - 0.9).abs() < 0.02, "{a:?}");
        assert!(a[1..].iter().all(|a| a.abs() < 0.03), "{a:?}");
        assert!((sigma - 0.5).abs() < 0.01, "{sigma}");
        let whitened = noise.whiten(0, &y);
        let variance = whitened.iter().map(|e| e * e).sum::<f64>() / whitened.len() as f64;
        assert!((variance - 1.0).abs() < 1e-3, "{variance}");
    }
}
