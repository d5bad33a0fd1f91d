//! A softening law of another file that acts on the springs of a hysteretic base model alone: the hysteretic
//! force, of friction between fillers or of yielding parts, is another mechanism and stays as it is.
//!
//! Reference: that of the plain law.
//! Known limit: where the hysteretic force is small it is the plain law.

use super::{About, Effect, Factors, Scene, Sizes};
use crate::parameter::Parameter;

/// A law that scales the stiffness, on the springs alone.
pub(super) struct OnSpring {
    /// The plain law.
    pub(super) law: &'static dyn Effect,
    /// Name among the laws of the effect.
    pub(super) name: &'static str,
}

impl Effect for OnSpring {
    fn about(&self) -> About {
        About { law: self.name, ..self.law.about() }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        self.law.applies(sizes)
    }

    fn on_springs_alone(&self) -> bool {
        true
    }

    fn in_one_recording(&self) -> bool {
        self.law.in_one_recording()
    }

    fn moment(&self, shape: &[f64]) -> Option<(f64, f64)> {
        self.law.moment(shape)
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        self.law.shape(sizes)
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law.starts(sizes)
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        self.law.factors(scene, shape).map(|factors| Factors { hysteretic: false, ..factors })
    }
}
