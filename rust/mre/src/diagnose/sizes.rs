//! Sizes of what is left over the motion, recording by recording.

use nalgebra::{DMatrix, DVector};

use super::gaps::LeftOut;
use super::motion::{COLUMNS, functions_of_the_motion};
use super::null::Null;
use super::resolution::step_of;
use super::shaken::Change;
use crate::kernel::filter::dot;

/// Samples over which sizes may be correlated.
const MEMORY: usize = 50;
/// Correlations below so many standard deviations are none.
const BY_CHANCE: f64 = 2.0;
/// Rounding to steps above this share of the noise depends on the motion.
const COARSE: f64 = 0.3;
/// Samples that tell something, at least.
const FEWEST: usize = 100;

/// Squares of what is left of a recording and functions of its motion, both about their means.
pub(super) struct Sizes {
    /// Of unit variance.
    pub(super) squares: Vec<f64>,
    /// Standard deviation of the squares over their mean.
    pub(super) spread: f64,
    pub(super) columns: Vec<Vec<f64>>,
}

impl Null<'_> {
    /// Of what is left of the recordings that tell something, as `seen` has whitened series of a recording.
    pub(super) fn sizes<'s>(
        &'s self,
        seen: impl Fn(usize, &[f64]) -> Vec<f64> + 's,
        together: usize,
        size: &'s dyn Fn(&[f64]) -> f64,
    ) -> impl Iterator<Item = Sizes> + 's {
        let recordings = self.assembly().campaign().recordings().len();
        (0..recordings)
            .filter_map(move |r| self.sizes_over_motion(r, &|series| seen(r, series), together, size))
    }

    fn sizes_over_motion(
        &self,
        r: usize,
        seen: &dyn Fn(&[f64]) -> Vec<f64>,
        together: usize,
        size: &dyn Fn(&[f64]) -> f64,
    ) -> Option<Sizes> {
        let (noise, campaign) = (self.noise(), self.assembly().campaign());
        if campaign.doubts()[r].cornered {
            return None;
        }
        let recording = &campaign.recordings()[r];
        let (coefficients, deviation) = noise.autoregression(r);
        let (start, memory) = (recording.scored().start.max(noise.lost(r)), coefficients.len());
        let measured = &recording.force().unwrap_or_default()[recording.scored()];
        let left = seen(self.left(r));
        if start + left.len() != recording.scored().end || step_of(measured) > COARSE * deviation {
            return None;
        }
        let counts = LeftOut::of(campaign, r).telling(start..start + left.len(), memory);
        let whole = |some: &[bool]| some.iter().all(|counts| *counts);
        let counts: Vec<bool> = counts.chunks_exact(together).map(whole).collect();
        let mut squares: Vec<f64> = left.chunks_exact(together).map(size).collect();
        let counted = counts.iter().filter(|c| **c).count() as f64;
        let mean = squares.iter().zip(&counts).filter(|(_, c)| **c).map(|(s, _)| s).sum::<f64>() / counted;
        // Noise of the motion is larger where that is fast.
        let draws: Vec<&Change> = self.changes().collect();
        for change in &draws {
            for (square, some) in squares.iter_mut().zip(seen(&change[r]).chunks_exact(together)) {
                *square -= size(some) / draws.len() as f64;
            }
        }
        let squares = centred(squares, &counts)?;
        let deviation = (dot(&squares, &squares) / counted).sqrt();
        if deviation.is_nan() || deviation <= 0.0 {
            return None;
        }
        let columns = functions_of_the_motion(&self.scene(r), start..start + left.len());
        let means = |column: Vec<f64>| {
            let mean = |some: &[f64]| some.iter().sum::<f64>() / together as f64;
            column.chunks_exact(together).map(mean).collect()
        };
        Some(Sizes {
            squares: squares.iter().map(|s| s / deviation).collect(),
            spread: deviation / mean,
            columns: columns
                .into_iter()
                .map(|column| centred(means(column), &counts))
                .collect::<Option<_>>()?,
        })
    }
}

impl Sizes {
    /// Products of the columns with the squares.
    pub(super) fn right(&self) -> DVector<f64> {
        DVector::from_fn(COLUMNS, |i, _| dot(&self.columns[i], &self.squares))
    }

    /// Covariance of the products of the columns with the squares where these are independent, of any variance.
    pub(super) fn covariance_of_any_size(&self) -> DMatrix<f64> {
        let weighted: Vec<Vec<f64>> = self
            .columns
            .iter()
            .map(|column| column.iter().zip(&self.squares).map(|(c, s)| c * s).collect())
            .collect();
        DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| dot(&weighted[i], &weighted[j]))
    }

    /// Products of the columns with themselves so many samples later.
    pub(super) fn products(&self, lag: usize) -> DMatrix<f64> {
        let (columns, last) = (&self.columns, self.squares.len());
        DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| dot(&columns[i][lag..], &columns[j][..last - lag]))
    }

    /// Covariance of the products of the columns with the squares under the null; neighbouring squares are correlated.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let last = self.squares.len();
        let mut gram = self.products(0);
        for lag in 1..MEMORY.min(last / 4) {
            let correlation = dot(&self.squares[lag..], &self.squares[..last - lag]) / last as f64;
            if correlation.abs() < BY_CHANCE / (last as f64).sqrt() {
                continue;
            }
            let later = self.products(lag) * (correlation * (1.0 - lag as f64 / MEMORY as f64));
            gram += &later + later.transpose();
        }
        gram
    }
}

/// Values about the mean of those that count, the others zero; `None` of too few.
fn centred(mut values: Vec<f64>, counts: &[bool]) -> Option<Vec<f64>> {
    let count = counts.iter().filter(|c| **c).count();
    if count < FEWEST {
        return None;
    }
    let mean = values.iter().zip(counts).filter(|(_, c)| **c).map(|(v, _)| v).sum::<f64>() / count as f64;
    for (value, counts) in values.iter_mut().zip(counts) {
        *value = if *counts { *value - mean } else { 0.0 };
    }
    Some(values)
}
