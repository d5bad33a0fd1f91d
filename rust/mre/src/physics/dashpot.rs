//! Dashpot: `F = c0 v`.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | c0 | viscous damping coefficient | N s/mm | >= 0 |
//!
//! Source: Yu, Li and Li, ISARC 2014, eq. 1 and 3.
//! Known limit: energy per cycle grows with frequency, which filled rubber does not do.

use super::{Part, Term};
use crate::extent::Extent;
use crate::parameter::{Ideal, Parameter, Scale};
use crate::recording::Recording;

/// Linear viscous damping.
#[derive(Debug, Clone, Copy)]
pub struct Dashpot;

impl Term for Dashpot {
    fn part(&self) -> Part {
        Part::Damping
    }

    fn coefficient(&self, extent: &Extent) -> Parameter {
        Parameter {
            name: "c0".into(),
            unit: "N s/mm",
            smallest: 0.0,
            largest: f64::INFINITY,
            lower: 0.0,
            upper: 1.5 * extent.force / extent.velocity,
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }
    }

    fn column(&self, recording: &Recording, _shape: &[f64], out: &mut [f64]) {
        out.copy_from_slice(recording.velocity());
    }
}
