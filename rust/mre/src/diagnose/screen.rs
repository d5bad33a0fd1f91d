//! Score tests of a catalogue: what each law, added to a fitted model, could take off the residual.
//!
//! At each start of a law its columns (or the change it makes to the force) are projected off the tangents
//! of the fitted model on whitened data. The smallest p-value over the starts is corrected for their
//! number, as far as they differ, by simulating the projections under the null: they are normal with a
//! known covariance, whatever the number of samples.

use nalgebra::DVector;

use super::block::{Block, SMALLEST_SHARE};
use super::correction::correction;
use super::distribution::CAUTION;
use super::null::Null;
use super::projection::{Projection, View};
use crate::effect::Effect;
use crate::kernel::filter::dot;

/// Starts whose columns are made at a time: as many as a kernel has lanes.
const TOGETHER: usize = 8;

/// What a model leaves of a law.
#[derive(Debug, Clone, Default)]
pub struct Trace {
    /// Squared standard deviations, per mean square in N^2 of the force that it adds.
    pub left: f64,
    /// Root mean square in N that a unit of the coefficient adds, or of the first shape where there is none.
    pub of_a_unit: f64,
    /// Place of the coefficient.
    pub coefficient: usize,
    /// Shapes of the law.
    pub shape: Vec<f64>,
}

/// What the score test of one law found.
#[derive(Clone)]
pub struct Score {
    /// The law.
    pub effect: &'static dyn Effect,
    /// The start where it is strongest.
    pub start: Vec<f64>,
    /// Squared standard deviations that it could take off there.
    pub gain: f64,
    /// Number of its coefficients.
    pub freedom: usize,
    /// p-value, corrected over the starts.
    pub p_value: f64,
    /// Largest share of its columns' squares that the model's tangents do not absorb, over the starts.
    pub visible: f64,
    /// What is left of it at the start where that is most.
    pub trace: Trace,
    /// Number of tests that its starts amount to.
    pub tests: f64,
}

impl Score {
    /// Parameters that the law takes.
    pub(super) fn parameters(&self) -> usize {
        self.freedom + self.start.len()
    }
}

impl Null<'_> {
    /// Score test of one law.
    pub(super) fn score(&self, effect: &'static dyn Effect, seed: u64) -> Option<Score> {
        let sizes = self.assembly().campaign().sizes();
        if !effect.applies(sizes) || self.broken_off() {
            return None;
        }
        let starts = effect.starts(sizes);
        let recordings = self.point.recordings.len();
        let coefficients = effect.coefficients();
        let own = if effect.of_the_measurement() { recordings } else { 1 };
        let width = (coefficients.len() * own).max(1);
        let mut raw = vec![0.0; width * starts.len()];
        let of_law = |view: &View, r| {
            let columns = self.law_columns(view, (effect, width), &starts, r);
            if self.is_own(view) {
                for (i, column) in &columns {
                    raw[*i] += dot(column, column);
                }
            }
            columns
        };
        let Projection { gram, right, tame, bias, squares, strays } =
            self.project(width * starts.len(), of_law);
        let samples: usize = self.point.recordings.iter().map(|l| l.force.len()).sum();
        let block = |s: usize| {
            let g = gram.view((s * width, s * width), (width, width)).into_owned();
            (g, (0..width).map(|k| squares[s * width + k]).collect::<Vec<_>>())
        };
        let limits = |k: usize| match coefficients.get(k % coefficients.len().max(1)) {
            Some(p) => (p.smallest, p.largest),
            // The change that a law makes has the sign of its start.
            None => (0.0, f64::INFINITY),
        };
        let lower: Vec<f64> = (0..width).map(|k| limits(k).0).collect();
        let upper: Vec<f64> = (0..width).map(|k| limits(k).1).collect();
        let blocks: Vec<Block> = (0..starts.len())
            .map(|s| {
                let (gram, squares) = block(s);
                Block::new(gram, &squares, lower.clone(), upper.clone())
            })
            .collect();
        let visible = blocks.iter().map(|b| b.visible).fold(0.0, f64::max);
        let part = |v: &DVector<f64>, s: usize| v.rows(s * width, width).into_owned();
        let gain = |of: &DVector<f64>, s: usize| {
            let places: Vec<usize> = (s * width..(s + 1) * width).collect();
            let scattered = blocks[s].scattered(&strays.of(&places, &vec![1.0; width]));
            scattered.least_gain(&part(of, s), &part(&bias, s))
        };
        let gains: Vec<f64> = (0..starts.len()).map(|s| gain(&right, s)).collect();
        let of_a_test = |s: usize| if tame == right { gains[s] } else { gains[s].min(gain(&tame, s)) };
        let counted: Vec<f64> = (0..starts.len()).map(of_a_test).collect();
        let (best, _) = counted.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
        let tail = |s: usize| blocks[s].tail(counted[s] / CAUTION);
        let smallest = (0..starts.len()).map(tail).fold(1.0, f64::min);
        let correction = correction(&gram, &blocks, width, seed);
        let trace = (0..raw.len())
            .filter(|i| raw[*i] > 0.0)
            .map(|i| {
                let mean_square = raw[i] / samples as f64;
                let unit = if coefficients.is_empty() { starts[i / width].first().copied() } else { None };
                let share = gram[(i, i)] / squares[i];
                let left = if share < SMALLEST_SHARE { 0.0 } else { gram[(i, i)] / mean_square };
                let of_a_unit = mean_square.sqrt() / unit.unwrap_or(1.0).abs();
                let coefficient = i % coefficients.len().max(1);
                Trace { left, of_a_unit, coefficient, shape: starts[i / width].clone() }
            })
            .max_by(|a, b| a.left.total_cmp(&b.left))
            .unwrap_or_default();
        Some(Score {
            effect,
            start: starts[best].clone(),
            gain: gains[best],
            freedom: width,
            p_value: (correction * smallest).min(1.0),
            visible,
            trace,
            tests: correction,
        })
    }

    /// Columns of all starts of a law on one recording, with their places.
    pub(super) fn law_columns(
        &self,
        view: &View,
        (effect, width): (&'static dyn Effect, usize),
        starts: &[Vec<f64>],
        r: usize,
    ) -> Vec<(usize, Vec<f64>)> {
        let shapes = self.shapes();
        let known = self.point.fitted.coefficients.len();
        let joint = view.with(effect);
        let mut found = Vec::new();
        let all: Vec<Vec<f64>> =
            starts.iter().map(|start| shapes.iter().chain(start).copied().collect()).collect();
        let jobs: Vec<(usize, &[f64])> = all.iter().map(|shapes| (r, shapes.as_slice())).collect();
        // A few at a time: most of their columns are those of the model, and are let go.
        let columns = jobs.chunks(TOGETHER).flat_map(|few| joint.columns_of(few));
        for (s, columns) in columns.enumerate() {
            if effect.coefficients().is_empty() {
                let mut change = columns.measured(&self.point.fitted.coefficients);
                for (c, f) in change.iter_mut().zip(view.force[r]) {
                    *c -= f;
                }
                found.push((s * width, change));
            } else {
                for (column, place) in columns.columns.into_iter().zip(columns.places) {
                    if place >= known {
                        found.push((s * width + place - known, column));
                    }
                }
            }
        }
        found.retain(|(_, column)| column.iter().all(|v| v.is_finite()) && column.iter().any(|v| *v != 0.0));
        found
    }
}
