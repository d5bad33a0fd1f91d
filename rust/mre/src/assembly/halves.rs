//! A motion halfway between its samples: where a hysteretic device turns, a spline through the samples of its force
//! swings, by more than a filter faster than their spacing does to it.

use crate::kernel::halfway::middles;
use crate::kernel::jumps::jumps;
use crate::recording::{Condition, Recording, Series};

/// The recording with one more sample between any two: displacement by the cubic that has their velocities, or the two
/// lines of a corner, velocity as a cubic has it. `None` where that is no recording.
pub(super) fn with_halves(recording: &Recording) -> Option<Recording> {
    let (time, x, v) = (recording.time(), recording.displacement(), recording.velocity());
    let jumps = jumps(time, x, v);
    let corner = |i: usize| jumps.binary_search_by_key(&i, |(place, _)| *place).ok().map(|k| jumps[k].1);
    let between = |i: usize| {
        let half = 0.5 * (time[i + 1] - time[i]);
        match corner(i) {
            Some(share) if share < 0.5 => x[i + 1] - half * v[i + 1],
            Some(_) => x[i] + half * v[i],
            None => 0.5 * (x[i] + x[i + 1]) + 0.25 * half * (v[i] - v[i + 1]),
        }
    };
    let condition = |condition: &Condition| match condition {
        Condition::Series(values) => Condition::Series(woven(values, |i| mean(values, i))),
        other => other.clone(),
    };
    let velocity = middles(time, v, &jumps);
    Recording::new(Series {
        time: woven(time, |i| mean(time, i)),
        displacement: woven(x, between),
        velocity: Some(woven(v, |i| velocity[i])),
        force: None,
        simulated: None,
        current: condition(recording.current()),
        temperature: condition(recording.temperature()),
        name: recording.name().into(),
    })
    .ok()
    .map(|halves| halves.with_past(recording.past()).with_state_changed(recording.state_change()))
}

fn mean(values: &[f64], i: usize) -> f64 {
    0.5 * (values[i] + values[i + 1])
}

/// Values with one more between any two.
fn woven(values: &[f64], between: impl Fn(usize) -> f64) -> Vec<f64> {
    let all = values.iter().enumerate();
    all.flat_map(|(i, value)| {
        let next = (i + 1 < values.len()).then(|| between(i));
        std::iter::once(*value).chain(next)
    })
    .collect()
}

/// The values at the samples.
pub(super) fn at_samples(values: &[f64]) -> Vec<f64> {
    values.iter().step_by(2).copied().collect()
}
