//! Problems that are another one with a single thing changed.

use std::sync::Arc;

use super::{Kernel, Problem};
use crate::error::Result;
use crate::model::Model;
use crate::parameter::{Bounds, Parameter};

impl Problem {
    /// The same problem with one parameter held at a value inside the box.
    pub(crate) fn pinned(&self, place: usize, value: f64) -> Result<Self> {
        let (lower, upper) = (self.bounds.lower()[place], self.bounds.upper()[place]);
        // The narrowest box there is: two neighbouring numbers.
        let low = if value < upper { value.max(lower) } else { upper.next_down() };
        let mut parameters = self.parameters.clone();
        (parameters[place].lower, parameters[place].upper) = (low, low.next_up());
        let pick = |value: fn(&Parameter) -> f64| parameters.iter().map(value).collect();
        let names: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
        let scale = parameters.iter().map(|p| p.scale).collect();
        Ok(Self {
            recordings: self.recordings.clone(),
            model: Model::named(self.model.name())?,
            law: self.law.clone(),
            bounds: Bounds::new(&names, pick(|p| p.lower), pick(|p| p.upper), scale)?,
            parameters,
            weights: self.weights.clone(),
            kernel: Arc::clone(&self.kernel),
        })
    }

    /// The same problem, box included, with other forces, one series a recording.
    pub(crate) fn with_forces(&self, forces: Vec<Vec<f64>>) -> Result<Self> {
        let pairs = self.recordings.iter().zip(forces);
        let recordings: Vec<_> = pairs.map(|(r, force)| Arc::new(r.with_force(force))).collect();
        let model = Model::named(self.model.name())?;
        let kernel = Arc::new(Kernel::new(&recordings, &model, &self.law, &self.bounds, &self.weights));
        Ok(Self {
            recordings,
            model,
            law: self.law.clone(),
            parameters: self.parameters.clone(),
            bounds: self.bounds.clone(),
            weights: self.weights.clone(),
            kernel,
        })
    }
}
