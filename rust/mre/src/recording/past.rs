//! What a specimen has been through before a recording.

use super::Recording;
use crate::error::{Error, Result};

/// Motion and work of earlier recordings of one specimen, all zero for its first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Past {
    /// Largest absolute displacement, mm.
    pub displacement: f64,
    /// Path travelled, mm.
    pub path: f64,
    /// Integral of `|x v|`, mm^2.
    pub strokes: f64,
    /// Energy that passed through it, the integral of `|F v|`, N mm.
    pub energy: f64,
    /// Energy that stayed in it, the integral of `F v`, N mm.
    pub dissipated: f64,
    /// Integral of `v^2`, mm^2/s.
    pub heat: f64,
}

impl Past {
    /// With a recording after it.
    fn and(self, recording: &Recording) -> Result<Self> {
        let Some(force) = recording.force() else {
            let text = "no force: what it does to the specimen is not known".into();
            return Err(Error::Recording(text).in_recording(recording.name()));
        };
        let (time, x, v) = (recording.time(), recording.displacement(), recording.velocity());
        let integral = |rate: &dyn Fn(usize) -> f64| {
            (1..time.len()).map(|i| 0.5 * (time[i] - time[i - 1]) * (rate(i - 1) + rate(i))).sum::<f64>()
        };
        Ok(Self {
            displacement: x.iter().fold(self.displacement, |far, x| far.max(x.abs())),
            path: self.path + integral(&|i| v[i].abs()),
            strokes: self.strokes + integral(&|i| (x[i] * v[i]).abs()),
            energy: self.energy + integral(&|i| (force[i] * v[i]).abs()),
            dissipated: self.dissipated + integral(&|i| force[i] * v[i]).max(0.0),
            heat: self.heat + integral(&|i| v[i] * v[i]),
        })
    }
}

impl Recording {
    /// What the specimen has been through before, where that is known; `None`: nothing, it is rested and virgin.
    pub fn past(&self) -> Option<Past> {
        self.past
    }

    /// The same of a specimen that has been through others, the first of them first.
    ///
    /// # Errors
    /// One of them without force.
    pub fn after<'r>(&self, earlier: impl IntoIterator<Item = &'r Self>) -> Result<Self> {
        let past = earlier.into_iter().try_fold(Past::default(), Past::and)?;
        Ok(self.with_past(Some(past)))
    }

    /// The same of a specimen with a past.
    #[must_use]
    pub fn with_past(&self, past: Option<Past>) -> Self {
        Self { past, ..self.clone() }
    }
}
