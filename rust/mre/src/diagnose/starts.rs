//! Residuals of recordings that start in motion.

use super::candidates::residual;
use super::explained::unexplained;
use crate::assembly::Assembly;
use crate::effect::{Effect, InitialState, starts_in_motion};
use crate::kernel::filter::dot;

/// Forces in N of a model, with what an unknown initial state explains of what they leave.
pub(super) fn with_initial_states(assembly: &Assembly, mut forces: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    for (r, force) in forces.iter_mut().enumerate() {
        let campaign = assembly.campaign();
        let before = residual(campaign, r, force);
        let left = without_initial_state(assembly, r, before.clone());
        let scored = campaign.recordings()[r].scored();
        for ((force, before), after) in force[scored].iter_mut().zip(before).zip(left) {
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
    let columns = InitialState.columns(&assembly.scene(r), &[]);
    // No remainder is larger than the force.
    let largest = assembly.campaign().sizes().force;
    let ridge = dot(&residual, &residual) / residual.len() as f64 / largest.powi(2);
    let columns: Vec<&[f64]> = columns.iter().map(|column| &column[recording.scored()]).collect();
    unexplained(residual, &columns, |_| ridge)
}
