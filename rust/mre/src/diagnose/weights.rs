//! Noise of a size that follows the motion, as where a part of it is a share of the reading: tests weigh samples by the size
//! around them. Those of even noise would take a few samples where it is large for a mismatch.

use nalgebra::{DMatrix, DVector};

use super::gaps::LeftOut;
use super::motion::COLUMNS;
use super::null::Null;
use super::uneven::{LARGEST, chance};
use crate::kernel::filter::dot;

/// Samples that are taken together: of the difference of two, what is missing and smooth takes no part.
const PAIR: usize = 2;
/// Beyond so many variances a square is a wild sample's, of whatever size the noise is there.
const WILD: f64 = 40.0;
/// The size of a noise follows the motion where it does so by chance more seldom,
const PLAINLY: f64 = 1e-6;
/// and what is left is noise of any size where neighbours go together by chance more often.
const NOISE: f64 = 1e-4;
/// Series that the size of a noise may follow: the force of the model, the velocity, the displacement.
const FOLLOWED: usize = 3;
/// Variances where what the noise follows is as large as its rms, over those where it is nothing: the least, the factor
/// from one to the next, and how many.
const RATIOS: (f64, f64, i32) = (0.1, 1.6, 20);

/// Squares that a variance is estimated from, and what it may follow, as squares over their mean.
struct Squares {
    noise: Vec<f64>,
    telling: Vec<bool>,
    followed: [Vec<f64>; FOLLOWED],
}

impl Null<'_> {
    /// What whitened samples are to be multiplied with, by recording; `None` where the noise is of even size.
    pub(super) fn weights_over_the_motion(&self) -> Option<Vec<Vec<f64>>> {
        if !self.knows_its_noise() {
            return None;
        }
        let (mut gram, mut right) = (DMatrix::zeros(COLUMNS, COLUMNS), DVector::zeros(COLUMNS));
        for own in self.sizes(|_, series| series.to_vec(), PAIR, &half_square_of_the_difference(LARGEST)) {
            gram += own.covariance();
            right += own.right();
        }
        if gram.trace() <= 0.0 || chance(&gram, &right) > PLAINLY {
            return None;
        }
        let recordings = 0..self.point.recordings.len();
        let all: Vec<Squares> = recordings.map(|r| self.squares(r)).collect();
        let best = |which: usize| all.iter().map(|own| own.best(which)).collect::<Vec<_>>();
        let unlikely = |found: &Vec<(f64, f64)>| found.iter().map(|(unlikely, _)| unlikely).sum::<f64>();
        let tried = (0..FOLLOWED).map(|which| (which, best(which)));
        let (which, found) = tried.min_by(|a, b| unlikely(&a.1).total_cmp(&unlikely(&b.1)))?;
        let all = all.iter().zip(found).enumerate();
        Some(all.map(|(r, (own, (_, ratio)))| own.weights(which, ratio, self.left(r))).collect())
    }

    /// True where neighbours of what is left do not go together beyond chance.
    pub(super) fn is_noise(&self) -> bool {
        self.linked() > NOISE
    }

    /// Of the pairs of samples of a recording that tell something.
    fn squares(&self, r: usize) -> Squares {
        let left = self.left(r);
        let (scene, end) = (self.scene(r), self.assembly().campaign().recordings()[r].scored().end);
        let rows = end.saturating_sub(left.len())..end;
        let force = &self.point.recordings[r].force;
        let followed = [force.as_slice(), scene.velocity, scene.displacement].map(|series| {
            let own: Vec<f64> = series[rows.clone()].iter().map(|value| value * value).collect();
            let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
            own.iter().map(|square| square / mean.max(f64::MIN_POSITIVE)).collect()
        });
        let telling = LeftOut::of(self.assembly().campaign(), r).telling(rows, self.noise().lost(r));
        Squares {
            noise: left.chunks_exact(PAIR).map(half_square_of_the_difference(WILD)).collect(),
            telling: telling.chunks_exact(PAIR).map(|pair| pair.iter().all(|tells| *tells)).collect(),
            followed,
        }
    }

    /// What is left of a recording, whitened and weighed.
    pub(super) fn left(&self, r: usize) -> &[f64] {
        &self.point.recordings[r].residual
    }

    /// A whitened and weighed series of a recording as it was before.
    pub(super) fn unweighted(&self, r: usize, series: &[f64]) -> Vec<f64> {
        match self.weights(r) {
            Some(weights) => series.iter().zip(weights).map(|(e, w)| e / w).collect(),
            None => series.to_vec(),
        }
    }
}

