//! Variable projection (Golub and Pereyra 1973, <https://doi.org/10.1137/0710036>): for given shapes the
//! best coefficients in their box are known exactly, so that only the shapes are searched.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bounded;
use super::certified::{Curve, Kind};
use crate::fitness::Problem;
use crate::kernel::LANES;
use crate::kernel::bouc_wen_gram::products;
use crate::kernel::hysteretic::stiffness;
use crate::kernel::intervals::Plan;
use crate::law::Law;

/// A problem seen as a function of its shapes alone, on the unit box.
pub(crate) struct Projection<'a> {
    pub(super) problem: &'a Problem,
    /// Places of the shapes among the parameters, and of the coefficients.
    shapes: Vec<usize>,
    pub(super) coefficients: Vec<usize>,
    /// For the simulations of Bouc-Wen, one a recording: its plan, and the products that no shape changes.
    pub(super) lanes: Vec<(Arc<Plan>, Gram)>,
    /// For the sinh model, which needs neither columns nor their products.
    curve: Option<Curve<'a>>,
    cancel: &'a AtomicBool,
}

/// Gram matrix of the columns and the force, the force last.
pub(super) type Gram = DMatrix<f64>;

impl<'a> Projection<'a> {
    pub(crate) fn new(problem: &'a Problem, cancel: &'a AtomicBool) -> Self {
        let is_shape = problem.law().shapes(problem.model());
        let places = |wanted: bool| (0..is_shape.len()).filter(|i| is_shape[*i] == wanted).collect();
        let lanes = if problem.model().name() == "bouc_wen" {
            problem.recordings().iter().map(|r| (Arc::clone(r.plan()), fixed_products(r))).collect()
        } else {
            Vec::new()
        };
        let curve = (Kind::of(problem) == Kind::Sinh).then(|| Curve::new(problem));
        Self { problem, shapes: places(true), coefficients: places(false), lanes, curve, cancel }
    }

    /// The same with cruder simulations, to choose places from.
    pub(crate) fn rough(&self) -> Self {
        Self {
            problem: self.problem,
            shapes: self.shapes.clone(),
            coefficients: self.coefficients.clone(),
            lanes: self.lanes.iter().map(|(plan, fixed)| (Arc::new(plan.rough()), fixed.clone())).collect(),
            curve: None, // only lanes have rough simulations
            cancel: self.cancel,
        }
    }

    /// Number of shapes.
    pub(crate) fn dimension(&self) -> usize {
        self.shapes.len()
    }

    /// Cost in N^2 of the best coefficients for each row of shapes in the unit box; NaN once cancelled.
    pub(crate) fn costs(&self, unit: &[f64]) -> Vec<f64> {
        let d = self.dimension();
        if d == 0 {
            return vec![self.solve(&[]).1];
        }
        let rows: Vec<Vec<f64>> = unit.chunks_exact(d).map(|row| self.physical(row)).collect();
        if !self.in_lanes() {
            let cost = |row: &Vec<f64>| if self.cancelled() { f64::NAN } else { self.candidate(row).1 };
            return rows.par_iter().map(cost).collect();
        }
        let mut order: Vec<usize> = (0..rows.len()).collect();
        // Alike shapes side by side: a block takes as long as its stiffest lane.
        let cost = |i: usize| stiffness([rows[i][3], rows[i][4], rows[i][5]]);
        order.sort_by(|a, b| cost(*a).total_cmp(&cost(*b)));
        let sorted: Vec<Vec<f64>> = order.iter().map(|i| rows[*i].clone()).collect();
        let found: Vec<f64> = sorted
            .par_chunks(LANES)
            .flat_map_iter(|block| {
                if self.cancelled() {
                    return vec![f64::NAN; block.len()];
                }
                let grams = self.lane_grams(block);
                if self.cancelled() {
                    return vec![f64::NAN; block.len()];
                }
                block.iter().zip(grams).map(|(row, gram)| self.best(row, &gram).1).collect::<Vec<_>>()
            })
            .collect();
        let mut costs = vec![f64::NAN; found.len()];
        for (i, cost) in order.into_iter().zip(found) {
            costs[i] = cost;
        }
        costs
    }

    /// True where shapes are simulated side by side.
    pub(super) fn in_lanes(&self) -> bool {
        !self.lanes.is_empty() && *self.problem.law() == Law::Shared
    }

    pub(super) fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// All parameters for shapes in the unit box, with the best coefficients, and their cost.
    pub(crate) fn solve(&self, unit: &[f64]) -> (Vec<f64>, f64) {
        self.candidate(&self.physical(unit))
    }

