//! Squared standard deviations of waves in time, or of series that wave, at many frequencies: to first order, without the
//! projection off a model's tangents.

use std::f64::consts::{LN_2, TAU};
use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::null::Null;
use crate::effect::Scene;
use crate::kernel::filter::dot;
use crate::spread::median;

/// The lowest frequency, in lines of a recording: a slower one is what wanders.
pub(super) const LOWEST: f64 = 3.0;
/// The highest, in shares of the sampling rate.
pub(super) const HIGHEST_SHARE: f64 = 0.1;
/// Frequencies that are looked at side by side.
const TOGETHER: usize = 8;
/// Median of the sum of two squared standard deviations.
const MEDIAN: f64 = 2.0 * LN_2;

/// A series of a recording that waves.
pub(super) type Carrier = for<'s> fn(&'s Scene<'_>) -> &'s [f64];

/// What a recording contributes to the scan.
struct Scanned {
    step: f64,
    /// Frequencies that it tells of, Hz.
    tells: RangeInclusive<f64>,
    /// A carrier, or one for waves alone, times the residual as the whitening would filter it backwards.
    products: Vec<f64>,
    /// Products of the carrier with itself, lag by lag, with those of the whitening filter.
    lags: Vec<f64>,
}

impl Scanned {
    fn of(null: &Null, r: usize, carrier: Option<Carrier>) -> Option<Self> {
        let recording = &null.assembly().campaign().recordings()[r];
        let (coefficients, deviation) = null.noise().autoregression(r);
        let left = &null.point.recordings[r].residual;
        let end = recording.scored().end;
        let start = end.checked_sub(left.len())?;
        let first = start.checked_sub(coefficients.len())?;
        let filter: Vec<f64> =
            [1.0].into_iter().chain(coefficients.iter().map(|a| -a)).map(|a| a / deviation).collect();
        let weights = null.weights(r);
        let weight = |i: usize| weights.map_or(1.0, |weights| weights[i]);
        let mut backwards = vec![0.0; end - first];
        for (i, e) in left.iter().enumerate().map(|(i, e)| (i, weight(i) * e)) {
            for (k, a) in filter.iter().enumerate() {
                backwards[start - first + i - k] += a * e;
            }
        }
        let scene = null.scene(r);
        let carrier = carrier.map_or_else(|| vec![1.0; end - first], |of| of(&scene)[first..end].to_vec());
        let products = backwards.iter().zip(&carrier).map(|(b, c)| b * c).collect();
        // The noise's size changes slowly beside the whitening.
        let lost = start - first;
        let weighed: Vec<f64> =
            carrier.iter().enumerate().map(|(j, c)| c * weight(j.saturating_sub(lost))).collect();
        let (last, taps) = (carrier.len(), filter.len());
        let lags = (0..taps.min(last)).map(|lag| {
            let twice = if lag == 0 { 1.0 } else { 2.0 };
            twice * dot(&filter[lag..], &filter[..taps - lag]) * dot(&weighed[lag..], &weighed[..last - lag])
        });
        let lags = lags.collect();
        Some(Self { step: scene.step(), tells: told(&scene), products, lags })
    }

    /// Squared standard deviations at frequencies in Hz, of two on average under the null.
    fn at(&self, frequencies: &[f64; TOGETHER]) -> [f64; TOGETHER] {
        let turns = frequencies.map(|frequency| TAU * frequency * self.step);
        let (sine, cosine) = (turns.map(f64::sin), turns.map(f64::cos));
        let (mut x, mut y) = ([1.0; TOGETHER], [0.0; TOGETHER]);
        let (mut along, mut across) = ([0.0; TOGETHER], [0.0; TOGETHER]);
        for product in &self.products {
            for k in 0..TOGETHER {
                along[k] += product * x[k];
                across[k] += product * y[k];
                (x[k], y[k]) = (x[k] * cosine[k] - y[k] * sine[k], x[k] * sine[k] + y[k] * cosine[k]);
            }
        }
        std::array::from_fn(|k| {
            let lags = self.lags.iter().enumerate();
            let square: f64 = lags.map(|(lag, l)| l * (turns[k] * lag as f64).cos()).sum();
            if square > 0.0 { 2.0 * (along[k] * along[k] + across[k] * across[k]) / square } else { 0.0 }
        })
    }
}

