//! Noise of each recording as an autoregression, fitted by least squares.
//!
//! Up to 0.3 s long, which keeps tests on white, strongly correlated, 1/f and narrow-band noise near their
//! level where short or Yule-Walker ones do not; shorter where Akaike's criterion finds no use for the length.
//! A hum of the power mains is no noise, nor is a drift beyond what the noise's own slow part extends to: they
//! are effects of the measurement, and taken off before.
//!
//! Recordings of one sampling rate share it, each with its own size, unless they plainly differ: what is
//! estimated from more samples is estimated better, and tests far out in the tail need that. What one alone has, several
//! times as large as the noise of the others, is none.
//!
//! What is slower than an autoregression tells of is the noise's [wander](super::wander).

use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::filters::{Filter, filters};
use super::gaps::{Gaps, LeftOut};
use super::realisation::realisation;
use super::wander::Wander;
use crate::kernel::filter::prediction_error;

/// An autoregression for each recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Noise {
    filters: Vec<Filter>,
    gaps: Vec<Gaps>,
    wander: Vec<Wander>,
    /// True where a mismatch is so large that the noise cannot be told from it.
    hidden: bool,
}

impl Noise {
    /// Noise of residuals in N without drift; `steps` are the time steps in s, `freedom` the parameters that were fitted
    /// to all residuals together, `left_out` the samples of each recording that tell nothing, and `slow` the
    /// most that the mean square of a half-cosine of a recording may be, N^2.
    pub(super) fn of(
        residuals: &[Vec<f64>],
        steps: &[f64],
        freedom: usize,
        left_out: &[LeftOut],
        slow: impl Fn(usize, usize) -> Option<f64> + Sync,
    ) -> Self {
        let (filters, gaps) = filters(residuals, steps, freedom, left_out);
        let wander = vec![Wander::default(); filters.len()];
        let mut noise = Self { filters, gaps, wander, hidden: false };
        let wander = left_out.par_iter().enumerate().map(|(r, place)| {
            let Filter { coefficients, scale, .. } = &noise.filters[r];
            let power = |k| slow(r, k);
            Wander::of(place, (coefficients, *scale), power, |wave| noise.whiten(r, wave))
        });
        noise.wander = wander.collect();
        noise
    }

    /// White noise of one size in N in all recordings.
    pub fn white(recordings: usize, deviation: f64) -> Self {
        let filter = Filter { coefficients: Vec::new(), scale: 1.0 / deviation, density: 0.0 };
        Self {
            filters: vec![filter; recordings],
            gaps: vec![Gaps::none(); recordings],
            wander: vec![Wander::default(); recordings],
            hidden: false,
        }
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
        let mut wander = self.wander.clone();
        wander.push(Wander::default());
        Self { filters, gaps, wander, hidden: self.hidden }
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
        self.wander[r].calm(&mut white);
        white
    }

    /// True where both whiten the same samples.
    pub(super) fn keeps_the_samples_of(&self, other: &Self) -> bool {
        (0..self.filters.len()).all(|r| self.lost(r) == other.lost(r))
    }

    /// Logarithm of the determinant of its covariance, of so many whitened samples of each recording.
    pub(super) fn logarithm_of_covariance(&self, samples: impl Fn(usize) -> usize) -> f64 {
        let of = |(r, filter): (usize, &Filter)| {
            -2.0 * (samples(r) as f64 * filter.scale.ln() + self.wander[r].logarithm_of_shares())
        };
        self.filters.iter().enumerate().map(of).sum()
    }

    /// One realisation of the noise of a recording, N.
    pub(super) fn realisation(&self, r: usize, count: usize, stream: &mut ChaCha8Rng) -> Vec<f64> {
        let (coefficients, deviation) = self.autoregression(r);
        let mut series = realisation(coefficients, deviation, count, stream);
        self.wander[r].add_to(&mut series, stream);
        series
    }

    /// Coefficients of the autoregression of a recording, and the standard deviation in N of what it cannot
    /// predict.
    pub fn autoregression(&self, r: usize) -> (&[f64], f64) {
        (&self.filters[r].coefficients, 1.0 / self.filters[r].scale)
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
        let noise = Noise::of(&[y.clone()], &[0.1], 0, &[all], |_, _| None);
        let (a, sigma) = noise.autoregression(0);
        assert!(!a.is_empty() && (a[0] - 0.9).abs() < 0.02, "{a:?}");
        assert!(a[1..].iter().all(|a| a.abs() < 0.03), "{a:?}");
        assert!((sigma - 0.5).abs() < 0.01, "{sigma}");
        let whitened = noise.whiten(0, &y);
        let variance = whitened.iter().map(|e| e * e).sum::<f64>() / whitened.len() as f64;
        assert!((variance - 1.0).abs() < 1e-3, "{variance}");
    }

    #[test]
    fn what_a_recorder_filters_off_is_not_known_to_all_digits() {
        let mut y = white(8_000);
        for _ in 0..12 {
            y = (1..y.len()).map(|t| 0.5 * (y[t] + y[t - 1])).collect();
        }
        let all = LeftOut { ranges: &[], scored: 0..y.len(), length: y.len() };
        let noise = Noise::of(&[y.clone()], &[0.01], 0, &[all], |_, _| None);
        let rms = (y.iter().map(|e| e * e).sum::<f64>() / y.len() as f64).sqrt();
        // At half of the sampling rate, where the filter has left no noise at all.
        let wave: Vec<f64> = (0..y.len()).map(|i| 3e-4 * rms * if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let most = noise.whiten(0, &wave).iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        assert!((0.01..0.2).contains(&most), "{most}");
        let whitened = noise.whiten(0, &y);
        let variance = whitened.iter().map(|e| e * e).sum::<f64>() / whitened.len() as f64;
        assert!(variance < 1.0, "{variance}");
    }
}
