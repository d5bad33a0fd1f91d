//! Slow drift in residuals, told from slow noise.
//!
//! A whitening filter that has seen a drift hides it. But noise with much power at low frequencies, 1/f noise
//! say, looks like drift: only what exceeds the extrapolation of the noise's own spectrum towards low frequencies,
//! over all recordings together, is taken for drift.

use std::ops::RangeInclusive;

use super::distribution::chi_square_tail;
use super::explained::unexplained;
use super::extrapolated::{Beside, LEFT};
use super::settling::settles;
use super::spectrum::wave;
use crate::effect::{DRIFT, MEAN};

/// Chance of an excess by noise below which it is a drift.
const CHANCE: f64 = 1e-4;
/// Time constants of what settles, as shares of a recording: an autoregression that has seen the rest of it would
/// turn it into a constant.
const SETTLING: [f64; 4] = [0.02, 0.06, 0.15, 0.5];
/// Ridge on slow columns, which are much alike, as a share of their squares.
const ALIKE: f64 = 1e-9;
/// Caution: the extrapolated power is taken so many times as large.
const CAUTION: f64 = 1.25;

/// The residuals without their drift and their means, if there is one; `beside` is what they have [`beside`] a drift,
/// and `spectra` are those of both.
pub(super) fn without_drift(residuals: &[Vec<f64>], beside: &[Vec<f64>], spectra: &Beside) -> Vec<Vec<f64>> {
    let drifts = settles(beside) || chance_of(spectra, &DRIFT) <= CHANCE;
    if !drifts && chance_of(spectra, &MEAN) > CHANCE {
        return residuals.to_vec();
    }
    let less = |columns: &dyn Fn(usize) -> Vec<Vec<f64>>| {
        beside.iter().map(|e| without(e, &columns(e.len()))).collect::<Vec<Vec<f64>>>()
    };
    // Where a zero drifts, the mean is its own as well.
    if !drifts {
        return less(&|n| vec![vec![1.0; n]]);
    }
    let (calm, settled) = (less(&slow_columns), less(&settling_columns));
    if settles(&calm) || chance_beside(&calm, &settled, &LEFT) <= CHANCE { settled } else { calm }
}

/// A residual less what slow columns explain of it.
pub(super) fn without(residual: &[f64], slow: &[Vec<f64>]) -> Vec<f64> {
    let columns: Vec<&[f64]> = slow.iter().map(Vec::as_slice).collect();
    unexplained(residual.to_vec(), &columns, |square| ALIKE * square.max(f64::MIN_POSITIVE))
}

/// Where what a drift leaves is not known, the residuals themselves.
pub(super) fn beside(residuals: &[Vec<f64>], calm: &[Option<Vec<f64>>]) -> Vec<Vec<f64>> {
    residuals.iter().zip(calm).map(|(e, calm)| calm.as_ref().unwrap_or(e).clone()).collect()
}

/// A mean, a line and the slow half-cosines over `n` samples.
fn slow_columns(n: usize) -> Vec<Vec<f64>> {
    let waves = DRIFT.map(|k| (0..n).map(|i| wave(n, k, i as f64)).collect());
    line(n).into_iter().chain(waves).collect()
}

/// The same and what settles.
fn settling_columns(n: usize) -> Vec<Vec<f64>> {
    let settling = SETTLING.map(|share| (0..n).map(|i| (-(i as f64) / (share * n as f64)).exp()).collect());
    slow_columns(n).into_iter().chain(settling).collect()
}

/// A mean and a slope over `n` samples.
pub(super) fn line(n: usize) -> [Vec<f64>; 2] {
    [vec![1.0; n], (0..n).map(|i| (i as f64 + 0.5) / n as f64 - 0.5).collect()]
}

/// Chance that noise alone looks as much like drift as these residuals, where the noise beside their slow part is
/// that of others. `slow` are the half-cosines of such a drift.
pub(super) fn chance_beside(residuals: &[Vec<f64>], noise: &[Vec<f64>], slow: &RangeInclusive<usize>) -> f64 {
    chance_of(&Beside::of(residuals, noise), slow)
}

fn chance_of(spectra: &Beside, slow: &RangeInclusive<usize>) -> f64 {
    chi_square_tail(spectra.over(slow) / CAUTION, slow.clone().count() * spectra.count())
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
                let spectra = Beside::of(&noise, &noise);
                for (count, slow) in alarms.iter_mut().zip([MEAN, DRIFT]) {
                    *count += u32::from(chance_of(&spectra, &slow) < 0.01);
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
        let left = without_drift(&off, &off, &Beside::of(&off, &off));
        assert_eq!(without_drift(&noise, &noise, &Beside::of(&noise, &noise)), noise);
        for (left, noise) in left.iter().zip(&noise) {
            let mean = noise.iter().sum::<f64>() / noise.len() as f64;
            assert!(left.iter().zip(noise).all(|(left, e)| (left - (e - mean)).abs() < 1e-6));
        }
    }

    #[test]
    fn what_settles_leaves_the_noise_alone() {
        let noise = recordings(&[0.0], 1);
        for share in [0.1, 0.15, 0.3, 1.0] {
            let settling = |e: &Vec<f64>| {
                let n = e.len() as f64;
                e.iter().enumerate().map(|(i, e)| e + 15.0 * (-(i as f64) / (share * n)).exp()).collect()
            };
            let settling: Vec<Vec<f64>> = noise.iter().map(settling).collect();
            let left = without_drift(&settling, &settling, &Beside::of(&settling, &settling));
            let square = |series: &[Vec<f64>]| series.iter().flatten().map(|e| e * e).sum::<f64>();
            let ratio = square(&left) / square(&noise);
            assert!((0.98..1.0).contains(&ratio), "{ratio} at {share}");
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
