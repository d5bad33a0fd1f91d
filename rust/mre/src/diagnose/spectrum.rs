//! Spectra of series in a band of frequencies, and how their power goes on beside it.
//!
//! Those of a campaign have levels of their own and one shape, flat below a corner (an autoregression) or not
//! (1/f noise). The likelihood of a shape is Whittle's.

use std::f64::consts::PI;
use std::ops::RangeInclusive;

use rayon::prelude::*;

/// Place of the mean in the spectrum: noise whose power rises towards zero has a mean as well.
const PLACE_OF_THE_MEAN: f64 = 0.1;
/// Spectra of noise fall with the frequency to these powers, in tenths.
const STEEPNESS: RangeInclusive<u32> = 0..=22;
/// Spectra whose deviance (minus twice the logarithm of the likelihood) is this much above the least are possible.
const POSSIBLE: f64 = 4.0;
/// Degrees of freedom of Student's t.
const FREEDOM: f64 = 4.0;
/// Squared scale of it that fits normal amplitudes of unit variance best.
const OF_NORMAL: f64 = 0.690_57;
/// Rounds in which its scale is found.
const ROUNDS: usize = 12;
/// Half-cosines of a series, at least: fewer tell nothing of it.
const FEWEST: usize = 6;

/// The level of amplitudes with the largest likelihood, and minus twice the logarithm of that, by their squares.
type Likelihood = fn(&[f64]) -> (f64, f64);

/// Some half-cosines of every series.
pub(super) struct Band {
    places: Vec<Vec<usize>>,
    squares: Vec<Vec<f64>>,
    samples: Vec<usize>,
}

/// A shape with the level of each series that gives it the largest likelihood.
pub(super) struct Shape {
    /// Half-cosines of the longest series below which it is flat.
    corner: f64,
    steepness: f64,
    /// `None` of a series with hardly a spectrum.
    levels: Vec<Option<f64>>,
    deviance: f64,
}

impl Shape {
    /// True for a white noise.
    pub(super) fn is_flat(&self) -> bool {
        self.steepness == 0.0
    }
}

impl Band {
    /// The half-cosines at these places.
    pub(super) fn of(series: &[Vec<f64>], places: Vec<Vec<usize>>) -> Self {
        let square = |(e, places): (&Vec<f64>, &Vec<usize>)| {
            amplitudes(e, places).into_iter().map(|a| a * a).collect::<Vec<f64>>()
        };
        let squares = series.par_iter().zip(&places).map(square).collect();
        Self { places, squares, samples: series.iter().map(Vec::len).collect() }
    }

    /// The shapes whose likelihood is about the largest, of those with corners at these half-cosines of the longest.
    pub(super) fn possible(&self, corners: &[f64], likelihood: Likelihood) -> Vec<Shape> {
        let mut shapes: Vec<Shape> = corners
            .par_iter()
            .flat_map_iter(|corner| STEEPNESS.map(move |tenths| (*corner, f64::from(tenths) / 10.0)))
            .map(|(corner, steepness)| self.shape(corner, steepness, likelihood))
            .collect();
        let least = shapes.iter().map(|s| s.deviance).fold(f64::INFINITY, f64::min);
        shapes.retain(|s| s.deviance <= least + POSSIBLE);
        shapes
    }

    /// Mean square of the amplitude of half-cosine `k` of a series; `None` where nothing is known of it.
    pub(super) fn power(&self, shape: &Shape, r: usize, k: usize) -> Option<f64> {
        Some(shape.levels[r]? * self.relative(shape.corner, shape.steepness, r, k))
    }

    fn relative(&self, corner: f64, steepness: f64, r: usize, k: usize) -> f64 {
        let longest = self.samples.iter().max().copied().unwrap_or(1) as f64;
        let corner = corner * self.samples[r] as f64 / longest;
        let place = if k == 0 { PLACE_OF_THE_MEAN } else { k as f64 };
        (place * place + corner * corner).powf(-0.5 * steepness)
    }

