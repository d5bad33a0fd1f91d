//! Score tests of a catalogue: what each law, added to a fitted model, could take off the residual.
//!
//! At each start of a law its columns (or the change it makes to the force) are projected off the tangents
//! of the fitted model on whitened data. The smallest p-value over the starts is corrected for their
//! number, as far as they differ, by simulating the projections under the null: they are normal with a
//! known covariance, whatever the number of samples.

use super::bounded;
use super::candidates::of_the_scored;
use super::distribution::{chi_square_tail, normal};
use super::least_squares::{Data, Point};
use super::normal::whitened;
use crate::assembly::Assembly;
use crate::effect::{Effect, Scene};
use crate::kernel::filter::dot;
use nalgebra::{DMatrix, DVector};
use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;

/// Share of a column's square that has to survive the projection: below it the column is absorbed.
const SMALLEST_SHARE: f64 = 1e-8;
/// Simulated draws for the correction over the starts of a law.
const DRAWS: usize = 400;
/// Level at which the correction is measured.
const LEVEL: f64 = 0.05;

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
    /// Squared standard deviations that are left of it, per mean square in N^2 of the force that it adds, at
    /// the start where that is most; with the root mean square in N that a unit of its first parameter adds.
    pub trace: (f64, f64),
    /// Number of tests that its starts amount to.
    pub tests: f64,
}

/// Orthogonal complement of the tangents of a fitted model, by recording.
pub(super) struct Null<'a> {
    assembly: Assembly<'a>,
    data: Data<'a>,
    point: Point,
    tangents: Vec<Vec<(usize, Vec<f64>)>>,
    /// Factor of the tangents' normal equations, scaled to ones on the diagonal.
    factor: nalgebra::Cholesky<f64, nalgebra::Dyn>,
    scale: Vec<f64>,
    /// Products of the tangents with the residual.
    right: DVector<f64>,
}

impl<'a> Null<'a> {
    pub(super) fn new(assembly: &Assembly<'a>, data: Data<'a>, unit: &[f64]) -> Option<Self> {
        if data.monitor.broken_off() {
            return None;
        }
        let assembly = assembly.knowing(&assembly.physical(unit));
        let point = Point::at(&assembly, data, unit.to_vec());
        let count = point.fitted.coefficients.len() + unit.len();
        let tangents: Vec<Vec<(usize, Vec<f64>)>> = point
            .tangents(&assembly, data)
            .into_iter()
            .zip(&point.recordings)
            .map(|(own, local)| local.columns.iter().cloned().chain(own).collect())
            .collect();
        let mut gram = DMatrix::<f64>::zeros(count, count);
        let mut right = DVector::<f64>::zeros(count);
        for (columns, local) in tangents.iter().zip(&point.recordings) {
            for (i, a) in columns {
                right[*i] += dot(a, &local.residual);
                for (j, b) in columns {
                    gram[(*i, *j)] += dot(a, b);
                }
            }
        }
        for (i, known) in assembly.known_of_coefficients().into_iter().enumerate() {
            gram[(i, i)] += known;
        }
        let scale: Vec<f64> =
            (0..count).map(|i| if gram[(i, i)] > 0.0 { 1.0 / gram[(i, i)].sqrt() } else { 0.0 }).collect();
        let scaled = DMatrix::from_fn(count, count, |i, j| {
            let unit = if i == j { 1e-11 + f64::from(u8::from(scale[i] == 0.0)) } else { 0.0 };
            gram[(i, j)] * scale[i] * scale[j] + unit
        });
        let factor = scaled.cholesky()?;
        Some(Self { assembly, data, point, tangents, factor, scale, right })
    }

    /// True where the search was broken off.
    pub(super) fn broken_off(&self) -> bool {
        self.data.monitor.broken_off()
    }

