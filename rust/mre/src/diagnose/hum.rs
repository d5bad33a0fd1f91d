//! Hum of the power mains in a residual.

use std::f64::consts::TAU;

use crate::effect::{sampled, told};

/// Nominal frequencies, Hz.
const NOMINAL: [f64; 2] = [50.0, 60.0];
/// Harmonics that are looked at.
const HARMONICS: usize = 3;
/// Mains stay within this of their nominal frequency, Hz.
const WANDER: f64 = 0.2;
/// Below this determinant, of ones on the diagonal, sine and cosine are one.
const DEPENDENT: f64 = 1e-9;
/// Frequencies that are tried for each that a recording resolves: between them the strongest is on a parabola.
const FINE: f64 = 8.0;
/// Samples whose hum turns together, s.
const TOGETHER: f64 = 0.5;

/// A residual without its sines at the mains' frequencies and their harmonics, as far as they are sampled.
pub(super) fn without_hum(residual: &[f64], step: f64) -> Vec<f64> {
    let mut left = residual.to_vec();
    for nominal in NOMINAL {
        if !told(nominal, step) {
            continue;
        }
        let frequency = strongest(&left, nominal, step);
        let wave = Wave::of(&left, frequency, step);
        wave.take_off(&mut left, frequency, step);
        for k in (2..=HARMONICS).map(|k| k as f64 * frequency) {
            if sampled(k, step) {
                Wave::of(&left, k, step).take_off(&mut left, k, step);
            }
        }
    }
    left
}

/// The strongest frequency near a nominal one. A recording of a minute resolves a sixtieth of a hertz: what is left of a
/// hum that is taken off beside its frequency would pass for noise.
fn strongest(series: &[f64], nominal: f64, step: f64) -> f64 {
    let together = ((TOGETHER / step) as usize).max(1);
    let mut sums = vec![(0.0, 0.0); series.len().div_ceil(together)];
    turn(series.len(), nominal, step, |i, cos, sin| {
        let (re, im) = &mut sums[i / together];
        *re += series[i] * cos;
        *im -= series[i] * sin;
    });
    let power = |offset: f64| {
        let (mut re, mut im) = (0.0, 0.0);
        turn(sums.len(), offset, step * together as f64, |i, cos, sin| {
            re += sums[i].0 * cos + sums[i].1 * sin;
            im += sums[i].1 * cos - sums[i].0 * sin;
        });
        re * re + im * im
    };
    let count = (WANDER * FINE * step * series.len() as f64).ceil().max(1.0) as i32;
    let apart = WANDER / f64::from(count);
    let powers: Vec<f64> = (-count..=count).map(|k| power(apart * f64::from(k))).collect();
    let best = (0..powers.len()).max_by(|a, b| powers[*a].total_cmp(&powers[*b])).unwrap_or(0);
    let top = if best == 0 || best + 1 == powers.len() {
        0.0
    } else {
        let (before, here, after) = (powers[best - 1], powers[best], powers[best + 1]);
        let bend = before - 2.0 * here + after;
        if bend < 0.0 { 0.5 * (before - after) / bend } else { 0.0 }
    };
    nominal + apart * (best as f64 + top - f64::from(count))
}

/// Amplitudes of the cosine and the sine at a frequency, by least squares.
struct Wave {
    cos: f64,
    sin: f64,
}

impl Wave {
    fn of(series: &[f64], frequency: f64, step: f64) -> Self {
        let (mut right, mut gram) = ([0.0; 2], [0.0; 3]);
        turn(series.len(), frequency, step, |i, cos, sin| {
            right[0] += series[i] * cos;
            right[1] += series[i] * sin;
            gram[0] += cos * cos;
            gram[1] += cos * sin;
            gram[2] += sin * sin;
        });
        // At half the sampling rate there is no sine.
        let determinant = gram[0] * gram[2] - gram[1] * gram[1];
        let (cos, sin) = if determinant > DEPENDENT * gram[0] * gram[0] {
            let solved = |a: f64, b: f64, own: f64| (a * own - b * gram[1]) / determinant;
            (solved(right[0], right[1], gram[2]), solved(right[1], right[0], gram[0]))
        } else {
            (right[0] / gram[0], 0.0)
        };
        Self { cos, sin }
    }

    fn take_off(&self, series: &mut [f64], frequency: f64, step: f64) {
        turn(series.len(), frequency, step, |i, cos, sin| {
            series[i] -= self.cos * cos + self.sin * sin;
        });
    }
}

/// Cosine and sine of a frequency at every sample, by rotation.
fn turn(count: usize, frequency: f64, step: f64, mut each: impl FnMut(usize, f64, f64)) {
    let (turn_sin, turn_cos) = (TAU * frequency * step).sin_cos();
    let (mut cos, mut sin) = (1.0, 0.0);
    for i in 0..count {
        each(i, cos, sin);
        (cos, sin) = (cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hum_goes_and_the_rest_stays() {
        for (rate, frequency) in [(200.0, 50.05), (128.0, 60.0), (100.0, 50.0)] {
            let step = 1.0 / rate;
            let rest: Vec<f64> = (0..4000).map(|i| (TAU * 7.0 * f64::from(i) * step).sin()).collect();
            let hum: Vec<f64> =
                (0..4000).map(|i| 3.0 * (TAU * frequency * f64::from(i) * step + 1.0).sin()).collect();
            let sum: Vec<f64> = rest.iter().zip(&hum).map(|(a, b)| a + b).collect();
            let left = without_hum(&sum, step);
            let error = left.iter().zip(&rest).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / 4000.0;
            assert!(error < 1e-3, "{error} of {frequency} Hz at {rate} Hz");
        }
    }

    #[test]
    fn a_hum_of_any_frequency_goes_from_a_long_recording() {
        let step = 1.0 / 200.0;
        for frequency in [49.871, 50.02, 50.0233, 60.077] {
            let hum: Vec<f64> =
                (0..20_000).map(|i| 3.0 * (TAU * frequency * f64::from(i) * step + 1.0).sin()).collect();
            let left = without_hum(&hum, step);
            let error = left.iter().map(|e| e * e).sum::<f64>() / 20_000.0;
            assert!(error < 1e-3, "{error} of {frequency} Hz");
        }
    }
}
