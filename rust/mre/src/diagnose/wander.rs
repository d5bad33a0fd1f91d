//! The slow part of a noise that its autoregression is too short to tell of.
//!
//! 1/f noise goes on rising where an autoregression of 0.3 s is flat. What its spectrum may extend to beyond that is
//! taken for half-cosines of random amplitudes over the recording: the covariance of the noise is that of the
//! autoregression and theirs together, and whitened series are white under both.

use std::f64::consts::PI;
use std::ops::Range;

use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;

use super::gaps::LeftOut;
use super::spectrum::wave;
use crate::deviate::normal;
use crate::kernel::filter::dot;

/// Half-cosines that are looked at, the mean among them.
const SLOW: Range<usize> = 0..16;
/// Variances above those of the autoregression by less than this share of them are the same.
const SLIGHT: f64 = 0.1;

/// Half-cosines over the scored samples of a recording, of random amplitudes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Wander {
    /// Root mean squares of their amplitudes, N.
    amplitudes: Vec<f64>,
    scored: Range<usize>,
    /// Directions of the whitened recording in which the variance is larger than one: of unit square, at right angles
    /// to each other.
    directions: Vec<Vec<f64>>,
    /// Shares of them that are too much.
    shares: Vec<f64>,
}

impl Wander {
    /// What the mean squares `power` of the amplitudes of half-cosines, N^2, exceed those of an autoregression by, which
    /// has these coefficients, whose inverse deviation is `scale`, and which makes series white by `whiten`.
    pub(super) fn of(
        place: &LeftOut,
        (coefficients, scale): (&[f64], f64),
        power: impl Fn(usize) -> Option<f64>,
        whiten: impl Fn(&[f64]) -> Vec<f64>,
    ) -> Self {
        let scored = place.scored.clone();
        let beyond = |k: usize| {
            let known = power_of(coefficients, scale, PI * k as f64 / scored.len() as f64);
            let amplitude = (power(k)? - known).max(0.0).sqrt();
            amplitude.is_finite().then_some(amplitude)
        };
        let amplitudes: Vec<f64> = SLOW.map(|k| beyond(k).unwrap_or(0.0)).collect();
        let mut wander = Self { amplitudes, scored, ..Self::default() };
        let waves: Vec<Vec<f64>> = wander
            .waves(place.length)
            .map(|wave| {
                let mut white = whiten(&wave);
                white[..wander.scored.start.saturating_sub(coefficients.len())].fill(0.0);
                white[wander.scored.end.saturating_sub(coefficients.len())..].fill(0.0);
                white
            })
            .collect();
        (wander.directions, wander.shares) = principal(&waves);
        wander
    }

    /// Make a series that is white under the autoregression white under the slow part as well.
    pub(super) fn calm(&self, white: &mut [f64]) {
        let sizes: Vec<f64> = self.directions.iter().map(|direction| dot(direction, white)).collect();
        for ((direction, size), share) in self.directions.iter().zip(sizes).zip(&self.shares) {
            white.iter_mut().zip(direction).for_each(|(w, d)| *w -= share * size * d);
        }
    }

    /// Logarithm of what is left of a volume where it is calmed.
    pub(super) fn logarithm_of_shares(&self) -> f64 {
        self.shares.iter().map(|share| (-share).ln_1p()).sum()
    }

    /// Add one realisation to a series, N.
    pub(super) fn add_to(&self, series: &mut [f64], stream: &mut ChaCha8Rng) {
        for wave in self.waves(series.len()) {
            let size = normal(stream);
            series.iter_mut().zip(wave).for_each(|(value, wave)| *value += size * wave);
        }
    }

    /// The half-cosines that have a size, over all `count` samples of the recording.
    fn waves(&self, count: usize) -> impl Iterator<Item = Vec<f64>> + '_ {
        let some = self.amplitudes.iter().enumerate().filter(|(_, amplitude)| **amplitude > 0.0);
        let start = self.scored.start as f64;
        some.map(move |(k, amplitude)| {
            (0..count).map(|i| amplitude * wave(self.scored.len(), k, i as f64 - start)).collect()
        })
    }
}

