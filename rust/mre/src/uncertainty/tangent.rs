//! Derivatives of the force by the parameters.

use std::sync::atomic::AtomicBool;

use crate::error::{Error, Result};
use crate::fitness::Scratch;
use crate::law::Law;
use crate::model::Model;
use crate::recording::Recording;

/// Step of the differences as a share of the parameter.
const STEP: f64 = 1e-3;
/// Differences of fourth order: steps and weights.
const STENCIL: [(f64, f64); 4] =
    [(-2.0, 1.0 / 12.0), (-1.0, -8.0 / 12.0), (1.0, 8.0 / 12.0), (2.0, -1.0 / 12.0)];

/// `sum of weight * f(values + step)` over the stencil at parameter `j`, divided by the step, for a
/// function of many outputs; `size` is how large a change of the parameter is.
pub(super) fn difference(
    values: &[f64],
    j: usize,
    size: f64,
    mut function: impl FnMut(&[f64]) -> Vec<f64>,
) -> Vec<f64> {
    let h = STEP * size;
    let mut sum = Vec::new();
    for (steps, weight) in STENCIL {
        let mut moved = values.to_vec();
        moved[j] += steps * h;
        let found = function(&moved);
        sum.resize(found.len(), 0.0);
        for (s, f) in sum.iter_mut().zip(found) {
            *s += weight * f / h;
        }
    }
    sum
}

/// Force over the scored samples.
pub(super) fn force(law: &Law, model: &Model, recording: &Recording, values: &[f64]) -> Vec<f64> {
    let mut scratch = Scratch::default();
    scratch.resize(recording.len());
    law.add_force(model, recording, values, &mut scratch);
    scratch.force[recording.scored()].to_vec()
}

/// Derivative of the force over the scored samples by every parameter: coefficients are exact, shapes
/// by differences.
///
/// # Errors
/// [`Error::Stopped`] soon after `cancel` is set.
pub(super) fn tangents(
    law: &Law,
    model: &Model,
    recording: &Recording,
    values: &[f64],
    cancel: &AtomicBool,
) -> Result<Vec<Vec<f64>>> {
    let mut columns = law.columns(model, recording, values).into_iter();
    let shapes = law.shapes(model);
    (0..values.len())
        .map(|j| {
            Error::if_stopped(cancel)?;
            if shapes[j] {
                let size = if values[j] == 0.0 { 1.0 } else { values[j].abs() };
                Ok(difference(values, j, size, |moved| force(law, model, recording, moved)))
            } else {
                Ok(columns.next().unwrap_or_default()[recording.scored()].to_vec())
            }
        })
        .collect()
}
