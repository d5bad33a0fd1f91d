//! The recordings of a diagnosis, with what effects need of them.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;
use rayon::prelude::*;

use super::halves::with_halves;
use super::metered::without_noise_of_the_meter;
use super::motion::{Doubts, of_one_motion, shaken};
use crate::effect::{Acceleration, Scene, Sizes};
use crate::error::{Error, Result};
use crate::recording::Recording;
use crate::velocity::Left;

/// Times that the noise of motions is drawn anew.
const SHAKEN: u64 = 16;

/// Recordings with sizes, and what is derived of them.
#[derive(Debug, Clone)]
pub struct Campaign {
    recordings: Vec<Arc<Recording>>,
    accelerations: Vec<OnceLock<Vec<f64>>>,
    currents: Vec<Option<Vec<f64>>>,
    temperatures: Vec<Option<Vec<f64>>>,
    halves: Vec<OnceLock<Option<Recording>>>,
    doubts: Vec<Doubts>,
    shaken: OnceLock<Vec<Campaign>>,
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
        let seen = recordings.into_par_iter().map(|r| of_one_motion(&r)).collect();
        let (recordings, doubts): (Vec<Arc<Recording>>, Vec<Doubts>) =
            without_noise_of_the_meter(seen).into_iter().unzip();
        let noise = doubts.iter().filter_map(|doubts| doubts.left.as_ref().map(Left::of_displacement));
        let noise = noise.fold(0.0, f64::max);
        let sizes = Sizes { noise, ..Sizes::of(recordings.iter().map(AsRef::as_ref)) };
        Ok(Self::with_sizes(recordings, sizes).doubting(doubts))
    }

    /// The same for a simulation, with the sizes of the recordings that the effects were fitted to.
    pub(crate) fn with_sizes(recordings: Vec<Arc<Recording>>, sizes: Sizes) -> Self {
        let accelerations = vec![OnceLock::new(); recordings.len()];
        let halves = vec![OnceLock::new(); recordings.len()];
        let currents = recordings.iter().map(|r| r.current().sampled(r.len())).collect();
        let temperatures = recordings.iter().map(|r| r.temperature().sampled(r.len())).collect();
        let mut total = 0.0;
        let before = recordings
            .iter()
            .map(|r| {
                let start = total;
                total += r.time()[r.len() - 1] - r.time()[0];
                start
            })
            .collect();
        let doubts = vec![Doubts::default(); recordings.len()];
        let shaken = OnceLock::new();
        Self { recordings, accelerations, currents, temperatures, halves, doubts, shaken, before, sizes }
    }

    /// The same with doubts about the motions, by recording.
    #[must_use]
    pub(crate) fn doubting(self, doubts: Vec<Doubts>) -> Self {
        Self { doubts, ..self }
    }

    /// Samples near a corner, a bend or an end of a motion whose velocity is derived, where it is wrong or noisy, and at
    /// turns of any, where its sign is not known, by recording: no fit counts them.
    pub fn left_out(&self) -> impl Iterator<Item = &[Range<usize>]> {
        self.doubts.iter().map(|doubts| doubts.left_out.as_slice())
    }

    /// In what the motion of each recording is not to be trusted.
    pub(crate) fn doubts(&self) -> &[Doubts] {
        &self.doubts
    }

    /// The same with the noise of the motions drawn anew and added once more, some times; none
    /// where there is no such noise.
    pub(crate) fn shaken(&self) -> &[Self] {
        self.shaken.get_or_init(|| {
            if !self.doubts.iter().any(Doubts::noise_is_left) {
                return Vec::new();
            }
            (0..SHAKEN).map(|draw| self.shaken_once(draw)).collect()
        })
    }

    fn shaken_once(&self, draw: u64) -> Self {
        let own = |(r, recording): (usize, &Arc<Recording>)| {
            let mut stream = ChaCha8Rng::seed_from_u64(draw);
            stream.set_stream(r as u64);
            let doubts = &self.doubts[r];
            shaken(recording, doubts, &mut stream).unwrap_or_else(|| (recording.clone(), doubts.clone()))
        };
        let (recordings, doubts) = self.recordings.par_iter().enumerate().map(own).unzip();
        Self::with_sizes(recordings, self.sizes.clone()).doubting(doubts)
    }

    /// The same with other sizes; in what steps the force is measured, and whether temperatures are known, stays its own.
    #[must_use]
    pub fn sized(self, sizes: &Sizes) -> Self {
        let Sizes { temperature, quantum, .. } = self.sizes;
        let temperature = temperature.map(|own| sizes.temperature.unwrap_or(own));
        Self { sizes: Sizes { temperature, quantum, ..sizes.clone() }, ..self }
    }

    /// The recordings.
    pub fn recordings(&self) -> &[Arc<Recording>] {
        &self.recordings
    }

    /// A recording with its motion halfway between the samples too; `None` where that is not known well enough.
    pub(super) fn with_halves(&self, r: usize) -> Option<&Recording> {
        let known = &self.halves[r];
        let smooth = !self.doubts[r].cornered;
        known.get_or_init(|| smooth.then(|| with_halves(&self.recordings[r])).flatten()).as_ref()
    }

    /// Sizes over all recordings.
    pub fn sizes(&self) -> &Sizes {
        &self.sizes
    }

    /// Duration of the recordings before one, s.
    pub(crate) fn before(&self, r: usize) -> f64 {
        self.before[r]
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
            temperature: self.temperatures[r].as_deref(),
            force,
            whole,
            fading: &[],
            before: self.before[r],
            past: recording.past().unwrap_or_default(),
            sizes: &self.sizes,
        }
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