/// Directions in which whitened waves of random amplitudes add to the variance, and the shares of them that are too much.
fn principal(waves: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<f64>) {
    // The eigenvalues of no matrix are refused.
    if waves.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let gram = DMatrix::from_fn(waves.len(), waves.len(), |i, j| dot(&waves[i], &waves[j]));
    let found = gram.symmetric_eigen();
    let large = found.eigenvalues.iter().zip(found.eigenvectors.column_iter());
    large
        .filter(|(square, _)| **square > SLIGHT)
        .map(|(square, mix)| {
            let mut direction = vec![0.0; waves[0].len()];
            for (wave, share) in waves.iter().zip(&mix) {
                direction.iter_mut().zip(wave).for_each(|(d, w)| *d += share / square.sqrt() * w);
            }
            (direction, 1.0 - 1.0 / (1.0 + square).sqrt())
        })
        .unzip()
}

/// Power of an autoregression at an angle from sample to sample, N^2.
fn power_of(coefficients: &[f64], scale: f64, angle: f64) -> f64 {
    let (mut along, mut across) = (1.0, 0.0);
    for (lag, a) in coefficients.iter().enumerate() {
        let (sine, cosine) = (angle * (lag + 1) as f64).sin_cos();
        along -= a * cosine;
        across += a * sine;
    }
    1.0 / (scale * scale * (along * along + across * across)).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use rand_core::SeedableRng;

    use super::*;

    const COUNT: usize = 400;

    /// White noise of unit variance, with a mean and half-cosines of these mean squares.
    fn wandering(power: &[f64]) -> Wander {
        let place = LeftOut { ranges: &[], scored: 0..COUNT, length: COUNT };
        Wander::of(&place, (&[], 1.0), |k| power.get(k).copied(), <[f64]>::to_vec)
    }

    #[test]
    fn what_wanders_is_made_white() {
        let power = [50.0, 10.0, 0.5, 3.0];
        let wander = wandering(&power);
        let mut stream = ChaCha8Rng::seed_from_u64(1);
        let (mut before, mut after) = ([0.0; 4], [0.0; 4]);
        for _ in 0..2_000 {
            let mut series: Vec<f64> = (0..COUNT).map(|_| normal(&mut stream)).collect();
            wander.add_to(&mut series, &mut stream);
            for (sums, series) in [(&mut before, series.clone()), (&mut after, calmed(&wander, series))] {
                for (k, sum) in sums.iter_mut().enumerate() {
                    let wave: Vec<f64> = (0..COUNT).map(|i| wave(COUNT, k, i as f64)).collect();
                    *sum += dot(&wave, &series).powi(2) / 2_000.0;
                }
            }
        }
        for k in 0..4 {
            let wanted = power[k].max(1.0);
            assert!((before[k] / wanted - 1.0).abs() < 0.15, "{before:?}");
            assert!((after[k] - 1.0).abs() < 0.15, "{after:?}");
        }
    }

    #[test]
    fn what_does_not_wander_is_left_as_it_is() {
        let series: Vec<f64> = (0..COUNT).map(|i| (i as f64).sin()).collect();
        assert_eq!(calmed(&wandering(&[1.0, 0.2, 1.05]), series.clone()), series);
        assert_eq!(calmed(&Wander::default(), series.clone()), series);
    }

    #[test]
    fn the_power_of_a_first_order_process_is_its_closed_form() {
        for angle in [0.0, 0.01, 0.5, PI] {
            let wanted = 4.0 / (1.0 - 2.0 * 0.9 * f64::cos(angle) + 0.81);
            assert!((power_of(&[0.9], 0.5, angle) / wanted - 1.0).abs() < 1e-12);
        }
    }

    fn calmed(wander: &Wander, mut series: Vec<f64>) -> Vec<f64> {
        wander.calm(&mut series);
        series
    }
}
