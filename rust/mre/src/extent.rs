//! The sizes in the recordings from which default boxes are made.

use std::sync::Arc;

use nalgebra::{Matrix4, Vector4};

use crate::error::{Error, Result};
use crate::kernel::elementary::sinh;
use crate::recording::Recording;

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
    /// Mean force of the scored samples, N.
    pub mean_force: f64,
    /// True where the force grows less than in proportion to the displacement.
    pub softens: bool,
}

impl Extent {
    /// For questions about parameters that do not depend on recordings.
    pub const UNIT: Self =
        Self { displacement: 1.0, shortest: 1.0, velocity: 1.0, force: 1.0, mean_force: 0.0, softens: false };

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
        let mut count = 0.0;
        for recording in recordings {
            let scored = scored_force(recording)?;
            let stroke = farthest(recording.displacement(), 0.0);
            extent.displacement = extent.displacement.max(stroke);
            extent.shortest = extent.shortest.min(stroke);
            extent.velocity = farthest(recording.velocity(), extent.velocity);
            extent.force = farthest(scored, extent.force);
            extent.mean_force += scored.iter().sum::<f64>();
            count += scored.len() as f64;
        }
        if extent.force == 0.0 {
            return Err(Error::Recording("the force is zero throughout: nothing to identify".into()));
        }
        extent.mean_force /= count;
        extent.softens = softens(recordings, &extent)?;
        Ok(extent)
    }
}

fn scored_force(recording: &Recording) -> Result<&[f64]> {
    match recording.force() {
        Some(force) => Ok(&force[recording.scored()]),
        None => {
            Err(Error::Recording("no force: an identification needs one".into())
                .in_recording(recording.name()))
        }
    }
}

/// Sign of the sinh term in a least-squares fit of `c v + k x + a sinh(x / X) + F0`.
fn softens(recordings: &[Arc<Recording>], extent: &Extent) -> Result<bool> {
    let (mut matrix, mut right) = (Matrix4::zeros(), Vector4::zeros());
    for recording in recordings {
        let force = scored_force(recording)?;
        for (i, f) in recording.scored().zip(force) {
            let x = recording.displacement()[i] / extent.displacement;
            let row = Vector4::new(recording.velocity()[i] / extent.velocity, x, sinh(x), 1.0);
            matrix += row * row.transpose();
            right += row * *f;
        }
    }
    Ok(matrix.cholesky().is_some_and(|factor| factor.solve(&right)[2] < 0.0))
}
