//! The sizes in the recordings from which default boxes are made.

use std::sync::Arc;

use nalgebra::{Matrix4, Vector4};

use crate::error::{Error, Result};
use crate::kernel::elementary::sinh;
use crate::recording::{Recording, SMALLEST};

/// Sizes over all recordings of a problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extent {
    /// Largest absolute displacement, mm.
    pub displacement: f64,
    /// Largest absolute displacement of the recording that moves least, mm.
    pub shortest: f64,
    /// Largest speed, mm/s.
    pub velocity: f64,
    /// Largest absolute force among the scored samples, N.
    pub force: f64,
    /// Force at rest in the middle by a least-squares line through the scored samples, N.
    pub offset: f64,
    /// Mean displacement of the scored samples as a share of the largest: how far the motion is off the
    /// middle, where the offset is uncertain.
    pub lean: f64,
    /// True where the force grows less than in proportion to the displacement.
    pub softens: bool,
}

impl Extent {
    /// For questions about parameters that do not depend on recordings.
    pub const UNIT: Self = Self {
        displacement: 1.0,
        shortest: 1.0,
        velocity: 1.0,
        force: 1.0,
        offset: 0.0,
        lean: 0.0,
        softens: false,
    };

    /// Sizes of recordings.
    ///
    /// # Errors
    /// No recording, a recording without force, or no force at all.
    pub fn of(recordings: &[Arc<Recording>]) -> Result<Self> {
        if recordings.is_empty() {
            return Err(Error::setting("recordings", "an empty list", "at least one recording"));
        }
        let farthest = |values: &[f64], so_far: f64| values.iter().fold(so_far, |far, v| v.abs().max(far));
        let mut extent =
            Self { displacement: 0.0, shortest: f64::INFINITY, velocity: 0.0, force: 0.0, ..Self::UNIT };
        for recording in recordings {
            let scored = scored_force(recording)?;
            let stroke = farthest(recording.displacement(), 0.0);
            extent.displacement = extent.displacement.max(stroke);
            extent.shortest = extent.shortest.min(stroke);
            extent.velocity = farthest(recording.velocity(), extent.velocity);
            extent.force = farthest(scored, extent.force);
        }
        if extent.velocity == 0.0 {
            let text = "velocity is zero throughout, though the displacement changes";
            return Err(Error::Recording(text.into()).in_recording(recordings[0].name()));
        }
        extent.fit(recordings)?;
        Ok(extent)
    }

    /// Offset, lean and softening from a least-squares fit of `c v + k x + a sinh(x / X) + F0`; the
    /// offset from the same without the sinh term.
    fn fit(&mut self, recordings: &[Arc<Recording>]) -> Result<()> {
        let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for recording in recordings {
            let force = scored_force(recording)?;
            for (i, f) in recording.scored().zip(force) {
                let x = recording.displacement()[i] / self.displacement;
                let row = Vector4::new(recording.velocity()[i] / self.velocity, x, 1.0, sinh(x));
                matrix += row * row.transpose();
                right += row * *f;
            }
        }
        self.settle(&matrix, &right);
        Ok(())
    }

    /// From the products of the columns `v`, `x / X`, 1, `sinh(x / X)`, and theirs with the force.
    pub(crate) fn settle(&mut self, matrix: &Matrix4<f64>, right: &Vector4<f64>) {
        let line = matrix.fixed_view::<3, 3>(0, 0).into_owned().cholesky();
        let offset = line.map_or(0.0, |factor| factor.solve(&right.fixed_rows::<3>(0).into_owned())[2]);
        self.offset = offset.clamp(-self.force, self.force);
        self.lean = (matrix[(1, 2)] / matrix[(2, 2)]).abs();
        self.softens = matrix.cholesky().is_some_and(|factor| factor.solve(right)[3] < 0.0);
    }
}

/// What is wrong with forces of which the largest is too small to be identified.
pub(crate) fn too_small(largest: f64) -> String {
    if largest > 0.0 {
        format!("the force is at most {largest:e} N: nothing to identify below {SMALLEST:e} N")
    } else {
        "the force is zero throughout: nothing to identify".into()
    }
}

fn scored_force(recording: &Recording) -> Result<&[f64]> {
    let problem = match recording.force() {
        None => "no force: an identification needs one".into(),
        Some(force) => {
            let scored = &force[recording.scored()];
            let largest = scored.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
            if largest >= SMALLEST {
                return Ok(scored);
            }
            too_small(largest)
        }
    };
    Err(Error::Recording(problem).in_recording(recording.name()))
}
