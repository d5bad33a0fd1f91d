//! How large the slow half-cosines of a noise may be, by extrapolation of its spectrum.
//!
//! From the half-cosines beside the slowest, which tell best where the spectrum bends; but they hold what a model
//! leaves unexplained as well. And from frequencies that the motion does not reach, where there is noise alone. Of
//! each the slowest shape that is possible is taken, and the smaller counts; where a flat one is possible, nothing goes on
//! rising.

use std::iter;
use std::ops::{Range, RangeInclusive};

use super::above::above;
use super::hum::without_hum;
use super::spectrum::{Band, Shape, amplitudes, gaussian, heavy_tailed};
use crate::kernel::filter::dot;

/// Half-cosines that a drift's leave of what settles.
pub(super) const LEFT: RangeInclusive<usize> = 4..=7;
/// Half-cosines beside the slowest.
const BESIDE: Range<usize> = 5..100;
/// Corners of spectra there, in half-cosines of the longest residual.
const CORNERS: [f64; 8] = [0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

/// Spectra of residuals, slow and beside.
pub(super) struct Beside {
    /// Squares of the mean and the half-cosines of a drift and of what it leaves.
    slow: Vec<Vec<f64>>,
    band: Band,
}

/// A band with the shapes that it may have.
struct Extrapolated {
    band: Band,
    shapes: Vec<Shape>,
}

/// Mean squares of the slow half-cosines of noise.
pub(super) struct Extent {
    beside: Extrapolated,
    above: Extrapolated,
}

impl Beside {
    /// The mean and the slow half-cosines of each residual, then those of what a line leaves of its noise, up to half
    /// its sampling rate: a drift is a line above all, which reaches into the faster ones.
    pub(super) fn of(residuals: &[Vec<f64>], noise: &[Vec<f64>]) -> Self {
        let places: Vec<usize> = (0..=*LEFT.end()).collect();
        let square = |e: &Vec<f64>| amplitudes(e, &places).into_iter().map(|a| a * a).collect();
        let level: Vec<Vec<f64>> = noise.iter().map(|e| without_line(e)).collect();
        let places = level.iter().map(|e| (BESIDE.start..BESIDE.end.min(e.len() / 2)).collect()).collect();
        Self { slow: residuals.iter().map(square).collect(), band: Band::of(&level, places) }
    }

    /// Number of residuals.
    pub(super) fn count(&self) -> usize {
        self.slow.len()
    }

    /// Squares of slow half-cosines of all residuals over what noise may have, the most that it may.
    pub(super) fn over(&self, slow: &RangeInclusive<usize>) -> f64 {
        let over = |shape: &Shape| {
            let own = |(r, squares): (usize, &Vec<f64>)| {
                slow.clone().filter_map(|k| Some(squares[k] / self.band.power(shape, r, k)?)).sum::<f64>()
            };
            self.slow.iter().enumerate().map(own).sum::<f64>()
        };
        self.band.possible(&CORNERS, gaussian).iter().map(over).fold(f64::INFINITY, f64::min)
    }
}

impl Extent {
    /// Of residuals in N, by what is [`Beside`] their slow part and what is above the frequency of the motion, Hz; `steps`
    /// are the time steps in s.
    pub(super) fn of(residuals: &[Vec<f64>], steps: &[f64], motion: f64, beside: Beside) -> Self {
        let calm: Vec<Vec<f64>> = residuals.iter().zip(steps).map(|(e, s)| without_hum(e, *s)).collect();
        let places = calm.iter().zip(steps).map(|(e, step)| above(motion, e.len(), *step)).collect();
        let longest = calm.iter().map(Vec::len).fold(1, usize::max);
        let octaves = (0..=longest.ilog2()).map(|octave| f64::from(1_u32 << octave));
        let corners: Vec<f64> = iter::once(0.0).chain(octaves).collect();
        let extrapolated = |band: Band, corners: &[f64]| {
            // What a model leaves unexplained has lines at the harmonics of a sine.
            let shapes = band.possible(corners, heavy_tailed);
            Extrapolated { band, shapes }
        };
        Self {
            beside: extrapolated(beside.band, &CORNERS),
            above: extrapolated(Band::of(&calm, places), &corners),
        }
    }

    /// The most that the mean square of half-cosine `k` of a residual may be, N^2: none where the spectrum may be flat;
    /// `None` where it is not known.
    pub(super) fn power(&self, r: usize, k: usize) -> Option<f64> {
        let beside = self.beside.most(r, k)?;
        Some(self.above.most(r, k).map_or(beside, |above| beside.min(above)))
    }
}

impl Extrapolated {
    fn most(&self, r: usize, k: usize) -> Option<f64> {
        if self.shapes.iter().any(Shape::is_flat) {
            return Some(0.0);
        }
        self.shapes.iter().filter_map(|shape| self.band.power(shape, r, k)).reduce(f64::max)
    }
}

fn without_line(series: &[f64]) -> Vec<f64> {
    let middle = 0.5 * (series.len() as f64 - 1.0);
    let places: Vec<f64> = (0..series.len()).map(|i| i as f64 - middle).collect();
    let slope = dot(series, &places) / dot(&places, &places).max(f64::MIN_POSITIVE);
    series.iter().zip(places).map(|(e, place)| e - slope * place).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    const STEP: f64 = 0.005;
    const COUNT: usize = 2_000;
    const MOTION: f64 = 2.0;

    /// Four recordings of a sum of processes with these correlations from sample to sample.
    fn recordings(poles: &[f64]) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut one = || {
            let mut states = vec![0.0; poles.len()];
            let mut next = || {
                for (state, pole) in states.iter_mut().zip(poles) {
                    *state = pole * *state + (1.0 - pole * pole).sqrt() * normal(&mut random);
                }
                states.iter().sum()
            };
            (0..6 * COUNT).map(|_| next()).collect::<Vec<f64>>().split_off(5 * COUNT)
        };
        (0..4).map(|_| one()).collect()
    }

    fn power(residuals: &[Vec<f64>], k: usize) -> f64 {
        let extent = Extent::of(residuals, &[STEP; 4], MOTION, Beside::of(residuals, residuals));
        extent.power(0, k).unwrap_or(f64::NAN)
    }

    #[test]
    fn white_noise_does_not_go_on_rising() {
        let noise = recordings(&[0.0]);
        assert!([0, 1, 4, 12].iter().all(|k| power(&noise, *k) == 0.0));
    }

    #[test]
    fn noise_of_all_decades_rises_towards_zero() {
        let noise = recordings(&[0.3, 0.684, 0.9, 0.9684, 0.99, 0.99684, 0.999, 0.999_684]);
        let ratio = power(&noise, 2) / power(&noise, 20);
        assert!((6.0..25.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn what_follows_a_motion_is_no_slow_noise() {
        let mut residuals = recordings(&[0.0]);
        for residual in &mut residuals {
            for (i, e) in residual.iter_mut().enumerate() {
                let t = i as f64 * STEP;
                *e += (0..6)
                    .map(|k| (2.0 * PI * (0.4 + 0.3 * f64::from(k)) * t).sin() / f64::from(1 + k))
                    .sum::<f64>();
            }
        }
        let beside = Beside::of(&residuals, &residuals);
        assert!(beside.band.possible(&CORNERS, gaussian).iter().all(|shape| !shape.is_flat()));
        assert!(power(&residuals, 2) == 0.0);
    }
}
