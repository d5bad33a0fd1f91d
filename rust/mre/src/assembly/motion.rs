//! What a diagnosis makes of a recorded motion, and in what that is not to be trusted.

use std::ops::Range;
use std::sync::Arc;

use crate::recording::Recording;
use crate::velocity;

/// A derived velocity has about twice the noise and more within one part in so many of half a window from an end of its
/// recording: an effect that changes with time would seem to explain that.
const END: usize = 4;

/// In what a motion whose velocity is derived is not to be trusted.
#[derive(Debug, Clone, Default)]
pub(crate) struct Doubts {
    /// Samples near a corner or an end, in rising order: the velocity is wrong or noisy there, and no fit counts them.
    pub(crate) left_out: Vec<Range<usize>>,
    /// Parts of the displacement, mm, and of the velocity, mm/s, that are noise or may hold some. The force does not
    /// follow it, and an effect that attenuates what is fast would seem to explain that.
    pub(crate) noisy: Vec<[Vec<f64>; 2]>,
    /// True where the motion has corners: its velocity errs more near them than elsewhere, beyond what is left out.
    pub(crate) cornered: bool,
}

/// A recording whose displacement is the one that its velocity is the slope of, without the noise of the two.
///
/// Otherwise that noise, which the force does not follow, could be told from the two, and every effect with
/// memory would seem to explain it.
pub(super) fn of_one_motion(recording: &Recording) -> (Arc<Recording>, Doubts) {
    let (time, x, v) = (recording.time(), recording.displacement(), recording.velocity());
    let (displacement, velocity, doubts) = if recording.velocity_window().is_some() {
        let derived = velocity::from_displacement(time, x);
        if derived.corners.is_empty() {
            let velocity::Calmed { displacement, velocity, noisy } = velocity::calmed(time, x, &derived);
            let left_out = ends(time.len(), derived.half);
            (displacement, velocity, Doubts { left_out, noisy, cornered: false })
        } else {
            // Across a corner a longer window takes off motion.
            let velocity::Derived { displacement, velocity, corners, .. } = derived;
            (displacement, velocity, Doubts { left_out: corners, noisy: Vec::new(), cornered: true })
        }
    } else {
        let v = velocity::smoothed(time, v);
        (velocity::without_noise(time, x, &v), v, Doubts::default())
    };
    (Arc::new(recording.seen_with(displacement, velocity, None)), doubts)
}

/// Samples at the ends of so many whose velocity is derived over this half window.
fn ends(samples: usize, half: usize) -> Vec<Range<usize>> {
    let count = half.div_ceil(END);
    vec![0..count, samples - count..samples]
}
