//! Spring: `F = k x`.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | k0, kx | stiffness | N/mm | >= 0 |
//!
//! Source: Yu, Li and Li, ISARC 2014, eq. 1 and 3.
//! Known limit: inertia at one frequency and a constant vertical load hide in it.

use super::Term;
use crate::extent::Extent;
use crate::parameter::{Ideal, Parameter, Scale};
use crate::recording::Recording;

/// Linear stiffness under the name it has in its model.
#[derive(Debug, Clone, Copy)]
pub struct Spring {
    /// `k0`, or `kx` beside a hysteretic spring.
    pub name: &'static str,
}

impl Term for Spring {
    fn coefficient(&self, extent: &Extent) -> Parameter {
        Parameter {
            name: self.name.into(),
            unit: "N/mm",
            smallest: 0.0,
            largest: f64::INFINITY,
            lower: 0.0,
            // Beside a softening term the spring alone is steeper than the whole.
            upper: if extent.softens { 4.0 } else { 1.5 } * extent.force / extent.displacement,
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }
    }

    fn column(&self, recording: &Recording, _shape: &[f64], out: &mut [f64]) {
        out.copy_from_slice(recording.displacement());
    }
}
