//! Columns projected off the tangents of a fitted model, and what they are made on.

use nalgebra::{DMatrix, DVector};

use super::point::Point;
use super::shaken::unsure;
use super::strays::Strays;
use crate::assembly::Assembly;
use crate::effect::{Effect, Scene};

/// Columns projected off the tangents of a fitted model.
pub(super) struct Projection {
    pub(super) gram: DMatrix<f64>,
    /// Products with the residual.
    pub(super) right: DVector<f64>,
    /// The same where no wild sample of a noise with heavy tails counts for much: the smaller of the two is what a test
    /// hears.
    pub(super) tame: DVector<f64>,
    /// What the noise of the motions is expected to give of them.
    pub(super) bias: DVector<f64>,
    /// Squares before the projection.
    pub(super) squares: Vec<f64>,
    /// How far that noise scatters the products.
    pub(super) strays: Strays,
}

impl Projection {
    /// Strength of a single column, less what the noise of the motions may give of it.
    pub(super) fn strength(&self, i: usize) -> f64 {
        let bias = self.bias[i];
        let size = self.gram[(i, i)].sqrt();
        let scatter = self.strays.of(&[i], &[1.0 / size]).covariance()[(0, 0)].sqrt();
        let of = |right: f64| (right - bias * unsure(right / bias)) / (size * scatter);
        smaller(of(self.right[i]), of(self.tame[i]))
    }

    /// Product of a column with the residual, as it counts in a test.
    pub(super) fn counted(&self, i: usize) -> f64 {
        smaller(self.right[i], self.tame[i])
    }
}

/// The value that is closer to zero.
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if b.abs() < a.abs() { b } else { a }
}

/// Recordings as a column is made on them: as they are, or with other motions.
pub(super) struct View<'v, 'a> {
    pub(super) assembly: &'v Assembly<'a>,
    /// Force in N of the fitted model, by recording.
    pub(super) force: Vec<&'v [f64]>,
}

impl<'v, 'a> View<'v, 'a> {
    pub(super) fn at(assembly: &'v Assembly<'a>, point: &'v Point) -> Self {
        Self { assembly, force: point.recordings.iter().map(|local| local.force.as_slice()).collect() }
    }

    /// The model with one more law.
    pub(super) fn with(&self, effect: &'static dyn Effect) -> Assembly<'a> {
        let mut effects = self.assembly.effects().to_vec();
        effects.push(effect);
        self.assembly.with(effects)
    }

    /// What effects see of a recording.
    pub(super) fn scene(&self, r: usize) -> Scene<'_> {
        self.assembly.scene(r)
    }
}
