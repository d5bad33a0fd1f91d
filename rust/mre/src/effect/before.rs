//! What was before a recording that starts in steady motion: the same motion, for as long as any memory lasts.
//!
//! Without it a springpot that is cut from a steady test starts from rest: what is missing then fades as slowly as its
//! memory does, and no sum of a few exponentials stands for it. Where a device did start from rest, in the middle of a
//! cycle, what is too much fades within a cycle, and the initial state of the recording takes it.

use std::f64::consts::PI;

use super::Scene;
use super::initial_state::in_motion;
use crate::transient::reversals;

/// The first sample is on a sine of the first full stroke if the amplitude there is the stroke's within this share.
const ON_IT: f64 = 0.15;
/// That stroke starts within this many strokes of the first sample: at the second turn, because the first that is counted
/// is the first sample, or one just after it.
const SOON: f64 = 1.25;

/// A sine that the first sample is on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Before {
    /// Angular frequency, rad/s.
    frequency: f64,
    /// Displacement about which it goes, mm.
    pub(super) middle: f64,
    /// Displacement of the first sample from there, mm.
    displacement: f64,
    /// Velocity there, mm/s.
    velocity: f64,
}

impl Before {
    /// That of a recording that starts in steady motion.
    pub(super) fn of(scene: &Scene) -> Option<Self> {
        let (x, v) = (scene.displacement, scene.velocity);
        if !in_motion(x, v) {
            return None;
        }
        let turns = reversals(x);
        let (&first, &second) = (turns.get(1)?, turns.get(2)?);
        let stroke = scene.time[second] - scene.time[first];
        if scene.time[first] - scene.time[0] > SOON * stroke {
            return None;
        }
        let frequency = PI / stroke;
        let middle = 0.5 * (x[first] + x[second]);
        let amplitude = 0.5 * (x[first] - x[second]).abs();
        let before = Self { frequency, middle, displacement: x[0] - middle, velocity: v[0] };
        let there = before.displacement.hypot(before.velocity / frequency);
        ((there - amplitude).abs() <= ON_IT * amplitude).then_some(before)
    }

    /// `y` of `y' = (v - y) / tau` at the first sample.
    pub(super) fn lagged(self, tau: f64) -> f64 {
        let turned = self.frequency * tau;
        (self.frequency * turned * self.displacement + self.velocity) / (1.0 + turned * turned)
    }
}
