//! Is anything missing? One test for any mismatch: of generic features with memory, and of every recording
//! against the others.

use nalgebra::DVector;

use super::distribution::chi_square_tail;
use super::features::{On, features};
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

impl Mismatch {
    /// No test could be made.
    pub(super) const NONE: Self = Self { p_value: 1.0, excess: 0.0 };
}

/// Projected products of some columns, scaled to unit length.
pub(super) struct Projected {
    gram: nalgebra::DMatrix<f64>,
    right: DVector<f64>,
}

impl Projected {
    /// Columns that the projection leaves.
    fn of(gram: &nalgebra::DMatrix<f64>, right: &DVector<f64>, squares: &[f64], chosen: &[usize]) -> Self {
        let kept: Vec<usize> =
            chosen.iter().copied().filter(|i| gram[(*i, *i)] > SMALLEST_SHARE * squares[*i]).collect();
        let scale: Vec<f64> = kept.iter().map(|i| 1.0 / gram[(*i, *i)].sqrt()).collect();
        Self {
            gram: nalgebra::DMatrix::from_fn(kept.len(), kept.len(), |a, b| {
                gram[(kept[a], kept[b])] * scale[a] * scale[b]
            }),
            right: DVector::from_fn(kept.len(), |a, _| right[kept[a]] * scale[a]),
        }
    }

    /// What the columns take off together.
    fn mismatch(self) -> Mismatch {
        if self.right.is_empty() {
            return Mismatch::NONE;
        }
        let eigen = self.gram.symmetric_eigen();
        let (mut gain, mut freedom) = (0.0, 0);
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value > 1e-6 {
                gain += vector.dot(&self.right).powi(2) / value;
                freedom += 1;
            }
        }
        if freedom == 0 {
            return Mismatch::NONE;
        }
        Mismatch { p_value: chi_square_tail(gain, freedom), excess: (gain - freedom as f64).max(0.0) }
    }
}

/// The features beside a fitted model.
pub(super) struct Generic {
    /// What each depends on.
    on: Vec<On>,
    gram: nalgebra::DMatrix<f64>,
    right: DVector<f64>,
    squares: Vec<f64>,
}

impl Generic {
    /// All features together.
    pub(super) fn mismatch(&self) -> Mismatch {
        self.of(|_| true)
    }

    /// Those that depend on some things.
    pub(super) fn of(&self, chosen: impl Fn(On) -> bool) -> Mismatch {
        let places: Vec<usize> = (0..self.on.len()).filter(|i| chosen(self.on[*i])).collect();
        Projected::of(&self.gram, &self.right, &self.squares, &places).mismatch()
    }

    /// What features depend on, each thing once.
    pub(super) fn things(&self) -> Vec<On> {
        let mut things: Vec<On> = Vec::new();
        for on in &self.on {
            if !things.contains(on) {
                things.push(*on);
            }
        }
        things
    }
}

impl Null<'_> {
    /// Project the features.
    pub(super) fn generic(&self) -> Generic {
        let recordings = self.assembly().campaign().recordings().len();
        let own = if (2..=MOST_RECORDINGS).contains(&recordings) { recordings } else { 0 };
        let mut on: Vec<On> = features(&self.scene(0)).iter().map(|f| f.on).collect();
        let count = on.len();
        on.extend(vec![On::Recording; own]);
        let (gram, right, squares) = self.project(count + own, |r| {
            let scene = self.scene(r);
            let mut columns: Vec<(usize, Vec<f64>)> =
                features(&scene).into_iter().map(|f| f.column).enumerate().collect();
            if own > 0 {
                columns.push((count + r, scene.force.to_vec()));
            }
            columns
        });
        Generic { on, gram, right, squares }
    }
}
