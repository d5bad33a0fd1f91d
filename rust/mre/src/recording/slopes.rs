//! Slopes of the displacement in the place of recorded velocities that are none.

use std::borrow::Borrow;

use rayon::prelude::*;

use super::{Recording, derived, ready};
use crate::velocity::{Recorded, are_others};

/// Each recording with a derived velocity where the recorded one is a difference quotient of the displacement, or all are
/// smoothed; `None` where it stays, as where none can be derived.
pub fn with_slopes(recordings: &[impl Borrow<Recording> + Sync]) -> Vec<Option<Recording>> {
    let with_slope = |recording: &Recording| {
        let recorded = recording.velocity_window.is_none();
        let (velocity, window) = recorded.then(|| derived(&recording.series).ok())??;
        let ready = ready::Ready::default();
        Some(Recording { velocity, velocity_window: Some(window), ready, ..recording.clone() })
    };
    let found: Vec<Option<Recording>> =
        recordings.par_iter().map(|recording| with_slope(recording.borrow())).collect();
    let both = recordings.iter().zip(&found);
    let motions: Vec<Recorded> =
        both.filter_map(|(given, found)| Some(motion(given.borrow(), found.as_ref()?))).collect();
    let mut others = are_others(&motions).into_iter();
    found.into_iter().map(|one| one.filter(|_| others.next().unwrap_or(false))).collect()
}

/// As recorded, and as its displacement has it.
fn motion<'a>(given: &'a Recording, found: &'a Recording) -> Recorded<'a> {
    Recorded {
        time: given.time(),
        displacement: given.displacement(),
        velocity: given.velocity(),
        slope: found.velocity(),
    }
}
