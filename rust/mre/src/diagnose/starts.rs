//! Residuals of recordings that start in motion.

use nalgebra::{DMatrix, DVector};

use super::candidates::of_the_scored;
use crate::assembly::Assembly;
use crate::effect::{Effect, InitialState, starts_in_motion};
use crate::kernel::filter::dot;

/// Forces in N of a model, with what an unknown initial state explains of what they leave.
pub(super) fn with_initial_states(assembly: &Assembly, mut forces: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for (r, force) in forces.iter_mut().enumerate() {
        let recording = &assembly.campaign().recordings()[r];
        let residual = of_the_scored(recording, force);
        let left = without_initial_state(assembly, r, residual.clone());
        for ((force, before), after) in force[recording.scored()].iter_mut().zip(residual).zip(left) {
            *force += before - after;
        }
    }
    forces
}

/// A residual in N of the scored samples, less what an unknown initial state explains of it by least squares.
///
/// A fit under correlated noise does not: it has little against a decay that this noise would make from one large
/// first sample. Taken for noise, that decay would make the noise such a one.
pub(super) fn without_initial_state(assembly: &Assembly, r: usize, residual: Vec<f64>) -> Vec<f64> {
    let recording = &assembly.campaign().recordings()[r];
    if !starts_in_motion(recording) {
        return residual;
    }
    let scored = |column: Vec<f64>| column[recording.scored()].to_vec();
    let columns: Vec<Vec<f64>> =
        InitialState.columns(&assembly.scene(r), &[]).into_iter().map(scored).collect();
    // No remainder is larger than the force.
    let largest = assembly.campaign().sizes().force;
    let ridge = dot(&residual, &residual) / residual.len() as f64 / largest.powi(2);
    let gram = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
        dot(&columns[i], &columns[j]) + if i == j { ridge } else { 0.0 }
    });
    let right = DVector::from_fn(columns.len(), |i, _| dot(&columns[i], &residual));
    let Some(factor) = gram.cholesky() else { return residual };
    let found = factor.solve(&right);
    let explained = |i: usize| columns.iter().zip(found.iter()).map(|(c, a)| a * c[i]).sum::<f64>();
    residual.iter().enumerate().map(|(i, left)| left - explained(i)).collect()
}
