//! Slow drift in residuals, told from slow noise.
//!
//! A whitening filter that has seen a drift hides it. But noise with much power at low frequencies, 1/f noise
//! say, looks like drift: only what exceeds the extrapolation of the noise's own spectrum towards low frequencies,
//! over all recordings together, is taken for drift.

use std::f64::consts::PI;
use std::iter;
use std::ops::RangeInclusive;

use rayon::prelude::*;

use super::distribution::chi_square_tail;
use super::explained::unexplained;
use crate::effect::{DRIFT, MEAN};

/// Place of the mean in the spectrum: noise whose power rises towards zero has a mean as well.
const PLACE_OF_THE_MEAN: f64 = 0.1;
/// Half-cosines from which the spectrum is extrapolated.
const BESIDE: std::ops::Range<usize> = 5..100;
/// Chance of an excess by noise below which it is a drift.
const CHANCE: f64 = 1e-4;
/// Spectra of noise fall with the frequency to these powers, in tenths.
const STEEPNESS: std::ops::RangeInclusive<u32> = 0..=22;
/// Half-cosines of the longest recording below which they are flat.
const CORNERS: [f64; 8] = [0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
/// Spectra whose deviance (minus twice the logarithm of the likelihood) is this much above the least are possible.
const POSSIBLE: f64 = 4.0;
/// Ridge on slow columns, which are much alike, as a share of their squares.
const ALIKE: f64 = 1e-9;
/// Caution: the extrapolated power is taken so many times as large.
const CAUTION: f64 = 1.25;

/// The residuals without their drift and their means, if there is one; `calm` are those of recordings that start in
/// motion, without a line.
pub(super) fn without_drift(residuals: &[Vec<f64>], calm: &[Option<Vec<f64>>]) -> Vec<Vec<f64>> {
    let beside = beside(residuals, calm);
    let waves = waves(residuals, &beside);
    let drifts = chance_of(residuals, &waves, &DRIFT) <= CHANCE;
    if !drifts && chance_of(residuals, &waves, &MEAN) > CHANCE {
        return residuals.to_vec();
    }
    let calmed = |e: &Vec<f64>| {
        // Where a zero drifts, the mean is its own as well.
        let slow = slow_columns(e.len());
        without(e, &slow[..if drifts { slow.len() } else { 1 }])
    };
    beside.iter().map(calmed).collect()
}

/// A residual less what slow columns explain of it.
pub(super) fn without(residual: &[f64], slow: &[Vec<f64>]) -> Vec<f64> {
    let columns: Vec<&[f64]> = slow.iter().map(Vec::as_slice).collect();
    unexplained(residual.to_vec(), &columns, |square| ALIKE * square)
}

/// Where what a drift leaves is not known, the residuals themselves.
pub(super) fn beside(residuals: &[Vec<f64>], calm: &[Option<Vec<f64>>]) -> Vec<Vec<f64>> {
    residuals.iter().zip(calm).map(|(e, calm)| calm.as_ref().unwrap_or(e).clone()).collect()
}

/// A mean, a line and the slow half-cosines over `n` samples.
fn slow_columns(n: usize) -> Vec<Vec<f64>> {
    let waves = DRIFT.map(|k| (0..n).map(|i| wave(n, k, i)).collect());
    line(n).into_iter().chain(waves).collect()
}

/// A mean and a slope over `n` samples.
pub(super) fn line(n: usize) -> [Vec<f64>; 2] {
    [vec![1.0; n], (0..n).map(|i| (i as f64 + 0.5) / n as f64 - 0.5).collect()]
}

/// Chance that noise alone looks as much like drift as these residuals, where the noise beside their slow part is
/// that of others. `slow` are the half-cosines of such a drift.
pub(super) fn chance_beside(residuals: &[Vec<f64>], noise: &[Vec<f64>], slow: &RangeInclusive<usize>) -> f64 {
    chance_of(residuals, &waves(residuals, noise), slow)
}

fn chance_of(residuals: &[Vec<f64>], waves: &[Vec<f64>], slow: &RangeInclusive<usize>) -> f64 {
    let freedom = slow.clone().count() * waves.len();
    chi_square_tail(excess(residuals, waves, slow) / CAUTION, freedom)
}

/// Amplitudes of the mean and the slow half-cosines of each residual, then those of what a line leaves of its noise,
/// up to half its sampling rate: a drift is a line above all, which reaches into the faster ones.
fn waves(residuals: &[Vec<f64>], noise: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let own = |(e, noise): (&Vec<f64>, &Vec<f64>)| {
        let mut found = amplitudes(e, DRIFT.end() + 1);
        let faster = amplitudes(&without_line(noise), BESIDE.end.min(e.len() / 2));
        found.extend(faster.iter().skip(found.len()));
        found
    };
    residuals.par_iter().zip(noise).map(own).collect()
}

fn without_line(series: &[f64]) -> Vec<f64> {
    let middle = 0.5 * (series.len() as f64 - 1.0);
    let place = |i: usize| i as f64 - middle;
    let (mut along, mut squares) = (0.0, f64::MIN_POSITIVE);
    for (i, e) in series.iter().enumerate() {
        along += e * place(i);
        squares += place(i).powi(2);
    }
    series.iter().enumerate().map(|(i, e)| e - along / squares * place(i)).collect()
}

/// Half-cosine `k` at a sample, of unit square over `n` samples.
fn wave(n: usize, k: usize, i: usize) -> f64 {
    (2.0 / n as f64).sqrt() * (PI * k as f64 * (i as f64 + 0.5) / n as f64).cos()
}

/// Amplitudes of the mean and half-cosines 1 to `end` - 1, by turning all of them from sample to sample.
fn amplitudes(series: &[f64], end: usize) -> Vec<f64> {
    let n = series.len() as f64;
    let angle = |k: usize| PI * k as f64 / n;
    let turn: Vec<(f64, f64)> = (1..end).map(|k| angle(k).sin_cos()).collect();
    let mut now: Vec<(f64, f64)> = (1..end).map(|k| (0.5 * angle(k)).sin_cos()).collect();
    let mut sums = vec![0.0; turn.len()];
    for e in series {
        for ((sum, (s, c)), (sine, cosine)) in sums.iter_mut().zip(&mut now).zip(&turn) {
            *sum += e * *c;
            (*s, *c) = (*s * cosine + *c * sine, *c * cosine - *s * sine);
        }
    }
    let norm = (2.0 / n).sqrt();
    let mean = series.iter().sum::<f64>() / n.sqrt();
    iter::once(mean).chain(sums.into_iter().map(|sum| norm * sum)).collect()
}

/// Squares of the slow amplitudes of all residuals over the extrapolated powers, the largest that are possible.
///
/// The spectra have levels of their own and one shape, flat below a corner (an autoregression) or not (1/f noise).
/// The likelihood of the squares is Whittle's.
fn excess(residuals: &[Vec<f64>], waves: &[Vec<f64>], slow: &RangeInclusive<usize>) -> f64 {
    let longest = residuals.iter().map(Vec::len).max().unwrap_or(1) as f64;
    let shape = |corner: f64, steepness: f64| {
        let own = |(e, w): (&Vec<f64>, &Vec<f64>)| {
            let corner = corner * e.len() as f64 / longest;
            let power = |k: usize| {
                let place = if k == 0 { PLACE_OF_THE_MEAN } else { k as f64 };
                (place * place + corner * corner).powf(-0.5 * steepness)
            };
            let beside: Vec<(f64, f64)> = (BESIDE.start..w.len()).map(|k| (w[k].powi(2), power(k))).collect();
            let count = beside.len() as f64;
            let level = beside.iter().map(|(square, power)| square / power).sum::<f64>() / count;
            let level = level.max(f64::MIN_POSITIVE);
            let over = slow.clone().map(|k| w[k].powi(2) / (level * power(k))).sum::<f64>();
            (count * level.ln() + beside.iter().map(|(_, power)| power.ln()).sum::<f64>(), over)
        };
        // One with hardly a spectrum tells nothing.
        let told = residuals.iter().zip(waves).filter(|(_, w)| w.len() > 2 * BESIDE.start + 1);
        told.map(own).fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1))
    };
    let shapes: Vec<(f64, f64)> = CORNERS
        .iter()
        .flat_map(|corner| STEEPNESS.map(move |tenths| shape(*corner, f64::from(tenths) / 10.0)))
        .collect();
    let least = shapes.iter().map(|s| s.0).fold(f64::INFINITY, f64::min);
    shapes.iter().filter(|s| s.0 <= least + POSSIBLE).map(|s| s.1).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    /// Noise of seven recordings: the sum of processes with these correlations from sample to sample.
    fn recordings(poles: &[f64], seed: u64) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..7)
            .map(|_| {
                let mut states = vec![0.0; poles.len()];
                let mut next = || {
                    for (state, pole) in states.iter_mut().zip(poles) {
                        *state = pole * *state + (1.0 - pole * pole).sqrt() * normal(&mut random);
                    }
                    states.iter().sum()
                };
                (0..13_400).map(|_| next()).collect::<Vec<f64>>().split_off(12_000)
            })
            .collect()
    }

    fn chance(residuals: &[Vec<f64>]) -> f64 {
        chance_beside(residuals, residuals, &DRIFT)
    }

    /// Of 1/f noise: equal shares of each decade.
    const PINK: [f64; 8] = [0.3, 0.684, 0.9, 0.9684, 0.99, 0.99684, 0.999, 0.999_684];

    #[test]
    fn slow_noise_is_no_drift() {
        for poles in [&[0.0][..], &[0.97], &[0.995], &PINK] {
            let mut alarms = [0, 0];
            for seed in 0..200 {
                let noise = recordings(poles, seed);
                let waves = waves(&noise, &noise);
                for (count, slow) in alarms.iter_mut().zip([MEAN, DRIFT]) {
                    *count += u32::from(chance_of(&noise, &waves, &slow) < 0.01);
                }
            }
            assert!(alarms.iter().all(|count| *count <= 8), "{alarms:?} of 200 at {poles:?}");
        }
    }

    #[test]
    fn a_zero_that_is_off_leaves_the_noise_alone() {
        let noise = recordings(&[0.0], 1);
        let off: Vec<Vec<f64>> = noise.iter().map(|e| e.iter().map(|e| e + 7.0).collect()).collect();
        assert!(chance(&off) > 0.01);
        assert!(chance_beside(&off, &off, &MEAN) < 1e-6);
        let left = without_drift(&off, &vec![None; off.len()]);
        assert_eq!(without_drift(&noise, &vec![None; off.len()]), noise);
        for (left, noise) in left.iter().zip(&noise) {
            let mean = noise.iter().sum::<f64>() / noise.len() as f64;
            assert!(left.iter().zip(noise).all(|(left, e)| (left - (e - mean)).abs() < 1e-6));
        }
    }

    #[test]
    fn a_line_as_large_as_white_noise_is_a_drift() {
        let mut drifting = recordings(&[0.0], 1);
        for residual in &mut drifting {
            let n = residual.len() as f64;
            residual.iter_mut().enumerate().for_each(|(i, e)| *e += 3.0 * (i as f64 / n - 0.5));
        }
        assert!(chance(&drifting) < 1e-6);
    }

    #[test]
    fn a_line_of_three_times_the_rms_is_a_drift_under_correlated_noise() {
        let found = (0..50).filter(|seed| {
            let mut drifting = recordings(&[0.97], *seed);
            for residual in &mut drifting {
                let n = residual.len() as f64;
                residual.iter_mut().enumerate().for_each(|(i, e)| *e += 10.4 * (i as f64 / n - 0.5));
            }
            chance(&drifting) < CHANCE
        });
        assert!(found.count() >= 45);
    }
}
