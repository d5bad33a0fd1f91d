//! Gauss-Newton models of the cost around given shapes, with the best coefficients for each: the
//! residual is taken as linear in the shapes (Kaufman 1975, <https://doi.org/10.1007/BF01932995>).

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::bounded;
use super::descent::Quadratic;
use super::projection::Projection;
use crate::kernel::LANES;
use crate::kernel::bouc_wen_gram::traces;

/// Difference of shapes for derivatives, in the unit box.
const DIFFERENCE: f64 = 1e-6;

impl Projection<'_> {
    /// Models around each row of shapes in the unit box; flat once cancelled.
    pub(crate) fn models(&self, centres: &[f64]) -> Vec<Quadratic> {
        let d = self.dimension();
        let force = self.force();
        centres
            .par_chunks(d * (LANES / (d + 1)).max(1))
            .flat_map_iter(|centres| {
                if self.cancelled() {
                    return centres.chunks_exact(d).map(Quadratic::flat).collect::<Vec<_>>();
                }
                let rows: Vec<Vec<f64>> = centres
                    .chunks_exact(d)
                    .flat_map(neighbours)
                    .map(|neighbour| self.physical(&neighbour))
                    .collect();
                let columns = if self.in_lanes() { self.lane_columns(&rows) } else { self.columns(&rows) };
                let around = centres.chunks_exact(d).zip(columns.chunks_exact(d + 1));
                around.map(|(centre, columns)| self.model(centre, columns, &force)).collect()
            })
            .collect()
    }

    /// The model from the columns at the centre and at its neighbours.
    fn model(&self, centre: &[f64], columns: &[DMatrix<f64>], force: &DVector<f64>) -> Quadratic {
        let (here, beside) = (&columns[0], &columns[1..]);
        let (lower, upper) = self.box_of_coefficients();
        let found = bounded::minimise(&here.tr_mul(here), &here.tr_mul(force), &lower, &upper);
        let b = DVector::from_vec(found);
        let residual = force - here * &b;
        let mut slopes = DMatrix::zeros(force.len(), beside.len());
        for (i, columns) in beside.iter().enumerate() {
            slopes.set_column(i, &((columns - here) * &b / step(centre[i])));
        }
        // What free coefficients make up for does not count.
        let free: Vec<usize> = (0..b.len()).filter(|i| lower[*i] < b[*i] && b[*i] < upper[*i]).collect();
        let basis = here.select_columns(&free).qr().q();
        slopes -= &basis * basis.tr_mul(&slopes);
        Quadratic {
            centre: centre.to_vec(),
            gradient: slopes.tr_mul(&residual) * -2.0,
            hessian: slopes.tr_mul(&slopes) * 2.0,
        }
    }

    /// All scored samples of all recordings below each other, times the root of their weight.
    fn force(&self) -> DVector<f64> {
        let (problem, mut all) = (self.problem, Vec::new());
        for (recording, weight) in problem.recordings().iter().zip(problem.weights()) {
            let force = &recording.force().unwrap_or_default()[recording.scored()];
            all.extend(force.iter().map(|f| weight.sqrt() * f));
        }
        DVector::from_vec(all)
    }

    /// The columns of the coefficients for every row of parameters: any model, any law.
    fn columns(&self, rows: &[Vec<f64>]) -> Vec<DMatrix<f64>> {
        let (problem, k) = (self.problem, self.coefficients.len());
        let stacked = |row: &Vec<f64>| {
            let mut columns = vec![Vec::new(); k];
            for (recording, weight) in problem.recordings().iter().zip(problem.weights()) {
                let more = problem.law().columns(problem.model(), recording, row);
                for (column, more) in columns.iter_mut().zip(more) {
                    column.extend(more[recording.scored()].iter().map(|value| weight.sqrt() * value));
                }
            }
            DMatrix::from_vec(columns.first().map_or(0, Vec::len), k, columns.concat())
        };
        rows.iter().map(stacked).collect()
    }

    /// The same for up to [`LANES`] Bouc-Wen candidates, simulated side by side: v, x, w, 1.
    fn lane_columns(&self, rows: &[Vec<f64>]) -> Vec<DMatrix<f64>> {
        let shapes: Vec<[f64; 3]> = rows.iter().map(|row| [row[3], row[4], row[5]]).collect();
        let problem = self.problem;
        let samples = problem.recordings().iter().map(|r| r.scored().len()).sum();
        let mut all = vec![DMatrix::zeros(samples, 4); rows.len()];
        let mut first = 0;
        for ((recording, (plan, _)), weight) in
            problem.recordings().iter().zip(&self.lanes).zip(problem.weights())
        {
            let w = traces(recording, plan, &shapes, 4);
            let (v, x, scored) = (recording.velocity(), recording.displacement(), recording.scored());
            let scale = weight.sqrt();
            for (l, matrix) in all.iter_mut().enumerate() {
                for (row, i) in (first..).zip(scored.clone()) {
                    let values = [v[i], x[i], w[i][l], 1.0];
                    for (column, value) in values.into_iter().enumerate() {
                        matrix[(row, column)] = scale * value;
                    }
                }
            }
            first += scored.len();
        }
        all
    }
}

/// A point, and its neighbour along each axis.
fn neighbours(centre: &[f64]) -> Vec<Vec<f64>> {
    let mut points = vec![centre.to_vec(); centre.len() + 1];
    for (i, u) in centre.iter().enumerate() {
        points[i + 1][i] += step(*u);
    }
    points
}

/// Step to the neighbour: away from the nearer wall.
fn step(u: f64) -> f64 {
    if u > 0.5 { -DIFFERENCE } else { DIFFERENCE }
}
