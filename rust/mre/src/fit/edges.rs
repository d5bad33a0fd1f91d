//! Minima at the edge of two numbers of sub-steps.
//!
//! Where the stiffness of the hysteretic variable passes a power of two, the simulation takes other sub-steps
//! and the cost jumps by some 1e-6 of itself: little, but a descent ends wherever it meets the edge, and the
//! least cost may lie further along it. In octaves of stiffness the edge is a wall of a box.

use super::descent::Point;
use super::projection::Projection;
use super::refine::refine;
use crate::kernel::hysteretic::unrounded_stiffness;

/// A minimum nearer to an edge than this, in octaves, is looked at again.
const NEAR: f64 = 1e-2;
/// Distance kept from the edges of an octave, in octaves, lest rounding passes them.
const MARGIN: f64 = 1e-12;

impl Projection<'_> {
    /// Refine a minimum of the cost over the shapes. Returns the best point ever evaluated and the number of
    /// evaluations.
    pub(super) fn refine(&self, start: Point) -> (Point, u64) {
        let (mut best, mut evaluations) = refine(start, &|rows| self.costs(rows));
        if self.in_lanes() && !self.cancelled() {
            let octaves = self.octaves(&best.at);
            let edge = octaves.round();
            if (octaves - edge).abs() < NEAR {
                for top in [edge, edge + 1.0] {
                    let (found, more) = Octave { projection: self, top }.refine(&best);
                    evaluations += more;
                    if found.value < best.value {
                        best = found;
                    }
                }
            }
        }
        (best, evaluations)
    }

    /// Binary logarithm of the stiffness of shapes in the unit box.
    fn octaves(&self, unit: &[f64]) -> f64 {
        let row = self.physical(unit);
        unrounded_stiffness([row[3], row[4], row[5]]).log2()
    }
}

/// The shapes with up to `2^top` of stiffness, and more than half of it: the sub-steps are the same.
struct Octave<'a> {
    projection: &'a Projection<'a>,
    top: f64,
}

impl Octave<'_> {
    fn refine(&self, near: &Point) -> (Point, u64) {
        let mut start = near.at.clone();
        start[0] = (self.projection.octaves(&near.at) - self.top + 1.0).clamp(0.0, 1.0);
        let value = self.projection.costs(&self.shapes(&start))[0];
        let values = |rows: &[f64]| {
            let shapes: Vec<f64> = rows.chunks_exact(start.len()).flat_map(|row| self.shapes(row)).collect();
            self.projection.costs(&shapes)
        };
        let (found, evaluations) = refine(Point { at: start.clone(), value }, &values);
        (Point { at: self.shapes(&found.at), value: found.value }, evaluations + 1)
    }

    /// Shapes in the unit box from a place in the octave, sigma and n. Where rho would leave its bounds it stops
    /// there.
    fn shapes(&self, at: &[f64]) -> Vec<f64> {
        let mut row = self.projection.physical(at);
        let octaves = (self.top - 1.0 + at[0]).clamp(self.top - 1.0 + MARGIN, self.top - MARGIN);
        row[3] = octaves.exp2() / unrounded_stiffness([1.0, row[4], row[5]]);
        self.projection.unit_shapes(&row)
    }
}
