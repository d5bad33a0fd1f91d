//! Local polynomials over a motion, or over its parts between corners, and the noise that they take off.

use std::ops::Range;

use rayon::prelude::*;

use super::cut;
use super::together::squares;
use super::window::Window;
use crate::spread::median;

/// Median of the square of a normal variable of variance one.
const GAUSSIAN: f64 = 0.455;

/// The windows of the parts of a series; where parts overlap the last counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothing(pub(super) Vec<(Range<usize>, Window)>);

impl Smoothing {
    /// Of parts that end after some samples; `terms` of the polynomials are tried in the longer ones.
    pub(super) fn between(after: &[usize], time: &[f64], series: &[f64], terms: &[usize]) -> Self {
        let window = |part: &Range<usize>| {
            let chosen = || Window::best(&time[part.clone()], &series[part.clone()], usize::MAX, terms);
            Window::of_few(part.len()).unwrap_or_else(chosen)
        };
        let mut all = Self(cut(after, time.len()).map(|part| (part.clone(), window(&part))).collect());
        // Of all parts the noise is more certain than of each.
        let variance = all.variance(series, &all.over(time, series).1);
        for (part, window) in all.0.iter_mut().filter(|(part, _)| Window::of_few(part.len()).is_none()) {
            *window = Window::knowing(variance, &time[part.clone()], &series[part.clone()], terms);
        }
        all
    }

    /// Half the longest window, in samples.
    pub(super) fn half(&self) -> usize {
        self.0.iter().map(|(_, window)| window.half).max().unwrap_or(1)
    }

    /// A series less its steps between parts.
    pub(super) fn continued(&self, series: &[f64]) -> Vec<f64> {
        let mut level = 0.0;
        let mut whole = series.to_vec();
        for (part, _) in self.0.iter().filter(|(part, _)| part.start > 0) {
            level += series[part.start] - series[part.start - 1];
            whole[part.clone()].iter_mut().for_each(|value| *value -= level);
        }
        whole
    }

    /// Standard deviations of the noise of a series, and of what smoothing leaves of it, from what it takes off.
    pub(crate) fn noise(&self, series: &[f64], smooth: &[f64]) -> (f64, f64) {
        let (mut noise, mut left, mut count) = (0.0, 0.0, 0);
        // Less is met by a line.
        for (part, window) in self.0.iter().filter(|(part, _)| part.len() > 2) {
            let share = window.leverage();
            let taken = squares(&smooth[part.clone()], &series[part.clone()]);
            let square = taken / (1.0 - share).max(f64::MIN_POSITIVE);
            noise += square;
            left += share * square;
            count += part.len();
        }
        let deviation = |squares: f64| (squares / count.max(1) as f64).sqrt();
        (deviation(noise), deviation(left))
    }

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
        median(squares) / GAUSSIAN
    }
}
