//! Noise of a size that follows the motion, such as one that grows with the force: tests weigh samples by the size around
//! them. The tangents of even noise would take a few samples where it is large for a mismatch.

use nalgebra::{DMatrix, DVector};

use super::motion::COLUMNS;
use super::null::Null;
use super::uneven::{chance, weights};
use crate::kernel::filter::dot;

/// Samples that are taken together: of the difference of two, what is missing and smooth takes no part.
const PAIR: usize = 2;
/// Squares above this many variances count as this many.
const LARGEST: [f64; 2] = [9.0, 30.0];
/// The size of a noise follows the motion where it does so by chance more seldom,
const PLAINLY: f64 = 1e-6;
/// and what is left is noise of any size where neighbours go together by chance more often.
const NOISE: f64 = 1e-3;
/// Least variance over the mean.
const LEAST: f64 = 0.05;

impl Null<'_> {
    /// What whitened samples are to be multiplied with, by recording; `None` where the noise is of even size, or where
    /// more than noise may be left.
    pub(super) fn weights_over_the_motion(&self) -> Option<Vec<Vec<f64>>> {
        if !self.knows_its_noise() || self.is_shaken() {
            return None;
        }
        let (plain, right) = self.followed_by_pairs(LARGEST[0]);
        if plain.trace() <= 0.0 || chance(&plain, &right) > PLAINLY || self.linked() < NOISE {
            return None;
        }
        let (plain, right) = self.followed_by_pairs(LARGEST[1]);
        let shares = weights(&plain, &right)?;
        Some((0..self.point.recordings.len()).map(|r| self.weights_of(r, &shares)).collect())
    }

    /// Products of functions of the motion with each other, and with the sizes of differences of neighbours.
    fn followed_by_pairs(&self, largest: f64) -> (DMatrix<f64>, DVector<f64>) {
        let (mut plain, mut right) = (DMatrix::zeros(COLUMNS, COLUMNS), DVector::zeros(COLUMNS));
        for own in self.sizes(PAIR, &half_square_of_the_difference(largest)) {
            plain += own.products(0);
            right += own.right();
        }
        (plain, right)
    }

    /// Of a recording, by what functions of its motion add to the variance; they leave the sum of squares as it is.
    fn weights_of(&self, r: usize, shares: &DVector<f64>) -> Vec<f64> {
        let left = &self.point.recordings[r].residual;
        let Some(own) = self.sizes_over_motion(r, PAIR, &half_square_of_the_difference(LARGEST[1])) else {
            return vec![1.0; left.len()];
        };
        let follows = |i: usize| (0..COLUMNS).map(|k| shares[k] * own.columns[k][i]).sum::<f64>();
        let last = own.squares.len() - 1;
        let variance = |i: usize| (1.0 + own.spread * follows((i / PAIR).min(last))).max(LEAST);
        let mut weights: Vec<f64> = (0..left.len()).map(|i| variance(i).sqrt().recip()).collect();
        let weighted: f64 = left.iter().zip(&weights).map(|(e, w)| (e * w).powi(2)).sum();
        let scale = (dot(left, left) / weighted).sqrt();
        weights.iter_mut().for_each(|w| *w *= scale);
        weights
    }

    /// What is left of a recording as it is, whitened.
    pub(super) fn unweighted(&self, r: usize) -> Vec<f64> {
        let left = &self.point.recordings[r].residual;
        match self.weights(r) {
            Some(weights) => left.iter().zip(weights).map(|(e, w)| e / w).collect(),
            None => left.clone(),
        }
    }
}

fn half_square_of_the_difference(largest: f64) -> impl Fn(&[f64]) -> f64 {
    move |pair| (0.5 * (pair[1] - pair[0]).powi(2)).min(largest)
}
