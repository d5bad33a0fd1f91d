//! One damped Gauss-Newton step in the unit box.

use nalgebra::{DMatrix, DVector};

/// Longest step, in the unit box: beyond it a linearisation is not trusted.
const LONGEST: f64 = 0.3;

/// What is added to the diagonal of the scaled normal equations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ridge {
    pub(super) coefficients: f64,
    pub(super) shapes: f64,
}

/// Step of the shapes, and what it takes off the linearised sum of squares; shapes on a wall stay where the
/// step points out of the box. The normal equations hold the coefficients first, then the shapes.
pub(super) fn step(gram: &DMatrix<f64>, right: &DVector<f64>, ridge: Ridge, unit: &[f64]) -> (Vec<f64>, f64) {
    let d = unit.len();
    let k = right.len() - d;
    let mut held = vec![false; d];
    loop {
        let open: Vec<usize> =
            (0..k + d).filter(|i| gram[(*i, *i)] > 0.0 && (*i < k || !held[i - k])).collect();
        let scale: Vec<f64> =
            open.iter().map(|i| gram[(*i, *i)].sqrt().max(f64::MIN_POSITIVE.sqrt())).collect();
        let matrix = DMatrix::from_fn(open.len(), open.len(), |a, b| {
            let own = if open[a] < k { ridge.coefficients } else { ridge.shapes };
            gram[(open[a], open[b])] / (scale[a] * scale[b]) + if a == b { own } else { 0.0 }
        });
        let scaled = DVector::from_fn(open.len(), |a, _| right[open[a]] / scale[a]);
        let mut step = vec![0.0; d];
        let Some(factor) = matrix.cholesky() else { return (step, 0.0) };
        let solution = factor.solve(&scaled);
        for (a, i) in open.iter().enumerate().filter(|(_, i)| **i >= k) {
            step[i - k] = solution[a] / scale[a];
        }
        let outward = |j: usize| (unit[j] <= 0.0 && step[j] < 0.0) || (unit[j] >= 1.0 && step[j] > 0.0);
        let leaving: Vec<usize> = (0..d).filter(|j| !held[*j] && outward(*j)).collect();
        if leaving.is_empty() {
            let longest = step.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
            let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
            return (step.iter().map(|s| s * share).collect(), scaled.dot(&solution));
        }
        for j in leaving {
            held[j] = true;
        }
    }
}
