//! Force offset: `F = F0`.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | F0 | force at rest in the middle position | N | any |
//!
//! Source: Yu, Li and Li, ISARC 2014, eq. 3.
//! Known limit: a zero error of the load cell and a gas preload look the same.

use super::{Part, Term};
use crate::extent::Extent;
use crate::parameter::{Ideal, Parameter, Scale};
use crate::recording::Recording;

/// Constant force.
#[derive(Debug, Clone, Copy)]
pub struct Offset;

impl Term for Offset {
    fn part(&self) -> Part {
        Part::Offset
    }

    fn coefficient(&self, extent: &Extent) -> Parameter {
        let width = (0.25 + extent.lean) * extent.force;
        Parameter {
            name: "F0".into(),
            unit: "N",
            smallest: f64::NEG_INFINITY,
            largest: f64::INFINITY,
            lower: extent.offset - width,
            upper: extent.offset + width,
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }
    }

    fn follows_current(&self) -> bool {
        false
    }

    fn column(&self, _recording: &Recording, _shape: &[f64], out: &mut [f64]) {
        out.fill(1.0);
    }
}
