//! Hum of the power mains in a residual.

use std::f64::consts::TAU;

use crate::effect::{sampled, told};

/// Nominal frequencies, Hz.
const NOMINAL: [f64; 2] = [50.0, 60.0];
/// Harmonics that are looked at.
const HARMONICS: usize = 3;
/// Mains stay within this of their nominal frequency, Hz.
const WANDER: f64 = 0.2;
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
            .max_by(|a, b| a.1.power().total_cmp(&b.1.power()));
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

/// Amplitudes of the cosine and the sine at a frequency.
struct Wave([f64; 2]);

impl Wave {
    fn of(series: &[f64], frequency: f64, step: f64) -> Self {
        let mut sums = [0.0; 2];
        turn(series.len(), frequency, step, |i, cos, sin| {
            sums[0] += series[i] * cos;
            sums[1] += series[i] * sin;
        });
        Self(sums.map(|s| 2.0 * s / series.len() as f64))
    }

    fn power(&self) -> f64 {
        self.0[0].powi(2) + self.0[1].powi(2)
    }

    fn take_off(&self, series: &mut [f64], frequency: f64, step: f64) {
        turn(series.len(), frequency, step, |i, cos, sin| {
            series[i] -= self.0[0] * cos + self.0[1] * sin;
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
        let step = 1.0 / 200.0;
        let rest: Vec<f64> = (0..4000).map(|i| (TAU * 7.0 * f64::from(i) * step).sin()).collect();
        let hum: Vec<f64> =
            (0..4000).map(|i| 3.0 * (TAU * 50.05 * f64::from(i) * step + 1.0).sin()).collect();
        let sum: Vec<f64> = rest.iter().zip(&hum).map(|(a, b)| a + b).collect();
        let left = without_hum(&sum, step);
        let error = left.iter().zip(&rest).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / 4000.0;
        assert!(error < 1e-3, "{error}");
    }
}
