//! Triangular factor R of a tall matrix, `A = Q R`, from blocks of rows: `||A u|| = ||R u||` for any u.
//!
//! Householder reflections of `[R; block]` keep all digits of a small residual, which sums of products
//! (`A^T A`) do not. Memory does not grow with the number of rows.

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::fma;
use super::total::total;

/// Rows worked in at once: 14 columns of them fit the first cache.
pub(crate) const ROWS: usize = 256;
/// Products added side by side.
const LANES: usize = 32;

/// The factor of the rows so far.
#[derive(Debug, Clone)]
pub(crate) struct Triangle {
    columns: usize,
    /// Row by row, with zeros below the diagonal.
    factor: Vec<f64>,
    /// Column by column, [`ROWS`] each; zeros between calls.
    block: Vec<f64>,
    isa: Isa,
}

impl Triangle {
    /// The factor of no rows.
    pub(crate) fn new(columns: usize) -> Self {
        let (factor, block) = (vec![0.0; columns * columns], vec![0.0; columns * ROWS]);
        Self { columns, factor, block, isa: dispatch::best() }
    }

    /// Number of columns.
    pub(crate) fn columns(&self) -> usize {
        self.columns
    }

    /// The part of a row from its diagonal on.
    pub(crate) fn row(&self, i: usize) -> &[f64] {
        &self.factor[i * self.columns + i..(i + 1) * self.columns]
    }

    /// An entry, zero below the diagonal.
    pub(crate) fn at(&self, i: usize, j: usize) -> f64 {
        self.factor[i * self.columns + j]
    }

    /// Work in up to [`ROWS`] rows. `fill` gets zeros, [`ROWS`] for each column, and writes the first
    /// `rows` of each.
    pub(crate) fn absorb(&mut self, rows: usize, fill: impl FnOnce(&mut [f64])) {
        fill(&mut self.block);
        reflect(self.isa, &mut self.factor, &mut self.block, rows.min(ROWS).div_ceil(LANES) * LANES);
    }

    /// The factor of the same rows, all multiplied by a number.
    pub(crate) fn scaled(mut self, by: f64) -> Self {
        self.factor.iter_mut().for_each(|entry| *entry *= by);
        self
    }

    /// Work in the rows of another factor with as many columns.
    pub(crate) fn join(&mut self, other: &Self) {
        let n = self.columns;
        for first in (0..n).step_by(ROWS) {
            let rows = (n - first).min(ROWS);
            self.absorb(rows, |block| {
                for (j, column) in block.chunks_exact_mut(ROWS).enumerate() {
                    for (i, value) in column[..rows].iter_mut().enumerate() {
                        *value = other.at(first + i, j);
                    }
                }
            });
        }
    }
}

for_every_isa!(reflect, reflect_generic, (factor: &mut [f64], block: &mut [f64], rows: usize) -> ());

/// Reflect the columns of `[factor; block]` one after the other; leaves zeros in the block.
#[inline(always)]
fn reflect_generic<const FUSED: bool>(factor: &mut [f64], block: &mut [f64], rows: usize) {
    let n = block.len() / ROWS;
    for j in 0..n {
        let (pivot, others) = block[j * ROWS..].split_at_mut(ROWS);
        let pivot = &mut pivot[..rows];
        let square = dot::<FUSED>(pivot, pivot);
        if square > 0.0 {
            let top = factor[j * n + j];
            let norm = (top * top + square).sqrt();
            let head = top + norm.copysign(top);
            let scale = 1.0 / (norm * head.abs());
            factor[j * n + j] = -norm.copysign(top);
            for (k, other) in others.chunks_exact_mut(ROWS).enumerate() {
                let (entry, other) = (&mut factor[j * n + j + 1 + k], &mut other[..rows]);
                let share = scale * fma::<FUSED>(head, *entry, dot::<FUSED>(pivot, other));
                *entry = fma::<FUSED>(-share, head, *entry);
                for (value, p) in other.iter_mut().zip(&*pivot) {
                    *value = fma::<FUSED>(-share, *p, *value);
                }
            }
        }
        pivot.fill(0.0);
    }
}

/// Scalar product of slices whose length is a multiple of [`LANES`].
#[inline(always)]
fn dot<const FUSED: bool>(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for l in 0..LANES {
            sums[l] = fma::<FUSED>(a[l], b[l], sums[l]);
        }
    }
    total(&mut sums)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    fn wave(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| (0.37 * i as f64 * (j + 1) as f64 + j as f64).sin())
    }

    fn copy(matrix: &DMatrix<f64>, first: usize, rows: usize, to: &mut [f64]) {
        for (j, column) in to.chunks_exact_mut(ROWS).enumerate() {
            for (i, value) in column[..rows].iter_mut().enumerate() {
                *value = matrix[(first + i, j)];
            }
        }
    }

    fn streamed(matrix: &DMatrix<f64>, block: usize) -> Triangle {
        let mut triangle = Triangle::new(matrix.ncols());
        for first in (0..matrix.nrows()).step_by(block) {
            let rows = block.min(matrix.nrows() - first);
            triangle.absorb(rows, |to| copy(matrix, first, rows, to));
        }
        triangle
    }

    fn alike(a: &Triangle, b: impl Fn(usize, usize) -> f64) {
        for i in 0..a.columns() {
            let sign = (a.at(i, i) * b(i, i)).signum(); // the sign of a row is free
            for j in 0..a.columns() {
                assert!((a.at(i, j) - sign * b(i, j)).abs() < 1e-12, "{i} {j}");
            }
        }
    }

    #[test]
    fn streaming_equals_one_factorisation() {
        let matrix = wave(1000, 9);
        let whole = matrix.clone().qr().r();
        for block in [1, 7, 100, ROWS] {
            alike(&streamed(&matrix, block), |i, j| whole[(i, j)]);
        }
    }

    #[test]
    fn joined_halves_are_the_whole() {
        let matrix = wave(900, 40);
        let mut first = streamed(&matrix.rows(0, 300).into_owned(), ROWS);
        first.join(&streamed(&matrix.rows(300, 600).into_owned(), ROWS));
        let whole = streamed(&matrix, ROWS);
        alike(&first, |i, j| whole.at(i, j));
    }

    #[test]
    fn every_instruction_set_gives_the_same() {
        let matrix = wave(500, 14);
        let best = streamed(&matrix, ROWS);
        let mut plain = Triangle { isa: Isa::Plain, ..Triangle::new(14) };
        plain.absorb(250, |to| copy(&matrix, 0, 250, to));
        plain.absorb(250, |to| copy(&matrix, 250, 250, to));
        alike(&plain, |i, j| best.at(i, j));
    }

    #[test]
    fn dependent_and_empty_columns_leave_zeros() {
        let matrix = DMatrix::from_fn(50, 3, |i, j| if j == 2 { 0.0 } else { (i + 1) as f64 });
        let triangle = streamed(&matrix, 20);
        assert!(triangle.at(1, 1).abs() < 1e-12);
        assert_eq!(triangle.at(2, 2), 0.0);
    }
}
