//! Inertia: a mass that moves with the device is weighed by the load cell.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | m | moving mass | kg | >= 0 |
//!
//! The column is the acceleration in m/s^2, so that the mass comes out in kg and the force in N.
//! Known limits: at one steady frequency it is part of k0, at any number of amplitudes; behind a fixture that gives way, or with
//! a late displacement, the acceleration is the measured one.

use super::operators::each;
use super::{About, Effect, Scene, Sizes, positive};
use crate::parameter::Parameter;

/// A moving mass.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inertia;

impl Effect for Inertia {
    fn about(&self) -> About {
        About {
            effect: "inertia",
            law: "moving mass",
            plain: "a mass moves with the device and its inertia is part of the measured force",
            equation: "F_i = m a",
            reference: "Newton's second law",
            limit: "at one steady frequency it is part of k0, at any number of amplitudes",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("m", "kg")]
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        vec![each(scene.acceleration.get(), |a| 1e-3 * a)]
    }
}
