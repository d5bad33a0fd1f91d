//! What a diagnosis makes of a recorded motion, and in what that is not to be trusted.

use std::ops::Range;
use std::sync::Arc;

use rand_chacha::ChaCha8Rng;

use crate::recording::{Condition, Recording};
use crate::velocity::{self, Calm, Derived, Left, Parts, Smoothed, Stepped, Together};

/// A derived velocity differs from the recorded one by as much as that has noise, up to this factor.
const ALIKE: f64 = 1.2;

/// In what a motion is not to be trusted.
#[derive(Debug, Clone, Default)]
pub(crate) struct Doubts {
    /// Samples near a corner, a bend or an end, where the velocity is wrong or noisy, and at turns, where its sign is not known, in
    /// rising order: no fit counts them.
    pub(crate) left_out: Vec<Range<usize>>,
    /// Parts of the displacement, mm, and of the velocity, mm/s, that are noise or may hold some. The force does not
    /// follow it, and an effect that attenuates what is fast would seem to explain that.
    pub(crate) noisy: Vec<[Vec<f64>; 2]>,
    /// True where the motion has corners: its velocity errs more near them than elsewhere, beyond what is left out.
    pub(crate) cornered: bool,
    /// How noise was taken off the motion, of which some is left; `None` where there was none.
    pub(crate) left: Option<Left>,
    /// The same of a measured current.
    pub(crate) left_of_current: Option<Stepped>,
}

impl Doubts {
    /// True where noise of a motion or a current is left.
    pub(crate) fn noise_is_left(&self) -> bool {
        self.left.is_some() || self.left_of_current.is_some()
    }
}

/// Displacement, mm, velocity, mm/s, and in what they are not to be trusted.
type Motion = (Vec<f64>, Vec<f64>, Doubts);

/// A recording whose displacement is the one that its velocity is the slope of, without the noise of the two.
///
/// Otherwise that noise, which the force does not follow, could be told from the two, and every effect with
/// memory would seem to explain it.
pub(super) fn of_one_motion(recording: &Recording) -> (Arc<Recording>, Doubts) {
    let (time, x, v) = (recording.time(), recording.displacement(), recording.velocity());
    let (displacement, velocity, mut doubts) = if recording.velocity_window().is_some() {
        of_derived(time, x, velocity::from_displacement(time, x))
    } else {
        let recorded = velocity::smoothed(time, x, v);
        better_derived([time, x, v], &recorded).unwrap_or_else(|| {
            let (together, [displacement, velocity]) = Together::of(time, x, &recorded);
            let left = some(Left::recorded(recorded, together));
            (displacement, velocity, Doubts { left, ..Doubts::default() })
        })
    };
    doubts.left_out.extend(velocity::turns(&velocity));
    doubts.left_out = velocity::joined(doubts.left_out);
    (Arc::new(recording.seen_with(displacement, velocity, None)), doubts)
}

/// Noise, if there is any.
fn some(left: Left) -> Option<Left> {
    (!left.is_none()).then_some(left)
}

/// A motion whose velocity is derived.
fn of_derived(time: &[f64], x: &[f64], derived: Derived) -> Motion {
    if derived.corners.is_empty() {
        let calming = derived.calming(time, x);
        let Calm { mut displacement, velocity, noisy } = calming.over(time, x);
        let lost = velocity::give_back(&mut displacement, x);
        let ends = ends(time.len(), derived.half);
        let left_out = ends.into_iter().chain(derived.unresolved(time, x)).chain(lost).collect();
        let left = some(Left::Derived(calming));
        return (displacement, velocity, Doubts { left_out, noisy, left, ..Doubts::default() });
    }
    // Across a corner or a bend a longer window takes off motion.
    let parts = Parts::of(time, x, &derived);
    let Calm { mut displacement, velocity, noisy } = parts.calm(time, x, &derived);
    let lost = velocity::give_back(&mut displacement, x);
    let left_out = derived.corners.into_iter().chain(lost).collect();
    let left = some(Left::Between(parts));
    let cornered = derived.sharp;
    (displacement, velocity, Doubts { left_out, noisy, cornered, left, ..Doubts::default() })
}

/// A motion whose velocity has less noise than the recorded one where it is derived from the displacement.
fn better_derived([time, x, v]: [&[f64]; 3], recorded: &Smoothed) -> Option<Motion> {
    if recorded.noise <= 0.0 || !recorded.jumps.is_empty() {
        return None;
    }
    let derived = velocity::from_displacement(time, x);
    if derived.sharp {
        return None;
    }
    let noise = derived.smoothing.noise(&derived.displacement, x).0;
    // Otherwise the window, or the displacement, misses some of the motion.
    let squares: f64 = derived.velocity.iter().zip(v).map(|(a, b)| (a - b).powi(2)).sum();
    let alike = squares < (ALIKE * recorded.noise).powi(2) * time.len() as f64;
    let calmer = derived.noise(time, noise) < recorded.left;
    (alike && calmer).then(|| of_derived(time, x, derived))
}

/// A motion and a current with what is left of as much noise as they had, drawn anew; `None` where none is known.
pub(super) fn shaken(
    recording: &Recording,
    doubts: &Doubts,
    stream: &mut ChaCha8Rng,
) -> Option<(Arc<Recording>, Doubts)> {
    if !doubts.noise_is_left() {
        return None;
    }
    let motion = [recording.time(), recording.displacement(), recording.velocity()];
    let more = |own: &[f64], left: &[f64]| own.iter().zip(left).map(|(own, left)| own + left).collect();
    let [mut displacement, mut velocity] = [motion[1].to_vec(), motion[2].to_vec()];
    let mut noisy = doubts.noisy.clone();
    if let Some(left) = &doubts.left {
        let left = left.drawn(motion, stream);
        displacement = more(motion[1], &left.displacement);
        velocity = more(motion[2], &left.velocity);
        let parts = doubts.noisy.iter().zip(&left.noisy);
        noisy = parts.map(|(own, left)| [0, 1].map(|k| more(&own[k], &left[k]))).collect();
    }
    let current = match (&doubts.left_of_current, recording.current()) {
        (Some(left), Condition::Series(own)) => Some(more(own, &left.drawn(motion[0], stream))),
        _ => None,
    };
    Some((Arc::new(recording.seen_with(displacement, velocity, current)), Doubts { noisy, ..doubts.clone() }))
}

/// Samples at the ends of so many whose velocity is derived over this half window.
fn ends(samples: usize, half: usize) -> Vec<Range<usize>> {
    let count = half.div_ceil(velocity::END);
    vec![0..count, samples - count..samples]
}
