//! Slow drift in residuals, told from slow noise.
//!
//! A whitening filter that has seen a drift hides it. But noise with much power at low frequencies, 1/f noise
//! say, looks like drift: only what exceeds the extrapolation of the noise's own spectrum towards low frequencies,
//! over all recordings together, is taken for drift.

use std::f64::consts::PI;

use super::distribution::chi_square_tail;
use crate::recording::mean;

/// Half-cosines that make a drift.
const SLOW: usize = 3;
/// Half-cosines from which the spectrum is extrapolated.
const BESIDE: std::ops::Range<usize> = 5..25;
/// Chance of an excess by noise below which it is a drift.
const CHANCE: f64 = 1e-4;
/// Spectra of noise rise towards low frequencies like the frequency to this power at most.
const STEEPEST: f64 = -2.2;
/// Caution: the extrapolated power is taken so many times as large.
const CAUTION: f64 = 2.0;

/// The residuals without their drift, if there is one.
pub(super) fn without_drift(residuals: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let waves = waves(residuals);
    if chance_of(&waves) > CHANCE {
        return residuals.to_vec();
    }
    residuals
        .iter()
        .zip(&waves)
        .map(|(e, w)| {
            let n = e.len();
            let slow = |i: usize| (1..=SLOW).map(|k| w[k - 1] * wave(n, k, i)).sum::<f64>();
            e.iter().enumerate().map(|(i, e)| e - slow(i)).collect()
        })
        .collect()
}

/// Chance that noise alone looks as much like drift as these residuals.
pub(super) fn chance(residuals: &[Vec<f64>]) -> f64 {
    chance_of(&waves(residuals))
}

fn chance_of(waves: &[Vec<f64>]) -> f64 {
    chi_square_tail(excess(waves) / CAUTION, SLOW * waves.len())
}

/// Amplitudes of the half-cosines of each residual.
fn waves(residuals: &[Vec<f64>]) -> Vec<Vec<f64>> {
    residuals.iter().map(|e| (1..BESIDE.end).map(|k| amplitude(e, k)).collect()).collect()
}

/// Half-cosine `k` at a sample, of unit square over `n` samples.
fn wave(n: usize, k: usize, i: usize) -> f64 {
    (2.0 / n as f64).sqrt() * (PI * k as f64 * (i as f64 + 0.5) / n as f64).cos()
}

fn amplitude(series: &[f64], k: usize) -> f64 {
    series.iter().enumerate().map(|(i, e)| e * wave(series.len(), k, i)).sum()
}

/// Squares of the slow amplitudes of all residuals over the extrapolated powers.
///
/// The spectra have levels of their own and one slope: that of a single one is too uncertain to extrapolate. One
/// standard error is added to it.
fn excess(waves: &[Vec<f64>]) -> f64 {
    let logarithms: Vec<f64> = BESIDE.map(|k| (k as f64).ln()).collect();
    let x = mean(&logarithms);
    // Least-squares lines through the logarithms of squares against those of the frequency; the mean logarithm of a
    // chi-square variable with one degree of freedom is -1.27, its variance pi^2 / 2.
    let heights = |w: &Vec<f64>| -> Vec<f64> {
        BESIDE.map(|k| w[k - 1].powi(2).max(f64::MIN_POSITIVE).ln() + 1.27).collect()
    };
    let heights: Vec<Vec<f64>> = waves.iter().map(heights).collect();
    let xx = waves.len() as f64 * logarithms.iter().map(|l| (l - x).powi(2)).sum::<f64>();
    let of = |own: &Vec<f64>| logarithms.iter().zip(own).map(|(l, y)| (l - x) * y).sum::<f64>();
    let slope = heights.iter().map(of).sum::<f64>() / xx;
    let slope = (slope - (0.5 * PI * PI / xx).sqrt()).clamp(STEEPEST, 0.0);
    let over = |(w, own): (&Vec<f64>, &Vec<f64>)| {
        let level = mean(own);
        (1..=SLOW).map(|k| w[k - 1].powi(2) / (level + slope * ((k as f64).ln() - x)).exp()).sum::<f64>()
    };
    waves.iter().zip(&heights).map(over).sum()
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::super::distribution::normal;
    use super::*;

    /// Noise of seven recordings with a correlation from sample to sample.
    fn recordings(pole: f64, seed: u64) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        (0..7)
            .map(|_| {
                let mut state = 0.0;
                let mut next = || {
                    state = pole * state + normal(&mut random);
                    state
                };
                (0..3400).map(|_| next()).collect::<Vec<f64>>().split_off(2000)
            })
            .collect()
    }

    #[test]
    fn slow_noise_is_no_drift() {
        for pole in [0.0, 0.97, 0.995] {
            let alarms = (0..200).filter(|seed| chance(&recordings(pole, *seed)) < 0.01).count();
            assert!(alarms <= 8, "{alarms} of 200 at {pole}");
        }
    }

    #[test]
    fn a_line_as_large_as_white_noise_is_a_drift() {
        let mut drifting = recordings(0.0, 1);
        for residual in &mut drifting {
            let n = residual.len() as f64;
            residual.iter_mut().enumerate().for_each(|(i, e)| *e += 3.0 * (i as f64 / n - 0.5));
        }
        assert!(chance(&drifting) < 1e-6);
    }
}