    /// The model whose tangents are projected off.
    pub(super) fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
    }

    /// Residuals of the fitted model in N, of the samples that are scored.
    pub(super) fn residuals(&self) -> Vec<Vec<f64>> {
        let recordings = self.assembly.campaign().recordings();
        let pairs = recordings.iter().zip(&self.point.recordings);
        pairs.map(|(r, local)| of_the_scored(r, &local.force)).collect()
    }

    /// What effects see of a recording.
    pub(super) fn scene(&self, r: usize) -> Scene<'_> {
        self.assembly.scene(r)
    }

    /// Gram matrix and right side of columns, projected off the tangents, and the squares before that.
    /// `columns(r)` gives those of a recording with their places among `count`.
    pub(super) fn project(
        &self,
        count: usize,
        mut columns: impl FnMut(usize) -> Vec<(usize, Vec<f64>)>,
    ) -> (DMatrix<f64>, DVector<f64>, Vec<f64>) {
        let tangent_count = self.scale.len();
        let mut gram = DMatrix::<f64>::zeros(count, count);
        let mut cross = DMatrix::<f64>::zeros(tangent_count, count);
        let mut right = DVector::<f64>::zeros(count);
        for (r, local) in self.point.recordings.iter().enumerate() {
            let mut white: Vec<(usize, Vec<f64>)> = Vec::new();
            for (i, series) in columns(r) {
                let z = whitened(self.data.noise, r, &self.data.rows[r], &series);
                right[i] += dot(&z, &local.residual);
                for (j, t) in &self.tangents[r] {
                    cross[(*j, i)] += dot(t, &z);
                }
                gram[(i, i)] += dot(&z, &z);
                for (j, other) in &white {
                    let product = dot(other, &z);
                    gram[(i, *j)] += product;
                    gram[(*j, i)] += product;
                }
                white.push((i, z));
            }
        }
        let squares = (0..count).map(|i| gram[(i, i)]).collect();
        let scaled = DMatrix::from_fn(tangent_count, count, |j, i| cross[(j, i)] * self.scale[j]);
        let tangent_right = DVector::from_fn(tangent_count, |j, _| self.right[j] * self.scale[j]);
        let solved = self.factor.solve(&scaled);
        (gram - scaled.transpose() * &solved, right - solved.transpose() * tangent_right, squares)
    }

    /// Score test of one law.
    pub(super) fn score(&self, effect: &'static dyn Effect, seed: u64) -> Option<Score> {
        let sizes = self.assembly.campaign().sizes();
        if !effect.applies(sizes) || self.broken_off() {
            return None;
        }
        let starts = effect.starts(sizes);
        let recordings = self.point.recordings.len();
        let coefficients = effect.coefficients();
        let own = if effect.of_the_measurement() { recordings } else { 1 };
        let width = (coefficients.len() * own).max(1);
        let joint = self.with(effect);
        let mut raw = vec![0.0; width * starts.len()];
        let (gram, right, squares) = self.project(width * starts.len(), |r| {
            let columns = self.law_columns(&joint, effect, &starts, width, r);
            for (i, column) in &columns {
                raw[*i] += dot(column, column);
            }
            columns
        });
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
        let gains: Vec<f64> = (0..starts.len()).map(|s| blocks[s].gain(&part(&right, s))).collect();
        let (best, gain) = gains.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let smallest = (0..starts.len()).map(|s| blocks[s].tail(gains[s])).fold(1.0, f64::min);
        let correction = correction(&gram, &blocks, width, seed);
        let trace = (0..raw.len())
            .filter(|i| raw[*i] > 0.0)
            .map(|i| {
                let mean_square = raw[i] / samples as f64;
                let unit = if coefficients.is_empty() { starts[i / width].first().copied() } else { None };
                let share = gram[(i, i)] / squares[i];
                let left = if share < SMALLEST_SHARE { 0.0 } else { gram[(i, i)] / mean_square };
                (left, mean_square.sqrt() / unit.unwrap_or(1.0).abs())
            })
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((0.0, 0.0));
        Some(Score {
            effect,
            start: starts[best].clone(),
            gain,
            freedom: width,
            p_value: (correction * smallest).min(1.0),
            visible,
            trace,
            tests: correction,
        })
    }

    /// The model with one more law.
    pub(super) fn with(&self, effect: &'static dyn Effect) -> Assembly<'a> {
        let mut effects = self.assembly.effects().to_vec();
        effects.push(effect);
        self.assembly.with(effects)
    }

    /// Shapes of the fitted model, in their units.
    pub(super) fn shapes(&self) -> Vec<f64> {
        self.assembly.physical(&self.point.fitted.unit)
    }

    /// Columns of all starts of a law on one recording, with their places.
    pub(super) fn law_columns(
        &self,
        joint: &Assembly,
        effect: &'static dyn Effect,
        starts: &[Vec<f64>],
        width: usize,
        r: usize,
    ) -> Vec<(usize, Vec<f64>)> {
        let shapes = self.shapes();
        let known = self.point.fitted.coefficients.len();
        let mut found = Vec::new();
        let all: Vec<Vec<f64>> =
            starts.iter().map(|start| shapes.iter().chain(start).copied().collect()).collect();
        let jobs: Vec<(usize, &[f64])> = all.iter().map(|shapes| (r, shapes.as_slice())).collect();
        for (s, columns) in joint.columns_of(&jobs).into_iter().enumerate() {
            if effect.coefficients().is_empty() {
                let mut change = columns.measured(&self.point.fitted.coefficients);
                for (c, f) in change.iter_mut().zip(&self.point.recordings[r].force) {
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

/// The columns of one start of a law, projected.
struct Block {
    gram: DMatrix<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Largest share of a column that the projection left.
    visible: f64,
}

impl Block {
    fn new(mut gram: DMatrix<f64>, squares: &[f64], lower: Vec<f64>, upper: Vec<f64>) -> Self {
        let mut visible: f64 = 0.0;
        for (i, square) in squares.iter().enumerate() {
            let share = if *square > 0.0 { gram[(i, i)] / square } else { 0.0 };
            if share < SMALLEST_SHARE {
                gram.row_mut(i).fill(0.0);
                gram.column_mut(i).fill(0.0);
            } else {
                visible = visible.max(share);
            }
        }
        Self { gram, lower, upper, visible }
    }

    /// Squared standard deviations that the columns take off, with admissible coefficients.
    fn gain(&self, right: &DVector<f64>) -> f64 {
        if right.len() == 1 {
            let c = self.gram[(0, 0)];
            let value = right[0];
            let admissible = (value > 0.0 && self.upper[0] > 0.0) || (value < 0.0 && self.lower[0] < 0.0);
            return if c > 0.0 && admissible { value * value / c } else { 0.0 };
        }
        let c = DVector::from_vec(bounded::minimise(&self.gram, right, &self.lower, &self.upper));
        (2.0 * right.dot(&c) - c.dot(&(&self.gram * &c))).max(0.0)
    }

    /// Chance of at least this gain under the null.
    fn tail(&self, gain: f64) -> f64 {
        let freedom = (0..self.gram.nrows()).filter(|i| self.gram[(*i, *i)] > 0.0).count();
        if freedom == 0 || gain <= 0.0 {
            return 1.0;
        }
        let one_sided = freedom == 1 && (self.lower[0] == 0.0 || self.upper[0] == 0.0);
        chi_square_tail(gain, freedom) * if one_sided { 0.5 } else { 1.0 }
    }
}

/// Number of starts as far as they differ: how much more often the smallest p-value over the starts falls
/// below a level than that of one of them.
fn correction(gram: &DMatrix<f64>, blocks: &[Block], width: usize, seed: u64) -> f64 {
    if blocks.len() == 1 {
        return 1.0;
    }
    let count = gram.nrows();
    let eigen = gram.clone().symmetric_eigen();
    let root = DMatrix::from_fn(count, count, |i, j| {
        eigen.eigenvectors[(i, j)] * eigen.eigenvalues[j].max(0.0).sqrt()
    });
    let mut stream = ChaCha8Rng::seed_from_u64(seed);
    let mut below = 0;
    for _ in 0..DRAWS {
        let draw = &root * DVector::from_fn(count, |_, _| normal(&mut stream));
        let smallest = blocks
            .iter()
            .enumerate()
            .map(|(s, b)| b.tail(b.gain(&draw.rows(s * width, width).into_owned())))
            .fold(1.0, f64::min);
        below += usize::from(smallest <= LEVEL);
    }
    // A small-level number of tests is a little larger than that at the level where it is measured.
    let at_level = (below as f64 / DRAWS as f64).min(0.999);
    ((1.0 - at_level).ln() / (1.0 - LEVEL).ln() * 1.25).clamp(1.0, blocks.len() as f64)
}
