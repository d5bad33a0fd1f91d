//! Residuals of recordings that start in motion.

use super::candidates::residual;
use super::drift::{line, without};
use super::explained::unexplained;
use crate::assembly::Assembly;
use crate::effect::{Effect, InitialState, Scene, starts_in_motion};
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
    let Some(columns) = remainders(assembly, r) else { return residual };
    // No remainder is larger than the force.
    let largest = assembly.campaign().sizes().force;
    let ridge = dot(&residual, &residual) / residual.len() as f64 / largest.powi(2);
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    unexplained(residual, &columns, |_| ridge)
}

/// Residuals in N of the scored samples, less what unknown initial states and a line explain of them together;
/// `None` for recordings that start at rest.
///
/// Decays that are fitted to a drift alone leave more of it than noise has. More columns than those of a line would
/// take off what slow noise is known by.
pub(super) fn calm(assembly: &Assembly, residuals: &[Vec<f64>]) -> Vec<Option<Vec<f64>>> {
    let of_one = |(r, residual): (usize, &Vec<f64>)| {
        let mut columns = remainders(assembly, r)?;
        columns.extend(line(residual.len()));
        Some(without(residual, &columns))
    };
    residuals.iter().enumerate().map(of_one).collect()
}

/// What unknown initial states can add to the scored samples, if any.
fn remainders(assembly: &Assembly, r: usize) -> Option<Vec<Vec<f64>>> {
    let recording = &assembly.campaign().recordings()[r];
    let scored = |column: Vec<f64>| column[recording.scored()].to_vec();
    let all = |scene: Scene| InitialState.columns(&scene, &[]).into_iter().chain(scene.fading.to_vec());
    starts_in_motion(recording).then(|| all(assembly.scene(r)).map(scored).collect())
}
