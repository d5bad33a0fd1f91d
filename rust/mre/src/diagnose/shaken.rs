//! What noise of a motion does to products with the residual.
//!
//! The force does not follow the noise of a displacement or a velocity, but columns do, and so does the
//! force of the model: of what is left, that part goes together with every column that answers to motion (errors in
//! variables: Fuller 1987, <https://doi.org/10.1002/9780470316665>). How much is expected is told by the same noise added
//! once more (Cook and Stefanski 1994, <https://doi.org/10.1080/01621459.1994.10476871>).

use nalgebra::DVector;
use rayon::prelude::*;

use super::least_squares::{Data, Fitted};
use super::normal::whitened;
use super::point::Point;
use super::projection::View;
use super::tangents::tangents_at;
use crate::assembly::Assembly;
use crate::kernel::filter::dot;

/// What noise may find at most, over what it is expected to: its size is known above the frequencies of the motion, and
/// taken to be the same below.
pub(super) const MOST: f64 = 1.5;

/// Squared standard deviations in all that such noise changes the force by, below which it finds nothing.
const LEAST: f64 = 0.5;

/// How much of an expected bias is taken off: as much as wanted, up to the most that it may be.
pub(super) fn unsure(wanted: f64) -> f64 {
    if wanted.is_nan() { 0.0 } else { wanted.clamp(0.0, MOST) }
}

/// Motions with noise on which columns are made; on others only forces are.
const WITH_COLUMNS: usize = 2;

/// What the force of a fitted model on motions with more noise differs by from that on the motions themselves, whitened, by
/// recording.
pub(super) type Change = Vec<Vec<f64>>;

/// Squared standard deviations in all.
pub(super) fn square(change: &Change) -> f64 {
    change.iter().map(|c| dot(c, c)).sum()
}

/// What noise of the motions leaves a fitted model to explain, in squared standard deviations: a model that follows it
/// leaves more than one that smooths it, whichever is true.
pub(super) fn left_by_noise(assembly: &Assembly, data: Data, fitted: &Fitted) -> f64 {
    if assembly.campaign().shaken().is_empty() {
        return 0.0;
    }
    let (some, more) = Shaken::of(assembly, data, &Point::at(assembly, data, fitted.unit.clone()));
    let squares: Vec<f64> = some.iter().map(Shaken::change).chain(&more).map(square).collect();
    squares.iter().sum::<f64>() / squares.len().max(1) as f64
}

/// A fitted model on motions with their noise added once more.
pub(super) struct Shaken<'a> {
    assembly: Assembly<'a>,
    point: Point,
    change: Change,
}

impl<'a> Shaken<'a> {
    /// Some of them, and changes of the force on others; none where the noise is too small to find anything.
    pub(super) fn of(assembly: &Assembly<'a>, data: Data, point: &Point) -> (Vec<Self>, Vec<Change>) {
        let fitted = &point.fitted;
        let campaigns = assembly.campaign().shaken();
        if campaigns.is_empty() || assembly.clips(&assembly.physical(&fitted.unit)) {
            return (Vec::new(), Vec::new());
        }
        let on = |campaign| {
            let assembly = assembly.on_motions(campaign, &fitted.unit, &fitted.coefficients);
            assembly.knowing(&assembly.physical(&fitted.unit))
        };
        let change = |there: &[Vec<f64>]| -> Change {
            let each = there.iter().zip(&point.recordings).enumerate().map(|(r, (there, here))| {
                let change: Vec<f64> = there.iter().zip(&here.force).map(|(a, b)| a - b).collect();
                whitened(data.noise, r, &data.rows[r], &change)
            });
            each.collect()
        };
        let (first, others) = campaigns.split_at(WITH_COLUMNS.min(campaigns.len()));
        let shaken = first.iter().map(|campaign| {
            let assembly = on(campaign);
            let there = point.elsewhere(&assembly, data);
            let forces: Vec<Vec<f64>> = there.recordings.iter().map(|local| local.force.clone()).collect();
            Self { assembly, change: change(&forces), point: there }
        });
        let all: Vec<Self> = shaken.collect();
        let squares: Vec<f64> = all.iter().map(|shaken| square(&shaken.change)).collect();
        if squares.iter().all(|square| square.is_finite()) && squares.iter().any(|square| *square > LEAST) {
            let more = others.par_iter().map(|campaign| change(&point.force_elsewhere(&on(campaign))));
            // A draw may be too coarse for a stiff device.
            (all, more.filter(|change| square(change).is_finite()).collect())
        } else {
            (Vec::new(), Vec::new())
        }
    }

    /// What the force differs by.
    pub(super) fn change(&self) -> &Change {
        &self.change
    }

    /// The same, to be weighed.
    pub(super) fn change_mut(&mut self) -> &mut Change {
        &mut self.change
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
