//! Slopes of the displacement in the place of recorded velocities that are none.

use std::borrow::Borrow;

use rayon::prelude::*;

use super::{Recording, derived, ready};
use crate::error::Result;
use crate::velocity::{Recorded, are_others};

/// Each recording with a derived velocity where the recorded one is a difference quotient of the displacement, or all are
/// smoothed; `None` where it stays.
///
/// # Errors
/// A velocity that is not finite or beyond [`super::LARGEST`].
pub fn with_slopes(recordings: &[impl Borrow<Recording> + Sync]) -> Result<Vec<Option<Recording>>> {
    let recorded = |place: &usize| recordings[*place].borrow().velocity_window.is_none();
    let places: Vec<usize> = (0..recordings.len()).filter(recorded).collect();
    let slopes = places.par_iter().map(|place| derived(&recordings[*place].borrow().series));
    let slopes: Vec<(Vec<f64>, f64)> = slopes.collect::<Result<_>>()?;
    let motions = places.iter().zip(&slopes).map(|(place, (slope, _))| {
        let of: &Recording = recordings[*place].borrow();
        Recorded { time: of.time(), displacement: of.displacement(), velocity: of.velocity(), slope }
    });
    let others = are_others(&motions.collect::<Vec<_>>());
    let mut found = vec![None; recordings.len()];
    for ((place, (velocity, window)), other) in places.into_iter().zip(slopes).zip(others) {
        let (known, ready) = (recordings[place].borrow().clone(), ready::Ready::default());
        let with_slope = || Recording { velocity, velocity_window: Some(window), ready, ..known };
        found[place] = other.then(with_slope);
    }
    Ok(found)
}
