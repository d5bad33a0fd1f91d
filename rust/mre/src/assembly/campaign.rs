//! The recordings of a diagnosis, with what effects need of them.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use crate::effect::{Acceleration, Scene, Sizes};
use crate::error::{Error, Result};
use crate::recording::{Condition, Recording};
use crate::velocity;

/// Recordings with sizes, and what is derived of them.
#[derive(Debug, Clone)]
pub struct Campaign {
    recordings: Vec<Arc<Recording>>,
    accelerations: Vec<OnceLock<Vec<f64>>>,
    currents: Vec<Option<Vec<f64>>>,
    corners: Vec<Vec<Range<usize>>>,
    before: Vec<f64>,
    sizes: Sizes,
}

impl Campaign {
    /// Recordings with force, evenly sampled.
    ///
    /// # Errors
    /// No recording, one without force, or one whose samples are not evenly spaced.
    pub fn new(recordings: Vec<Arc<Recording>>) -> Result<Self> {
        if recordings.is_empty() {
            return Err(Error::setting("recordings", "an empty list", "at least one recording"));
        }
        for recording in &recordings {
            if recording.force().is_none() {
                let text = "no force: a diagnosis needs one";
                return Err(Error::Recording(text.into()).in_recording(recording.name()));
            }
            evenly_sampled(recording)?;
        }
        let (recordings, corners): (Vec<Arc<Recording>>, _) =
            recordings.into_par_iter().map(|r| of_one_motion(&r)).unzip();
        let sizes = Sizes::of(recordings.iter().map(AsRef::as_ref));
        Ok(Self::with_sizes(recordings, sizes).leaving_out(corners))
    }

    /// The same for a simulation, with the sizes of the recordings that the effects were fitted to.
    pub(crate) fn with_sizes(recordings: Vec<Arc<Recording>>, sizes: Sizes) -> Self {
        let accelerations = vec![OnceLock::new(); recordings.len()];
        let currents = recordings.iter().map(|r| current(r)).collect();
        let mut total = 0.0;
        let before = recordings
            .iter()
            .map(|r| {
                let start = total;
                total += r.time()[r.len() - 1] - r.time()[0];
                start
            })
            .collect();
        let corners = vec![Vec::new(); recordings.len()];
        Self { recordings, accelerations, currents, corners, before, sizes }
    }

    /// The same with other corners, by recording.
    #[must_use]
    pub(crate) fn leaving_out(self, corners: Vec<Vec<Range<usize>>>) -> Self {
        Self { corners, ..self }
    }

    /// Samples near a corner of a motion whose velocity is derived: it is wrong there, and no fit counts them.
    pub fn corners(&self) -> &[Vec<Range<usize>>] {
        &self.corners
    }

    /// The same with other sizes.
    #[must_use]
    pub fn sized(self, sizes: Sizes) -> Self {
        Self { sizes, ..self }
    }

    /// The recordings.
    pub fn recordings(&self) -> &[Arc<Recording>] {
        &self.recordings
    }

    /// Sizes over all recordings.
    pub fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// What effects see of a recording, given the force of the base model alone and of the whole device.
    pub fn scene<'a>(&'a self, r: usize, force: &'a [f64], whole: &'a [f64]) -> Scene<'a> {
        let recording = &self.recordings[r];
        Scene {
            time: recording.time(),
            displacement: recording.displacement(),
            velocity: recording.velocity(),
            acceleration: Acceleration { recording, known: &self.accelerations[r] },
            current: self.currents[r].as_deref(),
            force,
            whole,
            before: self.before[r],
            sizes: &self.sizes,
        }
    }
}

/// A recording whose displacement is the one that its velocity is the slope of, without the noise of the two; and
/// the corners where that velocity is wrong.
///
/// Otherwise that noise, which the force does not follow, could be told from the two, and every effect with
/// memory would seem to explain it.
fn of_one_motion(recording: &Recording) -> (Arc<Recording>, Vec<Range<usize>>) {
    let (time, x, v) = (recording.time(), recording.displacement(), recording.velocity());
    let (displacement, velocity, corners) = if recording.velocity_window().is_some() {
        let derived = velocity::from_displacement(time, x);
        (derived.displacement, v.to_vec(), derived.corners)
    } else {
        let v = velocity::smoothed(time, v);
        (velocity::without_noise(time, x, &v), v, Vec::new())
    };
    (Arc::new(recording.seen_with(displacement, velocity, None)), corners)
}

fn current(recording: &Recording) -> Option<Vec<f64>> {
    match recording.current() {
        Condition::Missing => None,
        Condition::Constant(i) => Some(vec![*i; recording.len()]),
        Condition::Series(i) => Some(i.clone()),
    }
}

fn evenly_sampled(recording: &Recording) -> Result<()> {
    let Err(i) = recording.even_step() else { return Ok(()) };
    let time = recording.time();
    let step = (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64;
    let text = format!(
        "time is {} s at sample {i}, on an even grid of {step:.6} s it would be {:.6} s: a diagnosis needs evenly \
         spaced samples; resample, or cut the recording at its gap",
        time[i],
        time[0] + step * i as f64
    );
    Err(Error::Recording(text).in_recording(recording.name()))
}
