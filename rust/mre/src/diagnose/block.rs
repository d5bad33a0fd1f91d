//! The columns of the starts of a law, projected: what they take off, and how often noise takes off as much.

use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;

use super::bounded;
use super::distribution::{chi_square_tail, normal};

/// Share of a column's square that has to survive the projection: below it the column is absorbed.
pub(super) const SMALLEST_SHARE: f64 = 1e-8;
/// Simulated draws for the correction over the starts of a law.
const DRAWS: usize = 400;
/// Level at which the correction is measured.
const LEVEL: f64 = 0.05;

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
        let freedom = (0..self.gram.nrows()).filter(|i| self.gram[(*i, *i)] > 0.0).count();
        if freedom == 0 || gain <= 0.0 {
            return 1.0;
        }
        let one_sided = freedom == 1 && (self.lower[0] == 0.0 || self.upper[0] == 0.0);
        chi_square_tail(gain, freedom) * if one_sided { 0.5 } else { 1.0 }
    }
}

/// Number of starts as far as they differ: how much more often the smallest p-value over the starts falls
/// below a level than that of one of them.
pub(super) fn correction(gram: &DMatrix<f64>, blocks: &[Block], width: usize, seed: u64) -> f64 {
    if blocks.len() == 1 {
        return 1.0;
    }
    let count = gram.nrows();
    let eigen = gram.clone().symmetric_eigen();
    let root = DMatrix::from_fn(count, count, |i, j| {
        eigen.eigenvectors[(i, j)] * eigen.eigenvalues[j].max(0.0).sqrt()
    });
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    let mut below = 0;
    for _ in 0..DRAWS {
        let draw = &root * DVector::from_fn(count, |_, _| normal(&mut stream));
        let smallest = blocks
            .iter()
            .enumerate()
            .map(|(s, b)| b.tail(b.gain(&draw.rows(s * width, width).into_owned())))
            .fold(1.0, f64::min);
        below += usize::from(smallest <= LEVEL);
    }
    // A small-level number of tests is a little larger than that at the level where it is measured.
    let at_level = (below as f64 / DRAWS as f64).min(0.999);
    ((1.0 - at_level).ln() / (1.0 - LEVEL).ln() * 1.25).clamp(1.0, blocks.len() as f64)
}
