//! What a diagnosis makes of a measured current: the device follows it without the noise of its meter.
//!
//! Otherwise that noise, which the force does not follow, would make every lag of the field, and every filter of the force, seem
//! to explain it.

use std::sync::Arc;

use super::motion::Doubts;
use crate::kernel::filter::{dot, third_differences};
use crate::recording::Recording;
use crate::spread::deviation;
use crate::velocity::Stepped;

/// Noise above this share of a current, rms, is worth the change.
const WORTH: f64 = 1e-4;

/// Squares of the force, in variances of what is left, that go with what was taken off: beyond it the device follows
/// that. Four columns of noise find 40 once in 20 million times.
const FOLLOWS: f64 = 40.0;
/// Third differences of white noise go together with their neighbours: so much less certain are sums of them.
const TOGETHER: f64 = 2.31;
/// Standard deviations of third differences beyond which they are no noise.
const NOISE: f64 = 6.0;

/// Recordings with their currents less the noise of a meter, and doubts of their motions that know of it.
///
/// A device that follows what is fast in all of them keeps it: a controller may pass on the noise of what it measures.
pub(super) fn without_noise_of_the_meter(
    seen: Vec<(Arc<Recording>, Doubts)>,
) -> Vec<(Arc<Recording>, Doubts)> {
    let calm: Vec<Option<Calm>> = seen.iter().map(|(recording, _)| Calm::of(recording)).collect();
    let products =
        seen.iter().zip(&calm).filter_map(|((recording, _), calm)| Some((recording, &calm.as_ref()?.taken)));
    if follows(products) {
        return seen;
    }
    let with = |((recording, doubts), calm): ((Arc<Recording>, Doubts), Option<Calm>)| match calm {
        None => (recording, doubts),
        Some(Calm { current, left, .. }) => {
            let [displacement, velocity] =
                [recording.displacement(), recording.velocity()].map(<[f64]>::to_vec);
            let seen = recording.seen_with(displacement, velocity, Some(current));
            (Arc::new(seen), Doubts { left_of_current: Some(left), ..doubts })
        }
    };
    seen.into_iter().zip(calm).map(with).collect()
}

/// A current without its noise.
struct Calm {
    /// A.
    current: Vec<f64>,
    /// What was taken off, A.
    taken: Vec<f64>,
    /// How.
    left: Stepped,
}

impl Calm {
    /// None where the current does not change within a recording, or has no noise.
    fn of(recording: &Recording) -> Option<Self> {
        let measured = recording.current().changing()?;
        let (left, current) = Stepped::of(recording.time(), measured)?;
        let taken: Vec<f64> = measured.iter().zip(&current).map(|(all, own)| all - own).collect();
        let worth = dot(&taken, &taken) > WORTH.powi(2) * dot(measured, measured);
        worth.then_some(Self { current, taken, left })
    }
}

/// True where forces follow what was taken off their currents, in A: in proportion to it, to the motion and its sign.
///
/// In third differences little is left of a force but its noise.
fn follows<'r>(taken: impl Iterator<Item = (&'r Arc<Recording>, &'r Vec<f64>)>) -> bool {
    let (mut gram, mut right) = (nalgebra::Matrix4::<f64>::zeros(), nalgebra::Vector4::<f64>::zeros());
    let (mut squares, mut count) = (0.0, 0);
    for (recording, taken) in taken {
        let [x, v] = [recording.displacement(), recording.velocity()];
        let force = third_differences(recording.force().unwrap_or_default());
        let most = NOISE * deviation(&force);
        // Where the force steps, its differences are no noise.
        let quiet = |differences: Vec<f64>| -> Vec<f64> {
            let own = differences.iter().zip(&force);
            own.map(|(value, force)| if force.abs() < most { *value } else { 0.0 }).collect()
        };
        let times = |of: &dyn Fn(usize) -> f64| {
            let product: Vec<f64> = taken.iter().enumerate().map(|(i, taken)| taken * of(i)).collect();
            quiet(third_differences(&product))
        };
        let columns = [times(&|_| 1.0), times(&|i| x[i]), times(&|i| v[i]), times(&|i| v[i].signum())];
        let force = quiet(force.clone());
        for (i, column) in columns.iter().enumerate() {
            right[i] += dot(column, &force);
            for (j, other) in columns.iter().enumerate() {
                gram[(i, j)] += dot(column, other);
            }
        }
        squares += dot(&force, &force);
        count += force.len();
    }
    let scale = gram.diagonal().map(|square| if square > 0.0 { 1.0 / square.sqrt() } else { 0.0 });
    let scaled = nalgebra::Matrix4::from_fn(|i, j| {
        let unit = if i == j { 1e-9 + f64::from(u8::from(scale[i] == 0.0)) } else { 0.0 };
        gram[(i, j)] * scale[i] * scale[j] + unit
    });
    let right = right.component_mul(&scale);
    let Some(factor) = scaled.cholesky() else { return false };
    let gain = right.dot(&factor.solve(&right));
    gain * count as f64 > FOLLOWS * TOGETHER * (squares - gain)
}
