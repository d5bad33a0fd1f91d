//! Strain stiffening: `F = alpha sinh(beta x)`.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | alpha | force scale | N | any |
//! | beta | displacement scale | 1/mm | > 0 (a negative one is a negative alpha) |
//!
//! Source: Yu, Li and Li, ISARC 2014, eq. 3 and 4.
//! Known limit: for `beta x` below 1 only `k0 + alpha beta` and `alpha beta^3` are determined.

use super::Term;
use crate::extent::Extent;
use crate::kernel::elementary;
use crate::parameter::{Ideal, Parameter, Scale};
use crate::recording::Recording;

/// Largest `|beta x|`: beyond, sinh overflows.
pub const LARGEST: f64 = 700.0;

/// Largest `|beta x|` of a device: at the largest displacement its tangent is 200 times that in the middle.
const STEEPEST: f64 = 6.0;

/// Hyperbolic-sine spring.
#[derive(Debug, Clone, Copy)]
pub struct Sinh;

impl Term for Sinh {
    fn coefficient(&self, extent: &Extent) -> Parameter {
        Parameter {
            name: "alpha".into(),
            unit: "N",
            smallest: f64::NEG_INFINITY,
            largest: f64::INFINITY,
            lower: if extent.softens { -2.0 * extent.force } else { 0.0 },
            upper: if extent.softens { 0.0 } else { 2.0 * extent.force },
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }
    }

    fn shape(&self, extent: &Extent) -> Vec<Parameter> {
        vec![Parameter {
            name: "beta".into(),
            unit: "1/mm",
            smallest: 0.0,
            largest: f64::INFINITY,
            lower: 0.05 / extent.displacement,
            upper: 3.0 / extent.displacement,
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }]
    }

    fn far(&self, extent: &Extent) -> Vec<(String, f64, f64)> {
        self.shape(extent)
            .into_iter()
            .map(|beta| (beta.name, beta.lower, STEEPEST / extent.displacement))
            .collect()
    }

    fn column(&self, recording: &Recording, shape: &[f64], out: &mut [f64]) {
        for (value, x) in out.iter_mut().zip(recording.displacement()) {
            *value = elementary::sinh(shape[0] * x);
        }
    }
}
