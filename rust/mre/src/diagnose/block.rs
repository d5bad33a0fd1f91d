//! The columns of the starts of a law, projected: what they take off, and how often noise takes off as much.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;

use super::bounded;
use super::distribution::{chi_square_beyond, chi_square_tail, normal};

/// Share of a column's square that has to survive the projection: below it the column is absorbed.
pub(super) const SMALLEST_SHARE: f64 = 1e-8;
/// Simulated draws for the correction over the starts of a law.
const DRAWS: usize = 400;
/// Gains that are drawn in turn.
const STRATA: usize = 8;
/// Level at which the correction is measured: that of one effect of a whole catalogue. The further out, the more the
/// starts count.
const LEVEL: f64 = 2e-4;

/// The columns of one start of a law, projected.
pub(super) struct Block {
    gram: DMatrix<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Largest share of a column that the projection left.
    pub(super) visible: f64,
}

impl Block {
    pub(super) fn new(mut gram: DMatrix<f64>, squares: &[f64], lower: Vec<f64>, upper: Vec<f64>) -> Self {
        let mut visible: f64 = 0.0;
        for (i, square) in squares.iter().enumerate() {
            let share = if *square > 0.0 { gram[(i, i)] / square } else { 0.0 };
            if share < SMALLEST_SHARE {
                gram.row_mut(i).fill(0.0);
                gram.column_mut(i).fill(0.0);
            } else {
                visible = visible.max(share);
            }
        }
        Self { gram, lower, upper, visible }
    }

    /// Squared standard deviations that the columns take off, with admissible coefficients.
    pub(super) fn gain(&self, right: &DVector<f64>) -> f64 {
        if right.len() == 1 {
            let c = self.gram[(0, 0)];
            let value = right[0];
            let admissible = (value > 0.0 && self.upper[0] > 0.0) || (value < 0.0 && self.lower[0] < 0.0);
            return if c > 0.0 && admissible { value * value / c } else { 0.0 };
        }
        let c = DVector::from_vec(bounded::minimise(&self.gram, right, &self.lower, &self.upper));
        (2.0 * right.dot(&c) - c.dot(&(&self.gram * &c))).max(0.0)
    }

    /// Chance of at least this gain under the null.
    pub(super) fn tail(&self, gain: f64) -> f64 {
        let freedom = self.freedom();
        if freedom == 0 || gain <= 0.0 {
            return 1.0;
        }
        chi_square_tail(gain, freedom) * self.sides()
    }

    fn freedom(&self) -> usize {
        (0..self.gram.nrows()).filter(|i| self.gram[(*i, *i)] > 0.0).count()
    }

    /// Share of the signs that count.
    fn sides(&self) -> f64 {
        let one_sided = self.freedom() == 1 && (self.lower[0] == 0.0 || self.upper[0] == 0.0);
        if one_sided { 0.5 } else { 1.0 }
    }
}

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
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    let draws = DRAWS.div_ceil(blocks.len()).next_multiple_of(STRATA);
    let mut number = 0.0;
    for (s, block) in blocks.iter().enumerate() {
        let Some(beyond) = Beyond::of(block) else { continue };
        let columns = gram.columns(s * width, width);
        let mut shares = 0.0;
        for draw in 0..draws {
            let mut right = root.draw(&mut stream);
            let wanted = beyond.draw(draw % STRATA, &mut stream);
            let away = beyond.solve(&(wanted - right.rows(s * width, width)));
            right += columns * away;
            let below =
                |(s, b): (usize, &Block)| b.tail(b.gain(&right.rows(s * width, width).into_owned())) <= LEVEL;
            if below((s, block)) {
                let all = blocks.iter().enumerate().filter(|b| below(*b)).count();
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

/// The products of one start that give it at least the gain of the level.
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
    fn of(block: &Block) -> Option<Self> {
        let freedom = block.freedom();
        let eigen = block.gram.clone().symmetric_eigen();
        let smallest = 1e-12 * eigen.eigenvalues.max();
        let kept: Vec<usize> =
            (0..eigen.eigenvalues.len()).filter(|i| eigen.eigenvalues[*i] > smallest).collect();
        if freedom == 0 || kept.is_empty() {
            return None;
        }
        let scaled = |power: f64| {
            DMatrix::from_fn(block.gram.nrows(), kept.len(), |i, k| {
                eigen.eigenvectors[(i, kept[k])] * eigen.eigenvalues[kept[k]].powf(power)
            })
        };
        let least = chi_square_beyond(LEVEL / block.sides(), freedom);
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
