//! The physics a model is made of: one file a term.
//!
//! A term adds `coefficient * column` to the force. The column is computed from the motion with zero
//! or more nonlinear shape parameters.

mod bouc_wen;
mod dashpot;
mod offset;
mod sinh;
mod spring;

pub use bouc_wen::{BoucWen, Classical, STEP as BOUC_WEN_STEP};
pub use dashpot::Dashpot;
pub use offset::Offset;
pub use sinh::{LARGEST as SINH_LARGEST, Sinh};
pub use spring::Spring;

use crate::extent::Extent;
use crate::parameter::Parameter;
use crate::recording::Recording;

/// What a term does with energy: effects scale terms by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// Stores it.
    Stiffness,
    /// Stores some and loses the rest, whatever the speed.
    Hysteretic,
    /// Viscous.
    Damping,
    /// Neither.
    Offset,
}

/// A term of a model.
pub trait Term: Send + Sync {
    /// What the term does with energy.
    fn part(&self) -> Part {
        Part::Stiffness
    }

    /// The linear coefficient, with its default box.
    fn coefficient(&self, extent: &Extent) -> Parameter;

    /// The shape parameters, with their default boxes.
    fn shape(&self, extent: &Extent) -> Vec<Parameter> {
        let _ = extent;
        Vec::new()
    }

    /// Bounds by name, lower and upper, of shape parameters that a device may have outside their default box, in which swarms
    /// search.
    fn far(&self, extent: &Extent) -> Vec<(String, f64, f64)> {
        let _ = extent;
        Vec::new()
    }

    /// True where the coefficient follows the coil current in the default law.
    fn follows_current(&self) -> bool {
        true
    }

    /// Fill `out` with the column of the term. A column that cannot be computed (a step too coarse
    /// for a stiff candidate) is filled with infinity, never with NaN.
    fn column(&self, recording: &Recording, shape: &[f64], out: &mut [f64]);

    /// Columns of several recordings, each with its own shape. A column does not depend on the others.
    fn columns(&self, of: &[(&Recording, &[f64])]) -> Vec<Vec<f64>> {
        let column = |(recording, shape): &(&Recording, &[f64])| {
            let mut out = vec![0.0; recording.len()];
            self.column(recording, shape, &mut out);
            out
        };
        of.iter().map(column).collect()
    }
}
