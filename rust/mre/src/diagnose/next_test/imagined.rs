//! A test as it is imagined: each model that may be true moves finely, and is seen at the samples of a recording.

use super::excitation::{Kind, Signal};
use super::limits::Limits;
use super::truth::Truth;
use super::world::World;
use crate::assembly::{Base, Campaign};
use crate::diagnose::candidates::Candidate;

/// Samples of the fastest cycle of a device that moves on between the samples of a recording.
const FINE: f64 = 100.0;
/// Most such samples for each of the recording.
const FINEST: f64 = 8.0;

/// A test, and what those that may be true would show.
pub(super) struct Imagined {
    signal: Signal,
    /// As it would be recorded; `None` where it is derived.
    velocity: Option<Vec<f64>>,
    /// Force in N of each that may be true.
    forces: Vec<Vec<f64>>,
}

impl Imagined {
    /// `known` are the recordings; `None` where the limits leave no room for the test, or a model cannot follow it.
    pub(super) fn new(
        kind: Kind,
        limits: &Limits,
        known: &Campaign,
        base: &Base,
        truths: &[Truth],
    ) -> Option<Self> {
        let times = (FINE * limits.highest / limits.rate).clamp(1.0, FINEST).ceil() as usize;
        let fine = kind.signal(limits, times)?;
        let world = World::new(known, base, &fine, None, None)?;
        let every = |series: &[f64]| series.iter().step_by(times).copied().collect::<Vec<f64>>();
        let truths: Vec<&Candidate> = truths.iter().map(|truth| &truth.candidate).collect();
        let forces = world.simulated(&truths)?.iter().map(|force| every(force)).collect();
        // A velocity that was recorded will be again.
        let derived = known.recordings()[0].velocity_window().is_some();
        let velocity = (!derived).then(|| every(world.test().velocity()));
        let signal = Signal {
            time: every(&fine.time),
            displacement: every(&fine.displacement),
            current: fine.current.as_deref().map(every),
            ..fine
        };
        Some(Self { signal, velocity, forces })
    }

    pub(super) fn signal(&self) -> &Signal {
        &self.signal
    }

    pub(super) fn velocity(&self) -> Option<&[f64]> {
        self.velocity.as_deref()
    }

    /// Force in N of one of those that may be true.
    pub(super) fn force(&self, truth: usize) -> &[f64] {
        &self.forces[truth]
    }
}