/// Frequencies that a recording tells of, Hz: slower ones are not waves, faster ones aliases.
pub(super) fn told(scene: &Scene) -> RangeInclusive<f64> {
    LOWEST / scene.duration()..=HIGHEST_SHARE / scene.step()
}

/// Squared standard deviations at each frequency, recording by recording.
pub(super) struct Scan(Vec<Vec<f64>>);

impl Scan {
    /// How much larger they are in each recording than under a noise of even size, by their median.
    pub(super) fn excess(&self) -> Vec<f64> {
        let of = |own: &Vec<f64>| {
            let told = own.iter().copied().filter(|gain| *gain > 0.0);
            (median(told.collect()) / MEDIAN).max(1.0)
        };
        self.0.iter().map(of).collect()
    }

    /// The place of the largest of all recordings together, each over its excess, and how large that is.
    pub(super) fn largest(&self, excess: &[f64]) -> Option<(usize, f64)> {
        let sum = |k: usize| self.0.iter().zip(excess).map(|(own, excess)| own[k] / excess).sum::<f64>();
        let all = (0..self.0.first()?.len()).map(|k| (k, sum(k)));
        all.max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Null<'_> {
    /// Of a carrier times waves, or of waves alone, at frequencies in Hz; `None` of a recording without samples.
    pub(super) fn scanned(&self, frequencies: &[f64], carrier: Option<Carrier>) -> Option<Scan> {
        let of = |r: usize| {
            let recording = Scanned::of(self, r, carrier)?;
            let tells = |frequency: &f64| carrier.is_none() || recording.tells.contains(frequency);
            let some = |some: &[f64]| {
                let mut padded = [0.0; TOGETHER];
                padded[..some.len()].copy_from_slice(some);
                let gains = recording.at(&padded);
                let told = some.iter().zip(gains).map(|(f, gain)| if tells(f) { gain } else { 0.0 });
                told.collect::<Vec<f64>>()
            };
            Some(frequencies.par_chunks(TOGETHER).flat_map_iter(some).collect())
        };
        (0..self.assembly().campaign().recordings().len()).map(of).collect::<Option<_>>().map(Scan)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_stands_out_at_its_frequency_by_its_closed_form() {
        let (step, count) = (0.01, 2000);
        let carrier: Vec<f64> = (0..count).map(|i| 1.0 + (0.37 * f64::from(i)).sin()).collect();
        let wave = |i: usize| 0.2 * carrier[i] * (TAU * 1.5 * step * i as f64 + 0.4).sin();
        let square: f64 = dot(&carrier, &carrier);
        // White noise of unit size: what is left is filtered by nothing.
        let products = (0..carrier.len()).map(|i| wave(i) * carrier[i]).collect();
        let scanned = Scanned { step, tells: 0.0..=10.0, products, lags: vec![square] };
        let gains = scanned.at(&[0.5, 1.0, 1.45, 1.5, 1.55, 2.0, 3.0, 4.0]);
        assert!((gains[3] / (0.02 * square) - 1.0).abs() < 0.01, "{gains:?} beside {square}");
        assert!(gains.iter().enumerate().all(|(k, gain)| k == 3 || *gain < 0.3 * gains[3]), "{gains:?}");
    }

    #[test]
    fn a_recording_of_more_noise_counts_by_its_own_median() {
        let even: Vec<f64> = (1..1000).map(|k| -2.0 * (f64::from(k) / 1000.0).ln()).collect();
        let thrice: Vec<f64> = even.iter().map(|gain| 3.0 * gain).collect();
        let scan = Scan(vec![even, thrice]);
        let excess = scan.excess();
        assert!((excess[0] - 1.0).abs() < 0.01 && (excess[1] - 3.0).abs() < 0.02, "{excess:?}");
        let (place, largest) = scan.largest(&excess).unwrap_or_default();
        assert_eq!(place, 0);
        assert!((largest / (-4.0 * 0.001_f64.ln()) - 1.0).abs() < 0.01, "{largest}");
    }
}
