//! What a fitted model cannot express: whitened columns, projected off its tangents.

use nalgebra::{DMatrix, DVector};

use super::heavy::Tame;
use super::least_squares::Data;
use super::noise::Noise;
use super::normal::whitened;
use super::point::Point;
use super::projection::{Projection, View};
use super::shaken::{Change, Shaken, square};
use super::strays::Strays;
use super::tangents::{products, tangents_at};
use crate::assembly::Assembly;
use crate::effect::{Effect, Scene};
use crate::kernel::filter::dot;

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
    /// The residual of a noise with heavy tails, winsorised.
    tame: Option<Tame>,
    /// What the noise of the motions does to them.
    shaken: Vec<Shaken<'a>>,
    bias: DVector<f64>,
    /// What more draws of it do to the force.
    more: Vec<Change>,
    /// Of the scaled tangents.
    strays: Strays,
    /// What whitened samples are multiplied with, by recording, where the noise's size follows the motion.
    weights: Option<Vec<Vec<f64>>>,
    /// Which coefficients a limit holds against the residual of even noise, of which the fit is the best.
    held: Vec<bool>,
}

impl<'a> Null<'a> {
    pub(super) fn new(assembly: &Assembly<'a>, data: Data<'a>, unit: &[f64]) -> Option<Self> {
        let even = Self::weighted(assembly, data, unit, None)?;
        let Some(weights) = even.weights_over_the_motion() else { return Some(even) };
        let weighted = Self::weighted(assembly, data, unit, Some((weights, &even.held)));
        Some(weighted.filter(Null::is_noise).unwrap_or(even))
    }

    fn weighted(
        assembly: &Assembly<'a>,
        data: Data<'a>,
        unit: &[f64],
        known_of_noise: Option<(Vec<Vec<f64>>, &[bool])>,
    ) -> Option<Self> {
        if data.monitor.broken_off() {
            return None;
        }
        let (weights, held) = known_of_noise.unzip();
        let assembly = assembly.knowing(&assembly.physical(unit));
        let mut point = Point::at(&assembly, data, unit.to_vec());
        let known = point.fitted.coefficients.len() + unit.len();
        let (mut shaken, mut more) = Shaken::of(&assembly, data, &point);
        let mut tangents = tangents_at(&assembly, data, &mut point, known);
        for (r, weights) in weights.iter().flatten().enumerate() {
            weigh(&mut point.recordings[r].residual, weights);
            tangents[r].iter_mut().for_each(|(_, tangent)| weigh(tangent, weights));
            let changes = shaken.iter_mut().map(Shaken::change_mut).chain(&mut more);
            changes.for_each(|change| weigh(&mut change[r], weights));
        }
        let last = tangents.iter().flatten().map(|(place, _)| place + 1).max();
        let count = last.unwrap_or(0).max(known);
        let mut gram = DMatrix::<f64>::zeros(count, count);
        let mut bias = DVector::<f64>::zeros(count);
        for other in &mut shaken {
            let mut there = other.tangents(data, known);
            for (r, weights) in weights.iter().flatten().enumerate() {
                there[r].iter_mut().for_each(|(_, tangent)| weigh(tangent, weights));
            }
            for r in 0..there.len() {
                other.add(r, &mut bias, &there[r], 1.0);
                other.add(r, &mut bias, &tangents[r], -1.0);
            }
        }
        bias /= shaken.len().max(1) as f64;
        for columns in &tangents {
            for (i, a) in columns {
                for (j, b) in columns {
                    gram[(*i, *j)] += dot(a, b);
                }
            }
        }
        let right =
            products(&tangents, point.recordings.iter().map(|local| local.residual.as_slice()), count);
        // What hides the noise is no noise.
        let known = !data.noise.hidden();
        let tame = known.then(|| Tame::of(&point.recordings, &tangents, count)).flatten();
        for (i, known) in assembly.known_of_coefficients().into_iter().enumerate() {
            gram[(i, i)] += known;
        }
        // A coefficient that a limit holds against the residual takes nothing off it.
        let held = held.map_or_else(
            || held_by_a_limit(&assembly, &point.fitted.coefficients, &right, &gram),
            <[bool]>::to_vec,
        );
        let free = |i: usize| gram[(i, i)] > 0.0 && !held.get(i).is_some_and(|held| *held);
        let scale: Vec<f64> =
            (0..count).map(|i| if free(i) { 1.0 / gram[(i, i)].sqrt() } else { 0.0 }).collect();
        let scaled = DMatrix::from_fn(count, count, |i, j| {
            let unit = if i == j { 1e-11 + f64::from(u8::from(scale[i] == 0.0)) } else { 0.0 };
            gram[(i, j)] * scale[i] * scale[j] + unit
        });
        let factor = scaled.cholesky()?;
        let draws = shaken.iter().map(Shaken::change).chain(&more);
        let mut strays = DMatrix::<f64>::zeros(count, draws.clone().count());
        for (k, change) in draws.clone().enumerate() {
            for (columns, change) in tangents.iter().zip(change) {
                for (i, a) in columns {
                    strays[(*i, k)] += dot(a, change) * scale[*i];
                }
            }
        }
        let samples: usize = point.recordings.iter().map(|local| local.residual.len()).sum();
        let squares: f64 = draws.clone().map(square).sum();
        let share = squares / (samples * draws.count()).max(1) as f64;
        let strays = Strays::new(strays, share);
        Some(Self {
            assembly,
            data,
            point,
            tangents,
            factor,
            scale,
            right,
            tame,
            shaken,
            bias,
            more,
            strays,
            weights,
            held,
        })
    }