    fn shape(&self, corner: f64, steepness: f64, likelihood: Likelihood) -> Shape {
        let mut deviance = 0.0;
        let own = |(r, places): (usize, &Vec<usize>)| {
            if places.len() < FEWEST {
                return None;
            }
            let power: Vec<f64> = places.iter().map(|k| self.relative(corner, steepness, r, *k)).collect();
            let over = self.squares[r].iter().zip(&power).map(|(square, power)| square / power);
            let (level, own) = likelihood(&over.collect::<Vec<f64>>());
            deviance += own + power.iter().map(|power| power.ln()).sum::<f64>();
            Some(level)
        };
        let levels = self.places.iter().enumerate().map(own).collect();
        Shape { corner, steepness, levels, deviance }
    }
}

/// Variance and deviance of normal values, by their squares.
pub(super) fn gaussian(squares: &[f64]) -> (f64, f64) {
    let count = squares.len() as f64;
    let level = (squares.iter().sum::<f64>() / count).max(f64::MIN_POSITIVE);
    (level, count * level.ln())
}

/// The same of values beside a few that are none of them: as of Student's t, of which some are large.
pub(super) fn heavy_tailed(squares: &[f64]) -> (f64, f64) {
    let count = squares.len() as f64;
    let (mut scale, _) = gaussian(squares);
    for _ in 0..ROUNDS {
        let weighed = squares.iter().map(|square| (FREEDOM + 1.0) * square / (FREEDOM + square / scale));
        scale = (weighed.sum::<f64>() / count).max(f64::MIN_POSITIVE);
    }
    let own = |square: &f64| (FREEDOM + 1.0) * (square / (FREEDOM * scale)).ln_1p() + scale.ln();
    (scale / OF_NORMAL, squares.iter().map(own).sum())
}

/// Half-cosine `k` at a sample, of unit square over `n` samples; the mean for `k = 0`.
pub(super) fn wave(n: usize, k: usize, i: f64) -> f64 {
    let unit = if k == 0 { 1.0 } else { 2.0_f64 };
    (unit / n as f64).sqrt() * (PI * k as f64 * (i + 0.5) / n as f64).cos()
}

/// Amplitudes of half-cosines, by turning all of them from sample to sample.
pub(super) fn amplitudes(series: &[f64], places: &[usize]) -> Vec<f64> {
    let n = series.len() as f64;
    let angle = |k: &usize| PI * *k as f64 / n;
    let turn: Vec<(f64, f64)> = places.iter().map(|k| angle(k).sin_cos()).collect();
    let mut now: Vec<(f64, f64)> = places.iter().map(|k| (0.5 * angle(k)).sin_cos()).collect();
    let mut sums = vec![0.0; turn.len()];
    for e in series {
        for ((sum, (s, c)), (sine, cosine)) in sums.iter_mut().zip(&mut now).zip(&turn) {
            *sum += e * *c;
            (*s, *c) = (*s * cosine + *c * sine, *c * cosine - *s * sine);
        }
    }
    let norm = |k: &usize| if *k == 0 { n.sqrt().recip() } else { (2.0 / n).sqrt() };
    sums.iter().zip(places).map(|(sum, k)| norm(k) * sum).collect()
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate;

    #[test]
    fn half_cosines_are_found_at_any_place() {
        let series: Vec<f64> =
            (0..300).map(|i| 2.0 * wave(300, 0, f64::from(i)) - 3.0 * wave(300, 7, f64::from(i))).collect();
        let found = amplitudes(&series, &[0, 3, 7, 150]);
        for (found, wanted) in found.iter().zip([2.0, 0.0, -3.0, 0.0]) {
            assert!((found - wanted).abs() < 1e-10, "{found} for {wanted}");
        }
    }

    #[test]
    fn a_few_lines_hardly_change_the_level() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let mut squares: Vec<f64> = (0..4_000).map(|_| 3.0 * deviate::normal(&mut random).powi(2)).collect();
        let (plain, _) = gaussian(&squares);
        let (level, _) = heavy_tailed(&squares);
        assert!((level / plain - 1.0).abs() < 0.03, "{level} for {plain}");
        squares[..100].fill(3e4);
        let (beside, _) = heavy_tailed(&squares);
        assert!(gaussian(&squares).0 > 100.0 * level && beside < 1.2 * level, "{beside} for {level}");
    }
}
