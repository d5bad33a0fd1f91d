//! A law of another file whose strength follows the coil current.
//!
//! Every coefficient has a value at the lowest and one at the highest current of the recordings, each with the
//! limits of the plain law, and is affine in the current between them, as the base model's own are.
//! Reference: Spencer, Dyke, Sain and Carlson, J. Eng. Mech. 123 (1997) 230.
//! Known limit: where all recordings have one current it is the plain law.

use super::{About, Effect, Scene, Sizes};
use crate::parameter::Parameter;

/// A law that adds columns, with the current.
pub(super) struct WithCurrent {
    /// The plain law.
    pub(super) law: &'static dyn Effect,
    /// Name among the laws of the effect.
    pub(super) name: &'static str,
    /// Equation.
    pub(super) equation: &'static str,
}

impl Effect for WithCurrent {
    fn about(&self) -> About {
        About { law: self.name, equation: self.equation, ..self.law.about() }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        self.law.applies(sizes) && sizes.current.is_some_and(|(low, high)| high > low)
    }

    fn coefficients(&self) -> Vec<Parameter> {
        let plain = self.law.coefficients();
        let at = |end: &str| {
            let named = |p: &Parameter| Parameter { name: format!("{}_{end}", p.name), ..p.clone() };
            plain.iter().map(named).collect::<Vec<_>>()
        };
        [at("low"), at("high")].concat()
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        self.law.shape(sizes)
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law.starts(sizes)
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let plain = self.law.columns(scene, shape);
        let (low, span) = (scene.sizes.current.map_or(0.0, |(low, _)| low), scene.sizes.current_span());
        // Outside the levels the nearest holds, as for a device.
        let share: Vec<f64> = match scene.current {
            Some(current) => current.iter().map(|i| ((i - low) / span).clamp(0.0, 1.0)).collect(),
            None => vec![0.0; scene.len()],
        };
        let times = |weight: &dyn Fn(f64) -> f64| -> Vec<Vec<f64>> {
            let of = |column: &Vec<f64>| column.iter().zip(&share).map(|(c, u)| c * weight(*u)).collect();
            plain.iter().map(of).collect()
        };
        [times(&|u| 1.0 - u), times(&|u| u)].concat()
    }
}
