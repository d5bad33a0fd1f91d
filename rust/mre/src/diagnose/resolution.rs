//! What recordings cannot resolve: the rounding of their force, and that of the arithmetic.

use super::candidates::residuals;
use super::least_squares::{Data, Fitted};
use crate::assembly::Assembly;

/// Rounding leaves half a step at most, a fit to it a little more; with noise beside it more is left somewhere.
const ROUNDING: f64 = 0.75;
/// Share of the force below which nothing is measured.
const ARITHMETIC: f64 = 1e-7;

/// True where a model leaves of every recording no more than its rounding: there is nothing to test.
pub(super) fn nothing_left(assembly: &Assembly, data: Data, fitted: &Fitted) -> bool {
    let left = residuals(assembly, data, fitted);
    let recordings = assembly.campaign().recordings();
    left.iter().zip(recordings).all(|(left, recording)| {
        let force = &recording.force().unwrap_or_default()[recording.scored()];
        let largest = |series: &[f64]| series.iter().fold(0.0_f64, |far, value| far.max(value.abs()));
        largest(left) <= (ARITHMETIC * largest(force)).max(ROUNDING * step_of(force))
    })
}

/// The smallest difference between two values of a series: the step of one that was rounded.
pub(super) fn step_of(series: &[f64]) -> f64 {
    let mut sorted = series.to_vec();
    sorted.sort_by(f64::total_cmp);
    let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 0.0);
    gaps.reduce(f64::min).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_step_of_a_rounded_series_is_found() {
        let rounded: Vec<f64> =
            (0..500).map(|i| (f64::from(i) * 0.37).sin() * 4.0).map(|f| (f * 20.0).round() / 20.0).collect();
        assert!((step_of(&rounded) - 0.05).abs() < 1e-9);
        assert_eq!(step_of(&[2.0; 5]), 0.0);
    }
}
