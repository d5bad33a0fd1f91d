//! Local polynomials in the middle of their window, on an even grid: the same weights for every sample.

use super::local::{Column, Local, TERMS, chebyshev, first, normal_matrix, slopes};

/// Times further than this share of a step from the even grid are taken as they are: rounded ones are not.
const ROUNDED: f64 = 1e-3;
/// Samples at a time.
const LANES: usize = 8;

/// Step of an even grid in s; `None` where the times are not even.
pub(super) fn grid(time: &[f64]) -> Option<f64> {
    let last = time.len() - 1;
    let step = (time[last] - time[0]) / last as f64;
    let even = |(i, t): (usize, &f64)| (t - time[0] - step * i as f64).abs() <= ROUNDED * step;
    time.iter().enumerate().all(even).then_some(step)
}

/// Weights of a window, from its middle on: those of the value are even and those of the slope odd.
pub(super) struct Stencil {
    value: Vec<f64>,
    slope: Vec<f64>,
    leverage: f64,
}

impl Stencil {
    /// Of `half` samples on either side and so many `terms`; `None` where the times are not even.
    pub(super) fn new(time: &[f64], half: usize, terms: usize) -> Option<Self> {
        let step = grid(time)?;
        let places: Vec<f64> = (0..=2 * half).map(|j| j as f64 / half as f64 - 1.0).collect();
        let mut moments = [0.0; 2 * TERMS - 1];
        for place in &places {
            let terms: [f64; 2 * TERMS - 1] = chebyshev(*place);
            moments.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
        }
        let terms = terms.min(2 * half);
        let factor = normal_matrix(&moments, terms).cholesky()?;
        let here = first(chebyshev(0.0), terms);
        let (value, slope) = (factor.solve(&here), factor.solve(&first(slopes(0.0), terms)));
        let scale = half as f64 * step;
        let weights = |found: &Column, scale: f64| -> Vec<f64> {
            places[half + 1..]
                .iter()
                .map(|place| found.dot(&first(chebyshev(*place), terms)) / scale)
                .collect()
        };
        Some(Self { value: weights(&value, 1.0), slope: weights(&slope, scale), leverage: value.dot(&here) })
    }

    /// The fit to the samples of one window. Where nothing moves, the slope is exactly zero.
    pub(super) fn fit(&self, samples: &[f64]) -> Local {
        let half = self.value.len();
        let base = samples[half];
        let (before, after) = (&samples[..half], &samples[half + 1..]);
        let (mut value, mut slope) = ([0.0; LANES], [0.0; LANES]);
        for first in (0..half).step_by(LANES) {
            for lane in 0..LANES.min(half - first) {
                let k = first + lane;
                let (a, b) = (before[half - 1 - k] - base, after[k] - base);
                value[lane] += self.value[k] * (a + b);
                slope[lane] += self.slope[k] * (b - a);
            }
        }
        let [value, slope] = [value, slope].map(|lanes| lanes.iter().sum::<f64>());
        Local { value: base + value, slope, leverage: self.leverage }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::velocity::local::Polynomial;

    #[test]
    fn the_middle_of_an_even_window_is_the_fit_at_any_times() {
        let time: Vec<f64> = (0..500).map(|i| 0.3 + 0.004 * f64::from(i)).collect();
        let x: Vec<f64> = time.iter().map(|t| 3.0 + 2.0 * (5.0 * t).sin() + (61.0 * t).cos()).collect();
        for (half, terms) in [(4, 8), (5, 2), (17, 8), (40, 4), (200, 8)] {
            let stencil = Stencil::new(&time, half, terms);
            for i in [half, 230, 499 - half] {
                let slow = Polynomial::around(&time, &x, i, half, terms).at(time[i], x[i]);
                let apart = stencil.as_ref().map_or(f64::INFINITY, |stencil| {
                    let fast = stencil.fit(&x[i - half..=i + half]);
                    let [value, slope] = [fast.value - slow.value, fast.slope - slow.slope];
                    value.abs().max(0.01 * slope.abs()).max((fast.leverage - slow.leverage).abs())
                });
                assert!(apart < 1e-12, "{half} {terms} {i} {apart}");
            }
        }
        if let Some(stencil) = Stencil::new(&time, 17, TERMS) {
            let held = stencil.fit(&[0.1; 35]);
            assert_eq!((held.value, held.slope), (0.1, 0.0));
        }
        let uneven: Vec<f64> = time.iter().map(|t| t + 0.001 * (40.0 * t).sin()).collect();
        assert!(Stencil::new(&uneven, 17, 8).is_none());
    }
}
