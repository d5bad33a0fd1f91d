//! What noise of a motion does to products with the residual.
//!
//! The force does not follow the noise of a displacement or a velocity, but columns do, and so does the
//! force of the model: of what is left, that part goes together with every column that answers to motion (errors in
//! variables: Fuller 1987, <https://doi.org/10.1002/9780470316665>). How much is expected is told by the same noise added
//! once more (Cook and Stefanski 1994, <https://doi.org/10.1080/01621459.1994.10476871>).

use nalgebra::DVector;

use super::least_squares::Data;
use super::normal::whitened;
use super::point::{Local, Point};
use super::projection::View;
use super::tangents::tangents_at;
use crate::assembly::Assembly;
use crate::kernel::filter::dot;

/// What noise may find at most, over what it is expected to: its size is known above the frequencies of the motion, and
/// taken to be the same below.
const MOST: f64 = 1.5;

/// Squared standard deviations in all that such noise changes the force by, below which it finds nothing.
const LEAST: f64 = 0.5;

/// How much of an expected bias is taken off: as much as wanted, up to the most that it may be.
pub(super) fn unsure(wanted: f64) -> f64 {
    if wanted.is_nan() { 0.0 } else { wanted.clamp(0.0, MOST) }
}

/// A fitted model on motions with their noise added once more.
pub(super) struct Shaken<'a> {
    assembly: Assembly<'a>,
    point: Point,
    /// What its force differs by from the force on the motions themselves, whitened.
    change: Vec<Vec<f64>>,
}

impl<'a> Shaken<'a> {
    /// Some of them; none where the noise is too small to find anything.
    pub(super) fn of(assembly: &Assembly<'a>, data: Data, point: &Point) -> Vec<Self> {
        let fitted = &point.fitted;
        if assembly.clips(&assembly.physical(&fitted.unit)) {
            return Vec::new();
        }
        let there = assembly.campaign().shaken().iter().map(|campaign| {
            let assembly = assembly.on_motions(campaign, &fitted.unit, &fitted.coefficients);
            let assembly = assembly.knowing(&assembly.physical(&fitted.unit));
            let there = point.elsewhere(&assembly, data);
            let change = |(r, (there, here)): (usize, (&Local, &Local))| {
                let change: Vec<f64> = there.force.iter().zip(&here.force).map(|(a, b)| a - b).collect();
                whitened(data.noise, r, &data.rows[r], &change)
            };
            let change = there.recordings.iter().zip(&point.recordings).enumerate().map(change).collect();
            Self { assembly, point: there, change }
        });
        let all: Vec<Self> = there.collect();
        let squares = |shaken: &Self| shaken.change.iter().map(|c| dot(c, c)).sum::<f64>();
        let most = all.iter().map(squares).fold(0.0, f64::max);
        if most > LEAST && most.is_finite() { all } else { Vec::new() }
    }

    /// All tangents there; the point's own columns are taken for them.
    pub(super) fn tangents(&mut self, data: Data, known: usize) -> Vec<Vec<(usize, Vec<f64>)>> {
        tangents_at(&self.assembly, data, &mut self.point, known)
    }

    /// The recordings with these motions.
    pub(super) fn view(&self) -> View<'_, 'a> {
        View::at(&self.assembly, &self.point)
    }

    /// Add products of whitened columns of a recording with the residual that the noise leaves, by their places.
    pub(super) fn add(&self, r: usize, sums: &mut DVector<f64>, columns: &[(usize, Vec<f64>)], times: f64) {
        for (place, column) in columns {
            // Noise may fall into more parts in one draw than in another.
            if let Some(sum) = sums.get_mut(*place) {
                *sum -= times * dot(column, &self.change[r]);
            }
        }
    }
}
