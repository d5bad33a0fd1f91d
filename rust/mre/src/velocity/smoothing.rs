//! Local polynomials over a motion, or over its parts between corners, and the noise that they take off.

use std::ops::Range;

use rayon::prelude::*;

use super::window::Window;

/// Median of the square of a normal variable of variance one.
const GAUSSIAN: f64 = 0.455;

/// The windows of the parts of a series; where parts overlap the last counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothing(pub(super) Vec<(Range<usize>, Window)>);

impl Smoothing {
    /// Slope and value at every sample of a series that the parts cover.
    pub fn over(&self, time: &[f64], series: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (mut slope, mut value) = (vec![0.0; series.len()], series.to_vec());
        let fits = self.0.par_iter().map(|(part, window)| {
            let (time, series) = (&time[part.clone()], &series[part.clone()]);
            match series {
                [_] => (vec![0.0], series.to_vec()),
                [a, b] => (vec![(b - a) / (time[1] - time[0]); 2], series.to_vec()),
                _ => window.over(time, series),
            }
        });
        let fits: Vec<_> = fits.collect();
        for ((part, _), (own_slope, own_value)) in self.0.iter().zip(fits) {
            slope[part.clone()].copy_from_slice(&own_slope);
            value[part.clone()].copy_from_slice(&own_value);
        }
        (slope, value)
    }

    /// Variance of the noise of a series from the middle of what smoothing takes off.
    pub fn variance(&self, series: &[f64], smooth: &[f64]) -> f64 {
        let mut kept = vec![0.0; series.len()];
        for (part, window) in &self.0 {
            // Two samples are met by a line.
            let leverage = if part.len() < 3 { 1.0 } else { window.leverage() };
            kept[part.clone()].fill(1.0 - leverage);
        }
        let pairs = series.iter().zip(smooth).zip(kept);
        let mut squares: Vec<f64> =
            pairs.filter(|(_, kept)| *kept > 0.0).map(|((x, s), kept)| (x - s).powi(2) / kept).collect();
        // A rounded displacement that rests has none there.
        squares.retain(|square| *square > 0.0);
        if squares.is_empty() {
            return 0.0;
        }
        let middle = squares.len() / 2;
        *squares.select_nth_unstable_by(middle, f64::total_cmp).1 / GAUSSIAN
    }
}
