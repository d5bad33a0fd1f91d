//! Parameters of a model that was given, or a simulation, which are off.
//!
//! No effects of the catalogue: what a stiffness, a damping, a scale or a zero that is not the device's leaves, to first order.

use super::{About, Effect, Scene, Sizes, signed};
use crate::parameter::Parameter;

/// What is off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterOff {
    /// A stiffness.
    Stiffness,
    /// A damping.
    Damping,
    /// The scale of the force.
    Scale,
    /// Its zero.
    Zero,
}

impl ParameterOff {
    /// Each of them.
    pub const ALL: [Self; 4] = [Self::Stiffness, Self::Damping, Self::Scale, Self::Zero];

    /// As an effect beside a base.
    pub fn as_effect(&self) -> &'static dyn Effect {
        match self {
            Self::Stiffness => &Self::Stiffness,
            Self::Damping => &Self::Damping,
            Self::Scale => &Self::Scale,
            Self::Zero => &Self::Zero,
        }
    }
}

impl Effect for ParameterOff {
    fn about(&self) -> About {
        let off = |law, equation| About {
            effect: "parameter_off",
            law,
            plain: "parameters are off",
            equation,
            reference: "general",
            limit: "of a base that is fitted, its own parameters",
        };
        match self {
            Self::Stiffness => off("stiffness", "F += k x"),
            Self::Damping => off("damping", "F += c v"),
            Self::Scale => off("scale", "F += s F"),
            Self::Zero => off("zero", "F += F_0"),
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        let unit = match self {
            Self::Stiffness => "N/mm",
            Self::Damping => "N s/mm",
            Self::Scale => "",
            Self::Zero => "N",
        };
        vec![signed(self.about().law, unit)]
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        vec![match self {
            Self::Stiffness => scene.displacement.to_vec(),
            Self::Damping => scene.velocity.to_vec(),
            Self::Scale => scene.force.to_vec(),
            Self::Zero => vec![1.0; scene.len()],
        }]
    }
}