    /// What draws of the noise of the motions do to the force.
    pub(super) fn changes(&self) -> impl Iterator<Item = &Change> {
        self.shaken.iter().map(Shaken::change).chain(&self.more)
    }

    /// The model on motions with more of their noise.
    pub(super) fn shaken_views(&self) -> impl Iterator<Item = View<'_, 'a>> {
        self.shaken.iter().map(Shaken::view)
    }

    /// What whitened samples of a recording are multiplied with, where the noise's size follows the motion.
    pub(super) fn weights(&self, r: usize) -> Option<&[f64]> {
        self.weights.as_ref().map(|all| all[r].as_slice())
    }

    /// True where the search was broken off.
    pub(super) fn broken_off(&self) -> bool {
        self.data.monitor.broken_off()
    }

    /// True where the noise has wild samples.
    pub(super) fn has_heavy_tails(&self) -> bool {
        self.tame.is_some()
    }

    /// What the model is fitted to.
    pub(super) fn data(&self) -> Data<'a> {
        self.data
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

    /// Columns projected off the tangents, with the bias of their products. `columns(view, r)` gives those of a
    /// recording with their places among `count`.
    pub(super) fn project(
        &self,
        count: usize,
        columns: impl FnMut(&View, usize) -> Vec<(usize, Vec<f64>)>,
    ) -> Projection {
        self.projected(count, columns, &self.shaken)
    }

    /// The same on the recordings as they are alone, without what motions with more noise tell of the bias.
    pub(super) fn project_as_they_are(
        &self,
        count: usize,
        columns: impl FnMut(&View, usize) -> Vec<(usize, Vec<f64>)>,
    ) -> Projection {
        self.projected(count, columns, &[])
    }

