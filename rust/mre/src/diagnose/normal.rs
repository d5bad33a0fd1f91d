//! Normal equations of whitened columns, gathered recording by recording.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::noise::Noise;
use crate::kernel::filter::dot;

/// Samples of a recording that count, as ranges.
pub type Rows = Vec<Range<usize>>;

/// Products of columns with each other and with a target.
#[derive(Debug, Clone)]
pub(super) struct Normal {
    /// Columns with columns.
    pub(super) gram: DMatrix<f64>,
    /// Columns with the target.
    pub(super) right: DVector<f64>,
    /// The target with itself.
    pub(super) target: f64,
    /// Number of rows.
    pub(super) rows: usize,
}

impl Normal {
    /// No rows yet.
    pub(super) fn zeros(columns: usize) -> Self {
        Self { gram: DMatrix::zeros(columns, columns), right: DVector::zeros(columns), target: 0.0, rows: 0 }
    }

    /// Add the rows of one recording: whitened columns with their places.
    pub(super) fn add(&mut self, columns: &[(usize, Vec<f64>)], target: &[f64]) {
        for (k, (i, a)) in columns.iter().enumerate() {
            self.right[*i] += dot(a, target);
            for (j, b) in &columns[..=k] {
                let product = dot(a, b);
                self.gram[(*i, *j)] += product;
                if i != j {
                    self.gram[(*j, *i)] += product;
                }
            }
        }
        self.target += dot(target, target);
        self.rows += target.len();
    }

    /// Add the sums of other rows.
    pub(super) fn merge(&mut self, other: &Self) {
        self.gram += &other.gram;
        self.right += &other.right;
        self.target += other.target;
        self.rows += other.rows;
    }
}

/// Whiten a series and keep the rows that count.
pub(super) fn whitened(noise: &Noise, r: usize, rows: &Rows, series: &[f64]) -> Vec<f64> {
    let lost = noise.lost(r);
    let all = noise.whiten(r, series);
    if let [only] = rows.as_slice()
        && only.start <= lost
        && only.end == series.len()
    {
        return all;
    }
    rows.iter()
        .flat_map(|range| {
            let (start, end) = (range.start.max(lost), range.end.max(lost));
            all[start - lost..end - lost].iter().copied()
        })
        .collect()
}