impl Squares {
    /// The likeliest of the ratios, behind its unlikelihood.
    fn best(&self, which: usize) -> (f64, f64) {
        let (first, factor, count) = RATIOS;
        let ratios = std::iter::once(0.0).chain((0..count).map(|k| first * factor.powi(k)));
        let tried = ratios.map(|ratio| (self.unlikelihood(which, ratio), ratio));
        tried.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default()
    }

    /// Twice the negative logarithm of the likelihood of a variance in such a ratio, of the best size, up to a constant.
    fn unlikelihood(&self, which: usize, ratio: f64) -> f64 {
        let count = self.telling.iter().filter(|tells| **tells).count().max(1) as f64;
        let followed = self.followed[which].chunks_exact(PAIR);
        let (mut sum, mut logarithms) = (0.0, 0.0);
        for ((noise, some), _) in
            self.noise.iter().zip(followed).zip(&self.telling).filter(|(_, tells)| **tells)
        {
            let variance = 1.0 + ratio * 0.5 * (some[0] + some[1]);
            sum += noise / variance;
            logarithms += variance.ln();
        }
        count * (sum / count).max(f64::MIN_POSITIVE).ln() + logarithms
    }

    /// Weights that leave the sum of squares of what is left as it is.
    fn weights(&self, which: usize, ratio: f64, left: &[f64]) -> Vec<f64> {
        let own = self.followed[which].iter().map(|followed| (1.0 + ratio * followed).sqrt().recip());
        let mut weights: Vec<f64> = own.collect();
        let weighted: f64 = left.iter().zip(&weights).map(|(e, w)| (e * w).powi(2)).sum();
        // Where nothing is left there is nothing to weigh.
        let scale = if weighted > 0.0 { (dot(left, left) / weighted).sqrt() } else { 1.0 };
        for weight in &mut weights {
            *weight *= scale;
        }
        weights
    }
}

fn half_square_of_the_difference(largest: f64) -> impl Fn(&[f64]) -> f64 {
    move |pair| (0.5 * (pair[1] - pair[0]).powi(2)).min(largest)
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    #[test]
    fn the_likeliest_variance_is_found_and_makes_the_noise_even() {
        let mut stream = ChaCha8Rng::seed_from_u64(7);
        let followed: Vec<f64> = (0..8000).map(|i| 2.0 * (0.01 * f64::from(i)).sin().powi(2)).collect();
        let left: Vec<f64> = followed.iter().map(|f| (1.0 + 5.0 * f).sqrt() * normal(&mut stream)).collect();
        let squares = Squares {
            noise: left.chunks_exact(PAIR).map(half_square_of_the_difference(f64::INFINITY)).collect(),
            telling: vec![true; left.len() / PAIR],
            followed: [vec![1.0; left.len()], followed.clone(), vec![0.0; left.len()]],
        };
        let all: Vec<(f64, f64)> = (0..FOLLOWED).map(|which| squares.best(which)).collect();
        assert!(all[1].0 < all[0].0 - 100.0 && all[1].0 < all[2].0 - 100.0, "{all:?}");
        assert!((2.5..10.0).contains(&all[1].1), "{all:?}");
        let weights = squares.weights(1, all[1].1, &left);
        let weighted: Vec<f64> = left.iter().zip(&weights).map(|(e, w)| e * w).collect();
        assert!((dot(&weighted, &weighted) / dot(&left, &left) - 1.0).abs() < 1e-12);
        let mean_square = |loud: bool| {
            let some: Vec<f64> = weighted
                .iter()
                .zip(&followed)
                .filter(|(_, f)| (**f > 1.0) == loud)
                .map(|(e, _)| e * e)
                .collect();
            some.iter().sum::<f64>() / some.len() as f64
        };
        assert!((mean_square(true) / mean_square(false) - 1.0).abs() < 0.15);
        assert!(squares.weights(1, 5.0, &vec![0.0; left.len()]).iter().all(|w| w.is_finite() && *w > 0.0));
    }
}
