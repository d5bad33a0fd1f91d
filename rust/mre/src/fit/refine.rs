//! The last digits of a minimum, by quadratic models through values on a stencil: simulations leave
//! ripples in the function, small but with gradients, and a stencil sees across them.

use nalgebra::{DMatrix, DVector};

use super::descent::{Point, Quadratic};

/// Distance from the minimum at which the search begins,
const FIRST: f64 = 1e-3;
/// and at which it ends.
const LAST: f64 = 1e-7;
/// Steps tried from every model, in trusted distances.
const TRIALS: [f64; 3] = [0.25, 1.0, 4.0];

/// Refine a minimum. `values` takes rows of points. Returns the best point ever evaluated and the number
/// of evaluations.
pub(crate) fn refine(start: Point, values: &dyn Fn(&[f64]) -> Vec<f64>) -> (Point, u64) {
    let mut best = start;
    let (mut radius, mut evaluations) = (FIRST, 0);
    while !best.at.is_empty() && radius > LAST {
        let spacing = 0.5 * radius;
        // Away from the walls, so that the stencil fits into the box.
        let centre: Vec<f64> = best.at.iter().map(|x| x.clamp(spacing, 1.0 - spacing)).collect();
        let stencil = stencil(&centre, spacing);
        let found = values(&stencil);
        evaluations += found.len() as u64;
        let model = Quadratic::on_stencil(centre, &found, spacing);
        let before = best.value;
        keep_best(&mut best, &stencil, &found);
        let trials: Vec<f64> =
            TRIALS.iter().flat_map(|share| model.minimise((share * radius).min(FIRST)).0).collect();
        let found = values(&trials);
        evaluations += found.len() as u64;
        let winner = found.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
        keep_best(&mut best, &trials, &found);
        let gain = before - best.value;
        radius = if found[winner] > best.value || gain <= 1e-15 * before.abs() {
            0.2 * radius
        } else {
            (radius * TRIALS[winner]).min(FIRST)
        };
    }
    (best, evaluations)
}

fn keep_best(best: &mut Point, rows: &[f64], values: &[f64]) {
    let d = best.at.len();
    for (row, value) in rows.chunks_exact(d).zip(values) {
        if *value < best.value {
            *best = Point { at: row.to_vec(), value: *value };
        }
    }
}

/// The centre, both neighbours along every axis, and along the diagonals of every pair of axes.
fn stencil(centre: &[f64], h: f64) -> Vec<f64> {
    let d = centre.len();
    let mut rows = centre.to_vec();
    let mut push = |steps: &[(usize, f64)]| {
        let mut row = centre.to_vec();
        for (axis, step) in steps {
            row[*axis] += step;
        }
        rows.extend(row);
    };
    for i in 0..d {
        push(&[(i, h)]);
        push(&[(i, -h)]);
    }
    for i in 0..d {
        for j in 0..i {
            push(&[(i, h), (j, h)]);
            push(&[(i, -h), (j, -h)]);
        }
    }
    rows
}

impl Quadratic {
    /// The model that has these values on a stencil of this spacing.
    fn on_stencil(centre: Vec<f64>, values: &[f64], h: f64) -> Self {
        let d = centre.len();
        let middle = values[0];
        let along = |i: usize| (values[1 + 2 * i], values[2 + 2 * i]);
        let gradient = DVector::from_fn(d, |i, _| (along(i).0 - along(i).1) / (2.0 * h));
        let mut hessian = DMatrix::zeros(d, d);
        let mut next = 1 + 2 * d;
        for i in 0..d {
            hessian[(i, i)] = (along(i).0 + along(i).1 - 2.0 * middle) / (h * h);
            for j in 0..i {
                let both = values[next] + values[next + 1];
                next += 2;
                let single = along(i).0 + along(i).1 + along(j).0 + along(j).1;
                hessian[(i, j)] = (both - single + 2.0 * middle) / (2.0 * h * h);
                hessian[(j, i)] = hessian[(i, j)];
            }
        }
        Self { centre, gradient, hessian }
    }
}
