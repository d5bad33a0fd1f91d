//! What a specimen has been through before a recording.

use std::ops::RangeInclusive;

use super::Recording;
use crate::error::{Error, Result};
use crate::velocity;

/// Motion and work of a specimen so far, all zero at first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Past {
    /// Duration of its recordings, s.
    pub time: f64,
    /// Largest absolute displacement, mm.
    pub displacement: f64,
    /// Path travelled, mm.
    pub path: f64,
    /// Integral of `|x v|`, mm^2.
    pub strokes: f64,
    /// Energy that passed through it, the integral of `|F v|` with the measured force, N mm.
    pub energy: f64,
    /// Energy that stayed in it, the integral of `F v`, N mm.
    pub stayed: f64,
    /// The most of that so far, N mm.
    pub dissipated: f64,
    /// Integral of `v^2`, mm^2/s.
    pub heat: f64,
}

impl Past {
    /// With some samples of a recording after it.
    fn and(self, recording: &Recording, samples: RangeInclusive<usize>) -> Result<Self> {
        let Some(force) = recording.force() else {
            let text = "no force: what it does to the specimen is not known".into();
            return Err(Error::Recording(text).in_recording(recording.name()));
        };
        let (time, x) = (recording.time(), recording.displacement());
        // Noise of a velocity at rest would be a path.
        let v = velocity::smoothed(time, x, recording.velocity()).velocity;
        let mut past = self;
        let (first, last) = samples.into_inner();
        past.displacement = past.displacement.max(x[first].abs());
        past.time += time[last] - time[first];
        for i in first + 1..=last {
            let half = 0.5 * (time[i] - time[i - 1]);
            let step = |rate: &dyn Fn(usize) -> f64| half * (rate(i - 1) + rate(i));
            past.displacement = past.displacement.max(x[i].abs());
            past.path += step(&|i| v[i].abs());
            past.strokes += step(&|i| (x[i] * v[i]).abs());
            past.energy += step(&|i| (force[i] * v[i]).abs());
            past.stayed += step(&|i| force[i] * v[i]);
            past.dissipated = past.dissipated.max(past.stayed);
            past.heat += step(&|i| v[i] * v[i]);
        }
        Ok(past)
    }
}

impl Recording {
    /// What the specimen has been through before, where that is known; `None`: nothing, it is rested and virgin.
    pub fn past(&self) -> Option<Past> {
        self.past
    }

    /// The same of a specimen that has been through others, the first of them first, and before them what that one had.
    ///
    /// # Errors
    /// One of them without force.
    pub fn after<'r>(&self, earlier: impl IntoIterator<Item = &'r Self>) -> Result<Self> {
        let mut earlier = earlier.into_iter().peekable();
        let first = earlier.peek().and_then(|first| first.past).unwrap_or_default();
        let past = earlier.try_fold(first, |past, recording| past.and(recording, 0..=recording.len() - 1))?;
        Ok(self.with_past(Some(past)))
    }

    /// The past of what is left from a sample on: of a specimen with a past, what is cut off belongs to it.
    pub(super) fn past_at(&self, sample: usize) -> Result<Option<Past>> {
        self.past.map(|past| if sample == 0 { Ok(past) } else { past.and(self, 0..=sample) }).transpose()
    }

    /// The same of a specimen with a past.
    #[must_use]
    pub fn with_past(&self, past: Option<Past>) -> Self {
        Self { past, ..self.clone() }
    }
}
