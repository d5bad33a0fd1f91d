//! A residual too large to be noise: how much of it generic features with memory predict, on blocks of each
//! recording that they were not fitted to.
//!
//! The noise of a model that plainly misses is not what it leaves: an autoregression of that would take the
//! slow part of the mismatch for noise, and fits would follow its small fast part.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::features::features;
use super::noise::Noise;
use super::search::rms;
use crate::assembly::Assembly;
use crate::kernel::filter::dot;
use crate::recording::Recording;

/// A residual above this share of the force's rms is not noise where features predict it plainly, or where what
/// a narrower model left was not.
const LARGE: f64 = 0.05;
/// Features plainly predict a residual of which they leave less than this share, rms.
const PLAIN: f64 = 0.7;
/// The same for a residual beside a wider model, once that of a narrower one was not noise.
const STILL_LARGE: f64 = 0.02;
const STILL_PLAIN: f64 = 0.9;
/// Blocks of a recording.
const BLOCKS: usize = 12;
/// Folds that the blocks belong to.
const FOLDS: usize = 4;
/// Ridge on columns of unit rms.
const RIDGE: f64 = 1e-3;

/// Rms in N of the noise at most, if residuals in N of the scored samples are plainly not noise alone.
///
/// `before` is the noise beside a narrower model.
pub(super) fn find(assembly: &Assembly, residuals: &[Vec<f64>], before: &Noise) -> Option<f64> {
    let recordings = assembly.campaign().recordings();
    let spread = |r: &Arc<Recording>| {
        let force = &r.force().unwrap_or_default()[r.scored()];
        let mean = force.iter().sum::<f64>() / force.len() as f64;
        force.iter().map(|f| (f - mean).powi(2)).sum::<f64>()
    };
    let square = |series: &[Vec<f64>]| series.iter().map(|e| dot(e, e)).sum::<f64>();
    let force = recordings.iter().map(spread).sum::<f64>();
    let share = (square(residuals) / force).sqrt();
    if share < if before.hidden() { STILL_LARGE } else { LARGE } {
        return None;
    }
    let left: Vec<Vec<f64>> =
        residuals.par_iter().enumerate().map(|(r, e)| predicted_crosswise(assembly, r, e)).collect();
    let unpredicted = (square(&left) / square(residuals)).sqrt();
    let still = before.hidden() && (share >= LARGE || unpredicted < STILL_PLAIN);
    (unpredicted < PLAIN || still).then(|| rms(&left).min(rms(residuals)))
}

/// A residual less what features, fitted to the other blocks, predict of each block.
fn predicted_crosswise(assembly: &Assembly, r: usize, residual: &[f64]) -> Vec<f64> {
    let scene = assembly.scene(r);
    let scored = assembly.campaign().recordings()[r].scored();
    let count = residual.len();
    let given = [scene.displacement, scene.velocity, scene.force].map(|c| c[scored.clone()].to_vec());
    let mut columns: Vec<Vec<f64>> = vec![vec![1.0; count]];
    columns.extend(given);
    columns.extend(features(&scene).into_iter().map(|f| f.column[scored.clone()].to_vec()));
    columns.retain(|c| dot(c, c) > 0.0);
    for column in &mut columns {
        let scale = (count as f64 / dot(column, column)).sqrt();
        for value in column {
            *value *= scale;
        }
    }
    let edge = |b: usize| count * b / BLOCKS;
    let width = columns.len();
    let folds: Vec<(DMatrix<f64>, DVector<f64>)> = (0..FOLDS)
        .map(|fold| {
            let mut gram = DMatrix::zeros(width, width);
            let mut right = DVector::zeros(width);
            for b in (fold..BLOCKS).step_by(FOLDS) {
                let here = edge(b)..edge(b + 1);
                for (i, a) in columns.iter().enumerate() {
                    let a = &a[here.clone()];
                    right[i] += dot(a, &residual[here.clone()]);
                    for (j, b) in columns[..=i].iter().enumerate() {
                        gram[(i, j)] += dot(a, &b[here.clone()]);
                    }
                }
            }
            gram.fill_upper_triangle_with_lower_triangle();
            (gram, right)
        })
        .collect();
    let mut left = residual.to_vec();
    for fold in 0..FOLDS {
        let others = folds.iter().enumerate().filter(|(f, _)| *f != fold);
        let mut gram = DMatrix::identity(width, width) * (RIDGE * count as f64);
        let mut right = DVector::zeros(width);
        for (_, (g, b)) in others {
            gram += g;
            right += b;
        }
        let Some(factor) = gram.cholesky() else { continue };
        let weights = factor.solve(&right);
        for b in (fold..BLOCKS).step_by(FOLDS) {
            for i in edge(b)..edge(b + 1) {
                left[i] -= columns.iter().zip(&weights).map(|(c, w)| c[i] * w).sum::<f64>();
            }
        }
    }
    left
}