    fn projected(
        &self,
        count: usize,
        mut columns: impl FnMut(&View, usize) -> Vec<(usize, Vec<f64>)>,
        shaken: &[Shaken],
    ) -> Projection {
        let tangent_count = self.scale.len();
        let mut gram = DMatrix::<f64>::zeros(count, count);
        let mut cross = DMatrix::<f64>::zeros(tangent_count, count);
        let mut right = DVector::<f64>::zeros(count);
        let mut tame = DVector::<f64>::zeros(count);
        let mut bias = DVector::<f64>::zeros(count);
        let draws: Vec<&Change> = if shaken.is_empty() { Vec::new() } else { self.changes().collect() };
        let mut strays = DMatrix::<f64>::zeros(count, draws.len());
        let here = self.view();
        let there: Vec<View> = shaken.iter().map(Shaken::view).collect();
        let white = |r: usize, (i, series): (usize, Vec<f64>)| {
            let mut white = whitened(self.data.noise, r, &self.data.rows[r], &series);
            if let Some(weights) = self.weights(r) {
                weigh(&mut white, weights);
            }
            (i, white)
        };
        for (r, local) in self.point.recordings.iter().enumerate() {
            let own: Vec<(usize, Vec<f64>)> = columns(&here, r).into_iter().map(|c| white(r, c)).collect();
            for (n, (i, z)) in own.iter().enumerate() {
                right[*i] += dot(z, &local.residual);
                if let Some(Tame { residuals, .. }) = &self.tame {
                    tame[*i] += dot(z, &residuals[r]);
                }
                for (j, t) in &self.tangents[r] {
                    cross[(*j, *i)] += dot(t, z);
                }
                for (k, change) in draws.iter().enumerate() {
                    strays[(*i, k)] += dot(z, &change[r]);
                }
                gram[(*i, *i)] += dot(z, z);
                for (j, other) in &own[..n] {
                    let product = dot(other, z);
                    gram[(*i, *j)] += product;
                    gram[(*j, *i)] += product;
                }
            }
            for (other, there) in shaken.iter().zip(&there) {
                let there: Vec<(usize, Vec<f64>)> =
                    columns(there, r).into_iter().map(|c| white(r, c)).collect();
                other.add(r, &mut bias, &there, 1.0);
                other.add(r, &mut bias, &own, -1.0);
            }
        }
        bias /= shaken.len().max(1) as f64;
        let squares = (0..count).map(|i| gram[(i, i)]).collect();
        let scaled = DMatrix::from_fn(tangent_count, count, |j, i| cross[(j, i)] * self.scale[j]);
        let solved = self.factor.solve(&scaled).transpose();
        let of_tangents = |products: &DVector<f64>| {
            &solved * DVector::from_fn(tangent_count, |j, _| products[j] * self.scale[j])
        };
        let bias = bias - of_tangents(&self.bias);
        let right = right - of_tangents(&self.right);
        let counted = |own: &Tame| tame - of_tangents(&own.right);
        let tame = self.tame.as_ref().map_or_else(|| right.clone(), counted);
        let strays = if draws.is_empty() { Strays::none(count) } else { self.strays.beside(&solved, strays) };
        Projection { gram: gram - &solved * &scaled, right, tame, bias, squares, strays }
    }

    /// The recordings as they are.
    fn view(&self) -> View<'_, 'a> {
        View::at(&self.assembly, &self.point)
    }

    /// True for the recordings as they are.
    pub(super) fn is_own(&self, view: &View) -> bool {
        std::ptr::eq(view.assembly.campaign(), self.assembly.campaign())
    }

    /// The model with one more law.
    pub(super) fn with(&self, effect: &'static dyn Effect) -> Assembly<'a> {
        self.view().with(effect)
    }

    /// Shapes of the fitted model, in their units.
    pub(super) fn shapes(&self) -> Vec<f64> {
        self.assembly.physical(&self.point.fitted.unit)
    }
}

/// Which coefficients of the base stand at a limit that the residual would plainly have them pass: beside effects that can
/// take the place of a coefficient it may stand there and want nothing.
fn held_by_a_limit(
    assembly: &Assembly,
    coefficients: &[f64],
    right: &DVector<f64>,
    gram: &DMatrix<f64>,
) -> Vec<bool> {
    let limits = assembly.coefficients();
    let held = |i: usize| limits[i].is_pressed(coefficients[i], right[i], gram[(i, i)]);
    (0..assembly.base_coefficients()).map(held).collect()
}

fn weigh(series: &mut [f64], weights: &[f64]) {
    series.iter_mut().zip(weights).for_each(|(value, weight)| *value *= weight);
}
