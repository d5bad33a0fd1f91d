//! Small moves of single shapes, for difference quotients of a force.

use super::least_squares::Fitted;
use crate::assembly::{Assembly, Columns};

/// Step of the difference quotients, in the unit box.
const STEP: f64 = 1e-4;

/// Shapes in their units near a point of the unit box: in each of them one has moved.
pub(super) struct Moves {
    moved: Vec<(f64, Vec<f64>)>,
    first: usize,
}

impl Moves {
    /// Of every shape.
    pub(super) fn of(assembly: &Assembly, fitted: &Fitted) -> Self {
        let here = assembly.physical(&fitted.unit);
        let moved = |j: usize| {
            let mut unit = fitted.unit.clone();
            let step = if unit[j] + STEP > 1.0 { -STEP } else { STEP };
            unit[j] += step;
            // The others stay to the bit, so that what is known of them is found.
            let mut shapes = here.clone();
            shapes[j] = assembly.physical(&unit)[j];
            (step, shapes)
        };
        Self { moved: (0..fitted.unit.len()).map(moved).collect(), first: fitted.coefficients.len() }
    }

    /// Shapes that bear on a recording.
    pub(super) fn bearing<'m>(
        &'m self,
        assembly: &'m Assembly,
        r: usize,
    ) -> impl Iterator<Item = usize> + 'm {
        (0..self.moved.len()).filter(move |j| assembly.bears(*j, r))
    }

    /// Shapes in their units of which this one has moved.
    pub(super) fn shapes(&self, j: usize) -> &[f64] {
        &self.moved[j].1
    }

    /// Place of a shape behind the coefficients, and how the force in N moves with it: zero where it is not finite.
    pub(super) fn slope(
        &self,
        j: usize,
        columns: &Columns,
        coefficients: &[f64],
        before: &[f64],
    ) -> (usize, Vec<f64>) {
        let mut change = columns.measured(coefficients);
        for (value, before) in change.iter_mut().zip(before) {
            *value = (*value - before) / self.moved[j].0;
            if !value.is_finite() {
                *value = 0.0;
            }
        }
        (self.first + j, change)
    }
}
