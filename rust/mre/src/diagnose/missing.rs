//! Is anything missing? One test for any mismatch: of generic features with memory, and of every recording
//! against the others.

use nalgebra::DVector;

use super::distribution::chi_square_tail;
use super::features::features;
use super::screen::Null;

/// Share of a feature's square that the projection has to leave.
const SMALLEST_SHARE: f64 = 1e-7;
/// Most recordings that are compared one by one.
const MOST_RECORDINGS: usize = 24;

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mismatch {
    /// Chance of at least so much under the null.
    pub(super) p_value: f64,
    /// Squared standard deviations that the features take off, beyond what noise gives.
    pub(super) excess: f64,
}

impl Null<'_> {
    /// Test the features.
    pub(super) fn mismatch(&self) -> Mismatch {
        let recordings = self.assembly().campaign().recordings().len();
        let own = if (2..=MOST_RECORDINGS).contains(&recordings) { recordings } else { 0 };
        let count = features(&self.scene(0)).len();
        let (gram, right, squares) = self.project(count + own, |r| {
            let scene = self.scene(r);
            let mut columns: Vec<(usize, Vec<f64>)> = features(&scene).into_iter().enumerate().collect();
            if own > 0 {
                columns.push((count + r, scene.force.to_vec()));
            }
            columns
        });
        let kept: Vec<usize> =
            (0..count + own).filter(|i| gram[(*i, *i)] > SMALLEST_SHARE * squares[*i]).collect();
        let scale: Vec<f64> = kept.iter().map(|i| 1.0 / gram[(*i, *i)].sqrt()).collect();
        let size = kept.len();
        let correlation =
            nalgebra::DMatrix::from_fn(size, size, |a, b| gram[(kept[a], kept[b])] * scale[a] * scale[b]);
        let eigen = correlation.symmetric_eigen();
        let score = DVector::from_fn(size, |a, _| right[kept[a]] * scale[a]);
        let (mut gain, mut freedom) = (0.0, 0);
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > 1e-6 {
                gain += vector.dot(&score).powi(2) / value;
                freedom += 1;
            }
        }
        if freedom == 0 {
            return Mismatch { p_value: 1.0, excess: 0.0 };
        }
        Mismatch { p_value: chi_square_tail(gain, freedom), excess: (gain - freedom as f64).max(0.0) }
    }
}
