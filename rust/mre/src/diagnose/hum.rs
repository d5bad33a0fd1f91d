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
/// Steps on either side of the nominal frequency.
const STEPS: i32 = 4;

/// A residual without its sines at the mains' frequencies and their harmonics, as far as they are sampled.
pub(super) fn without_hum(residual: &[f64], step: f64) -> Vec<f64> {
    let mut left = residual.to_vec();
    for nominal in NOMINAL {
        if !told(nominal, step) {
            continue;
        }
        let strongest = (-STEPS..=STEPS)
            .map(|k| nominal + WANDER * f64::from(k) / f64::from(STEPS))
            .map(|f| (f, Wave::of(&left, f, step)))
            .max_by(|a, b| a.1.explained.total_cmp(&b.1.explained));
        let Some((frequency, wave)) = strongest else { continue };
        wave.take_off(&mut left, frequency, step);
        for k in (2..=HARMONICS).map(|k| k as f64 * frequency) {
            if sampled(k, step) {
                Wave::of(&left, k, step).take_off(&mut left, k, step);
            }
        }
    }
    left
}

/// Amplitudes of the cosine and the sine at a frequency, by least squares.
struct Wave {
    cos: f64,
    sin: f64,
    /// Squares of the series that they explain.
    explained: f64,
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
        Self { cos, sin, explained: cos * right[0] + sin * right[1] }
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
}