    /// Best coefficients for a row of shapes, put into it, and their cost.
    fn candidate(&self, row: &[f64]) -> (Vec<f64>, f64) {
        let Some(curve) = &self.curve else { return self.best(row, &self.gram(row)) };
        let point = curve.point(row[3] * curve.farthest);
        let mut parameters = curve.values(&point);
        parameters[3] = row[3]; // on its bound to the last bit
        (parameters, point.cost)
    }

    /// Shapes of given parameters in the unit box.
    pub(crate) fn unit_shapes(&self, parameters: &[f64]) -> Vec<f64> {
        let mut unit = vec![0.0; parameters.len()];
        self.problem.bounds().to_unit(parameters, &mut unit);
        self.shapes.iter().map(|i| unit[*i]).collect()
    }

    pub(super) fn physical(&self, unit: &[f64]) -> Vec<f64> {
        let bounds = self.problem.bounds();
        let mut all = vec![0.0; bounds.len()];
        for (place, u) in self.shapes.iter().zip(unit) {
            all[*place] = *u;
        }
        let mut out = vec![0.0; bounds.len()];
        bounds.to_physical(&all, &mut out);
        out
    }

    /// Best coefficients for a Gram matrix, put into a row of parameters.
    fn best(&self, row: &[f64], gram: &Gram) -> (Vec<f64>, f64) {
        let k = self.coefficients.len();
        if gram.iter().any(|g| !g.is_finite()) {
            return (row.to_vec(), f64::INFINITY);
        }
        let matrix = gram.view((0, 0), (k, k)).into_owned();
        let right = DVector::from_fn(k, |i, _| gram[(i, k)]);
        let (lower, upper) = self.box_of_coefficients();
        let found = bounded::minimise(&matrix, &right, &lower, &upper);
        let b = DVector::from_vec(found);
        let cost = (gram[(k, k)] - 2.0 * b.dot(&right) + b.dot(&(&matrix * &b))).max(0.0);
        let mut parameters = row.to_vec();
        for (place, value) in self.coefficients.iter().zip(&b) {
            parameters[*place] = *value;
        }
        (parameters, cost)
    }

    /// Lower and upper bounds of the coefficients.
    pub(super) fn box_of_coefficients(&self) -> (Vec<f64>, Vec<f64>) {
        let bounds = self.problem.bounds();
        let pick = |values: &[f64]| self.coefficients.iter().map(|i| values[*i]).collect();
        (pick(bounds.lower()), pick(bounds.upper()))
    }

    /// Gram matrix column by column: any model, any law.
    fn gram(&self, row: &[f64]) -> Gram {
        let k = self.coefficients.len();
        let mut gram = DMatrix::zeros(k + 1, k + 1);
        for (recording, weight) in self.problem.recordings().iter().zip(self.problem.weights()) {
            let mut columns = self.problem.law().columns(self.problem.model(), recording, row);
            columns.push(recording.force().unwrap_or_default().to_vec());
            let scored = recording.scored();
            for i in 0..=k {
                for j in 0..=i {
                    let (a, b) = (&columns[i][scored.clone()], &columns[j][scored.clone()]);
                    gram[(i, j)] += weight * a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
                }
            }
        }
        gram.fill_upper_triangle_with_lower_triangle();
        gram
    }

    /// Gram matrices of up to [`LANES`] Bouc-Wen candidates, simulated side by side. Columns in the order
    /// of the coefficients: v, x, w, 1.
    fn lane_grams(&self, rows: &[Vec<f64>]) -> Vec<Gram> {
        let shapes: Vec<[f64; 3]> = rows.iter().map(|row| [row[3], row[4], row[5]]).collect();
        let mut grams = vec![DMatrix::zeros(5, 5); rows.len()];
        for ((recording, (plan, fixed)), weight) in
            self.problem.recordings().iter().zip(&self.lanes).zip(self.problem.weights())
        {
            if self.cancelled() {
                break; // what there is so far means nothing
            }
            let sums = products(recording, plan, &shapes);
            for (l, gram) in grams.iter_mut().enumerate() {
                *gram += fixed * *weight;
                for (place, sum) in [(0, 0), (1, 1), (3, 2), (4, 3)] {
                    gram[(2, place)] += weight * sums[sum][l];
                    gram[(place, 2)] = gram[(2, place)];
                }
                gram[(2, 2)] += weight * sums[4][l];
            }
        }
        grams
    }
}

/// Products of v, x, 1 and F over the scored samples, in the places of [`Projection::lane_grams`].
fn fixed_products(recording: &crate::recording::Recording) -> Gram {
    let force = recording.force().unwrap_or_default();
    let mut gram = DMatrix::zeros(5, 5);
    for i in recording.scored() {
        let row = [recording.velocity()[i], recording.displacement()[i], 0.0, 1.0, force[i]];
        for a in 0..5 {
            for b in 0..5 {
                gram[(a, b)] += row[a] * row[b];
            }
        }
    }
    gram
}
