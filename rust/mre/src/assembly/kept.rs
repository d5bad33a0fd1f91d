//! A device that is kept as it is, with its effects, as the base of an assembly.

use std::sync::Arc;

use super::simulate::{Addition, Source, simulate};
use crate::device::Device;
use crate::effect::Sizes;
use crate::error::Result;
use crate::model::Model;
use crate::physics::Part;
use crate::recording::Recording;

/// A device and its effects, all parameters of which are known.
#[derive(Debug)]
pub struct Kept {
    device: Device,
    effects: Option<(Vec<Addition>, Box<Sizes>)>,
}

impl Kept {
    /// A device without effects.
    pub fn new(device: Device) -> Self {
        Self { device, effects: None }
    }

    /// A device with effects; `sizes` are those of the recordings that they were fitted to.
    pub fn with_effects(device: Device, effects: Vec<Addition>, sizes: Sizes) -> Self {
        Self { device, effects: Some((effects, Box::new(sizes))) }
    }

    /// The model of the device.
    pub(super) fn model(&self) -> &Model {
        self.device.model()
    }

    /// True where effects are kept with the device.
    pub(super) fn has_effects(&self) -> bool {
        self.effects.is_some()
    }

    /// The same once more.
    pub(crate) fn again(&self) -> Result<Self> {
        Ok(Self { device: self.device.again()?, effects: self.effects.clone() })
    }

    /// Forces in N by what they do with energy. What the effects add is a part that further effects do not
    /// scale: all effects of a model refer to the device alone.
    pub(super) fn parts(&self, recording: &Recording) -> Result<Vec<(Part, Vec<f64>)>> {
        let mut parts = self.device.parts(recording)?;
        if let Some((effects, sizes)) = &self.effects {
            let mut added =
                simulate(Source::Device(&self.device), effects, sizes, &Arc::new(recording.clone()))?;
            for (_, part) in &parts {
                added.iter_mut().zip(part).for_each(|(sum, value)| *sum -= value);
            }
            parts.push((Part::Offset, added));
        }
        Ok(parts)
    }

    /// Force in N of the device without its effects.
    pub(super) fn alone(&self, recording: &Recording) -> Vec<f64> {
        self.device.simulate(recording).unwrap_or_else(|_| vec![0.0; recording.len()])
    }
}
