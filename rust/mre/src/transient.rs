//! Start and stop transients of a steady test, found from the strokes between reversals.

use crate::effect::starts_in_motion;
use crate::error::{Error, Result};
use crate::recording::{Recording, extent};

/// A stroke of the steady part comes within this share of the typical one.
const TOLERANCE: f64 = 0.1;
/// A motion counts as steady where this share of the path is typical strokes.
const STEADY_SHARE: f64 = 0.5;

/// The parts of a recording that can be excluded by name.
pub const NAMES: [&str; 2] = ["start_transient", "stop_transient"];

/// Exclude named parts from the fitness; they stay in the simulation.
///
/// Where the motion has no steady part (an earthquake), nothing is excluded.
///
/// # Errors
/// A name that is not in [`NAMES`].
pub fn exclude(recording: &Recording, names: &[&str]) -> Result<Recording> {
    if let Some(unknown) = names.iter().find(|name| !NAMES.contains(name)) {
        return Err(Error::setting(
            "part to exclude",
            format!("'{unknown}'"),
            format!("one of {}", NAMES.join(", ")),
        ));
    }
    let Some((first, last)) = steady_part(recording.displacement()) else {
        return Ok(recording.clone());
    };
    let mut scored = recording.scored();
    if names.contains(&NAMES[0]) {
        scored.start = scored.start.max(first);
    }
    if names.contains(&NAMES[1]) {
        scored.end = scored.end.min(last + 1);
    }
    recording.with_scored(scored)
}

/// Lengths between reversals.
fn strokes(displacement: &[f64], reversals: &[usize]) -> Vec<f64> {
    reversals.windows(2).map(|pair| (displacement[pair[1]] - displacement[pair[0]]).abs()).collect()
}

/// First and last sample of the steady part: from the first to the last reversal that bounds a
/// typical stroke.
fn steady_part(displacement: &[f64]) -> Option<(usize, usize)> {
    let reversals = reversals(displacement);
    let strokes = strokes(displacement, &reversals);
    let typical = weighted_median(&strokes)?;
    let near = |stroke: &f64| (stroke - typical).abs() <= TOLERANCE * typical;
    let (steady, path) = (strokes.iter().filter(|s| near(s)).sum::<f64>(), strokes.iter().sum::<f64>());
    if steady < STEADY_SHARE * path {
        return None;
    }
    let first = strokes.iter().position(near)?;
    let last = strokes.iter().rposition(near)?;
    Some((reversals[first], reversals[last + 1]))
}

/// True where a recording is cut from a steady motion: all of its strokes but the first and the last, which may be cut, are
/// alike.
pub(crate) fn is_steady(recording: &Recording) -> bool {
    let displacement = recording.displacement();
    let strokes = strokes(displacement, &reversals(displacement));
    let whole = strokes.get(1..strokes.len().saturating_sub(1)).unwrap_or_default();
    let Some(typical) = weighted_median(whole) else { return false };
    starts_in_motion(recording) && whole.iter().all(|stroke| (stroke - typical).abs() <= TOLERANCE * typical)
}

/// Samples at which the displacement turns by more than a tenth of its range.
pub(crate) fn reversals(displacement: &[f64]) -> Vec<usize> {
    let (low, high) = extent(displacement);
    let threshold = 0.1 * (high - low);
    let mut found = Vec::new();
    let (mut lowest, mut highest) = (0, 0);
    let mut rising = None;
    for (i, &x) in displacement.iter().enumerate() {
        if x > displacement[highest] {
            highest = i;
        }
        if x < displacement[lowest] {
            lowest = i;
        }
        if rising != Some(true) && x > displacement[lowest] + threshold {
            found.push(lowest);
            (rising, highest) = (Some(true), i);
        } else if rising != Some(false) && x < displacement[highest] - threshold {
            found.push(highest);
            (rising, lowest) = (Some(false), i);
        }
    }
    match rising {
        Some(true) => found.push(highest),
        Some(false) => found.push(lowest),
        None => {}
    }
    found
}

/// The stroke at which half of the path is reached when strokes are taken from small to large.
fn weighted_median(strokes: &[f64]) -> Option<f64> {
    let mut sorted = strokes.to_vec();
    sorted.sort_by(f64::total_cmp);
    let half = 0.5 * sorted.iter().sum::<f64>();
    let mut path = 0.0;
    sorted.into_iter().find(|stroke| {
        path += stroke;
        path >= half
    })
}
