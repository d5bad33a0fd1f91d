//! How many of a law's starts count, as far as they differ.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;

use super::block::Block;
use super::distribution::{chi_square_beyond, chi_square_tail};
use crate::deviate::normal;

/// Simulated draws over the starts of a law.
const DRAWS: usize = 400;
/// Gains that are drawn in turn.
const STRATA: usize = 8;
/// Level at which the starts are counted: that of one effect of a whole catalogue. The further out, the more they count.
const LEVEL: f64 = 2e-4;

/// Number of starts as far as they differ: how much more often the smallest p-value over the starts falls
/// below a level than that of one of them.
///
/// That is rare, and so one start after the other is made to fall below it: the chance that any does is the sum of
/// the starts' chances, each time shared among all that do (Naiman and Priebe 2001).
pub(super) fn correction(gram: &DMatrix<f64>, blocks: &[Block], width: usize, seed: u64) -> f64 {
    if blocks.len() == 1 {
        return 1.0;
    }
    let root = Root::of(gram);
    let thresholds: Vec<f64> = blocks.iter().map(|block| block.reached(LEVEL)).collect();
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    let draws = DRAWS.div_ceil(blocks.len()).next_multiple_of(STRATA);
    let mut number = 0.0;
    for (s, block) in blocks.iter().enumerate() {
        let Some(beyond) = Beyond::of(block, thresholds[s]) else { continue };
        let columns = gram.columns(s * width, width);
        let mut shares = 0.0;
        for draw in 0..draws {
            let mut right = root.draw(&mut stream);
            let wanted = beyond.draw(draw % STRATA, &mut stream);
            let away = beyond.solve(&(wanted - right.rows(s * width, width)));
            right += columns * away;
            let below =
                |s: usize| blocks[s].gain(&right.rows(s * width, width).into_owned()) >= thresholds[s];
            if below(s) {
                let all = (0..blocks.len()).filter(|s| below(*s)).count();
                shares += 1.0 / all as f64;
            }
        }
        number += shares / draws as f64 * beyond.chance / LEVEL;
    }
    number.clamp(1.0, blocks.len() as f64)
}

/// Square root of a covariance.
struct Root(DMatrix<f64>);

impl Root {
    fn of(gram: &DMatrix<f64>) -> Self {
        let eigen = gram.clone().symmetric_eigen();
        let size = |value: f64| value.max(0.0).sqrt();
        Self(DMatrix::from_fn(gram.nrows(), gram.nrows(), |i, j| {
            eigen.eigenvectors[(i, j)] * size(eigen.eigenvalues[j])
        }))
    }

    fn draw(&self, stream: &mut ChaCha8Rng) -> DVector<f64> {
        &self.0 * DVector::from_fn(self.0.ncols(), |_, _| normal(stream))
    }
}

/// The products of one start that give it at least a gain.
struct Beyond {
    /// Directions of unit variance: columns of the root of the gram matrix, of its rank.
    root: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// Gains, each as likely as the others.
    gains: [f64; STRATA],
    /// Their chance in all.
    chance: f64,
}

impl Beyond {
    /// `None` where the projection leaves nothing.
    fn of(block: &Block, least: f64) -> Option<Self> {
        let eigen = block.gram.clone().symmetric_eigen();
        let smallest = 1e-12 * eigen.eigenvalues.max();
        let kept: Vec<usize> =
            (0..eigen.eigenvalues.len()).filter(|i| eigen.eigenvalues[*i] > smallest).collect();
        if kept.is_empty() {
            return None;
        }
        let scaled = |power: f64| {
            DMatrix::from_fn(block.gram.nrows(), kept.len(), |i, k| {
                eigen.eigenvectors[(i, kept[k])] * eigen.eigenvalues[kept[k]].powf(power)
            })
        };
        let chance = chi_square_tail(least, kept.len());
        let gains =
            std::array::from_fn(|i| chi_square_beyond(chance * (i as f64 + 0.5) / STRATA as f64, kept.len()));
        let half = scaled(-0.5);
        Some(Self { root: scaled(0.5), inverse: &half * half.transpose(), gains, chance })
    }

    fn draw(&self, stratum: usize, stream: &mut ChaCha8Rng) -> DVector<f64> {
        let direction = DVector::from_fn(self.root.ncols(), |_, _| normal(stream));
        &self.root * (direction.normalize() * self.gains[stratum].sqrt())
    }

    fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        &self.inverse * right
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks of one column each with this correlation between neighbours.
    fn neighbours(count: usize, correlation: f64) -> (DMatrix<f64>, Vec<Block>) {
        let gram = DMatrix::from_fn(count, count, |i, j| correlation.powi(i.abs_diff(j) as i32));
        let free = || vec![f64::INFINITY];
        let one = |_| Block::new(DMatrix::identity(1, 1), &[1.0], vec![f64::NEG_INFINITY], free());
        (gram, (0..count).map(one).collect())
    }

    #[test]
    fn starts_apart_count_each_and_equal_ones_once() {
        let (gram, blocks) = neighbours(12, 0.0);
        assert!((correction(&gram, &blocks, 1, 3) - 12.0).abs() < 0.1);
        let (gram, blocks) = neighbours(12, 1.0);
        assert!((correction(&gram, &blocks, 1, 3) - 1.0).abs() < 1e-9);
        let (gram, blocks) = neighbours(12, 0.9);
        let between = correction(&gram, &blocks, 1, 3);
        assert!((5.0..10.0).contains(&between), "{between}");
    }

    #[test]
    fn a_direction_of_one_sign_has_half_the_chance() {
        let (gram, _) = neighbours(2, 0.0);
        let one = || Block::new(DMatrix::identity(1, 1), &[1.0], vec![0.0], vec![f64::INFINITY]);
        assert!((correction(&gram, &[one(), one()], 1, 3) - 2.0).abs() < 0.3);
    }
}
