//! An identified device: a model with its parameters at one or more levels of the coil current, or of what else they run
//! over.
//!
//! Between two levels the force is interpolated linearly in the current, sample by sample; outside
//! them the nearest level holds. So a law affine in the current is two levels, and a campaign at
//! several constant currents is one level each.

use crate::error::{Error, Result};
use crate::extent::Extent;
use crate::model::Model;
use crate::over::Over;
use crate::physics::Part;
use crate::recording::Recording;

/// Parameters at one current.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// Current in A, or what else the levels run over; `None` where it is not known, for a device with one level.
    pub current: Option<f64>,
    /// Values in the order of [`Model::parameters`].
    pub values: Vec<f64>,
}

/// A model with levels, sorted by current.
#[derive(Debug)]
pub struct Device {
    model: Model,
    levels: Vec<Level>,
    over: Over,
}

impl Device {
    /// Its model.
    pub(crate) fn model(&self) -> &Model {
        &self.model
    }

    /// The same device once more.
    pub(crate) fn again(&self) -> Result<Self> {
        Ok(Self::new(Model::named(self.model.name())?, self.levels.clone())?.running_over(self.over))
    }

    /// Check and sort the levels.
    ///
    /// # Errors
    /// No level, a wrong number of values, a value that is not finite or not admissible, two levels
    /// at one current, or several levels of which one has no current.
    pub fn new(model: Model, mut levels: Vec<Level>) -> Result<Self> {
        if levels.is_empty() {
            return Err(Error::setting("levels", 0, "at least one level of parameters"));
        }
        if levels.len() > 1 && levels.iter().any(|level| level.current.is_none_or(|i| !i.is_finite())) {
            return Err(Error::setting(
                "current of a level",
                "missing",
                "a number for each of several levels",
            ));
        }
        let parameters = model.parameters(&Extent::UNIT);
        for level in &levels {
            if level.values.len() != parameters.len() {
                return Err(Error::setting(
                    format!("number of parameters of {}", model.name()),
                    level.values.len(),
                    format!("{} values", parameters.len()),
                ));
            }
            for (p, value) in parameters.iter().zip(&level.values) {
                if !value.is_finite() || *value < p.smallest || *value > p.largest {
                    let wanted = format!("a finite number from {} to {}", p.smallest, p.largest);
                    return Err(Error::setting(p.name.as_str(), value, wanted));
                }
            }
        }
        levels.sort_by(|a, b| a.current.unwrap_or(0.0).total_cmp(&b.current.unwrap_or(0.0)));
        if let Some(pair) = levels.windows(2).find(|pair| pair[0].current == pair[1].current) {
            let current = pair[0].current.unwrap_or(0.0);
            return Err(Error::setting(
                "current of a level",
                format!("{current} A twice"),
                "one level a current",
            ));
        }
        Ok(Self { model, levels, over: Over::Current })
    }

    /// The same where its levels are of something else.
    #[must_use]
    pub fn running_over(self, over: Over) -> Self {
        Self { over, ..self }
    }

    /// Restoring force in N at every sample of a recording, whose own force is not looked at.
    ///
    /// # Errors
    /// Several levels and a recording without current, or samples too far apart for the parameters.
    pub fn simulate(&self, recording: &Recording) -> Result<Vec<f64>> {
        let n = recording.len();
        let (mut force, mut column) = (vec![0.0; n], vec![0.0; n]);
        if let [level] = self.levels.as_slice() {
            self.model.add_force(recording, &level.values, None, &mut column, &mut force);
        } else {
            let current = self.over.of(recording)?;
            for (k, level) in self.levels.iter().enumerate() {
                let weight: Vec<f64> = current.iter().map(|i| self.weight(k, *i)).collect();
                if weight.iter().any(|w| *w != 0.0) {
                    self.model.add_force(recording, &level.values, Some(&weight), &mut column, &mut force);
                }
            }
        }
        computed(&self.model, recording, 0, &force)?;
        Ok(force)
    }

    /// The force in N term by term, with what each term does with energy.
    ///
    /// # Errors
    /// As [`Device::simulate`], but for the force itself, which is not checked.
    pub(crate) fn parts(&self, recording: &Recording) -> Result<Vec<(Part, Vec<f64>)>> {
        let current =
            if self.levels.len() > 1 { self.over.of(recording)? } else { vec![0.0; recording.len()] };
        let mut found = Vec::new();
        let mut column = vec![0.0; recording.len()];
        for (k, level) in self.levels.iter().enumerate() {
            let weight: Vec<f64> = current.iter().map(|i| self.weight(k, *i)).collect();
            let mut next = 0;
            for term in self.model.terms() {
                let shape = next + 1..next + 1 + term.shape(&Extent::UNIT).len();
                term.column(recording, &level.values[shape.clone()], &mut column);
                let c = level.values[next];
                found.push((term.part(), column.iter().zip(&weight).map(|(v, w)| c * v * w).collect()));
                next = shape.end;
            }
        }
        Ok(found)
    }

    /// Share of level `k` in the force at a current.
    fn weight(&self, k: usize, current: f64) -> f64 {
        let at = |k: usize| self.levels[k].current.unwrap_or(0.0);
        let last = self.levels.len() - 1;
        let current = current.clamp(at(0), at(last));
        if k > 0 && current < at(k) {
            ((current - at(k - 1)) / (at(k) - at(k - 1))).max(0.0)
        } else if k < last && current > at(k) {
            ((at(k + 1) - current) / (at(k + 1) - at(k))).max(0.0)
        } else {
            1.0
        }
    }
}

/// Refuse a force, given from sample `start` on, that is not finite.
pub(crate) fn computed(model: &Model, recording: &Recording, start: usize, force: &[f64]) -> Result<()> {
    let Some(first) = force.iter().position(|f| !f.is_finite()) else { return Ok(()) };
    // A term that cannot be computed is infinite from the start; one that overflows has a place.
    let place = if first == 0 { String::new() } else { format!(" at {} s", recording.time()[start + first]) };
    let text = format!(
        "the force of {} cannot be computed{place}: the samples are too far apart, or the displacement \
         too large, for these parameters",
        model.name()
    );
    Err(Error::Recording(text).in_recording(recording.name()))
}
