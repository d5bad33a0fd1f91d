//! What a fitted model cannot express: whitened columns, projected off its tangents.

use nalgebra::{DMatrix, DVector};

use super::least_squares::Data;
use super::noise::Noise;
use super::normal::whitened;
use super::point::Point;
use crate::assembly::Assembly;
use crate::effect::{Effect, Scene};
use crate::kernel::filter::dot;
use crate::recording::Condition;

/// What may be noise of a derived motion, whitened: the force does not follow it, so that every coefficient of it is
/// possible; and every dependence of that on a current that changes.
fn noisy(assembly: &Assembly, data: Data, r: usize) -> impl Iterator<Item = Vec<f64>> {
    let recording = &assembly.campaign().recordings()[r];
    let current = match recording.current() {
        Condition::Series(current) if recording.current().varies() => Some(current),
        _ => None,
    };
    let all = assembly.campaign().doubts()[r].noisy.iter().flatten();
    let white = move |series: &[f64]| whitened(data.noise, r, &data.rows[r], series);
    all.flat_map(move |series| {
        let product = |current: &Vec<f64>| series.iter().zip(current).map(|(s, i)| s * i).collect::<Vec<_>>();
        std::iter::once(white(series)).chain(current.map(|current| white(&product(current))))
    })
}

/// Orthogonal complement of the tangents of a fitted model, by recording.
pub(super) struct Null<'a> {
    assembly: Assembly<'a>,
    data: Data<'a>,
    pub(super) point: Point,
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
        let mut point = Point::at(&assembly, data, unit.to_vec());
        let known = point.fitted.coefficients.len() + unit.len();
        let tangents: Vec<Vec<(usize, Vec<f64>)>> = point
            .tangents(&assembly, data)
            .into_iter()
            .zip(&mut point.recordings)
            .enumerate()
            .map(|(r, (own, local))| {
                let noisy = noisy(&assembly, data, r).enumerate().map(|(k, column)| (known + k, column));
                std::mem::take(&mut local.columns).into_iter().chain(own).chain(noisy).collect()
            })
            .collect();
        let last = tangents.iter().flatten().map(|(place, _)| place + 1).max();
        let count = last.unwrap_or(0).max(known);
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

    /// The noise under which columns are projected.
    pub(super) fn noise(&self) -> &Noise {
        self.data.noise
    }

    /// The model whose tangents are projected off.
    pub(super) fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
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
}
