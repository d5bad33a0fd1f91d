//! Descent to a local minimum of a smooth function on the unit box, by quadratic models from batches of
//! values: made for functions of a few variables whose values come cheaper side by side.

/// A quadratic model is trusted at most this far.
const FARTHEST: f64 = 0.1;
/// The search ends when the trusted distance falls below this.
const NEAREST: f64 = 1e-9;

/// A point of the unit box and its value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    pub(crate) at: Vec<f64>,
    pub(crate) value: f64,
}

/// Descend from a point. `values` takes rows of points. Returns the best point ever evaluated and the
/// number of evaluations.
pub(crate) fn descend(start: Point, radius: f64, values: &dyn Fn(&[f64]) -> Vec<f64>) -> (Point, u64) {
    let d = start.at.len();
    let mut best = start;
    let mut radius = radius.min(FARTHEST);
    let mut evaluations = 0;
    while d > 0 && radius > NEAREST {
        let spacing = 0.5 * radius;
        // Away from the walls, so that the stencil fits into the box.
        let centre: Vec<f64> = best.at.iter().map(|x| x.clamp(spacing, 1.0 - spacing)).collect();
        let stencil = stencil(&centre, spacing);
        let found = values(&stencil);
        evaluations += found.len() as u64;
        let model = Quadratic::from_values(&found, spacing, d);
        let before = best.value;
        keep_best(&mut best, &stencil, &found);
        let trials: Vec<f64> = [0.25, 1.0, 4.0]
            .iter()
            .flat_map(|s| model.minimise(&centre, (s * radius).min(FARTHEST)))
            .collect();
        let found = values(&trials);
        evaluations += found.len() as u64;
        let winner = found.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i);
        keep_best(&mut best, &trials, &found);
        let gain = before - best.value;
        radius = if found[winner] > best.value || gain <= 1e-15 * before.abs() {
            0.2 * radius
        } else {
            (radius * [0.25, 1.0, 4.0][winner]).min(FARTHEST)
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

/// `g' s + s' H s / 2` around the centre of a stencil.
struct Quadratic {
    gradient: nalgebra::DVector<f64>,
    hessian: nalgebra::DMatrix<f64>,
}

impl Quadratic {
    fn from_values(values: &[f64], h: f64, d: usize) -> Self {
        let centre = values[0];
        let along = |i: usize| (values[1 + 2 * i], values[2 + 2 * i]);
        let gradient = nalgebra::DVector::from_fn(d, |i, _| (along(i).0 - along(i).1) / (2.0 * h));
        let mut hessian = nalgebra::DMatrix::zeros(d, d);
        let mut next = 1 + 2 * d;
        for i in 0..d {
            hessian[(i, i)] = (along(i).0 + along(i).1 - 2.0 * centre) / (h * h);
            for j in 0..i {
                let both = values[next] + values[next + 1];
                next += 2;
                let single = along(i).0 + along(i).1 + along(j).0 + along(j).1;
                hessian[(i, j)] = (both - single + 2.0 * centre) / (2.0 * h * h);
                hessian[(j, i)] = hessian[(i, j)];
            }
        }
        Self { gradient, hessian }
    }

    /// Minimum within a distance (in every coordinate) of the centre and within the box, by trying every
    /// set of active walls: exact for the few variables that there are.
    fn minimise(&self, centre: &[f64], radius: f64) -> Vec<f64> {
        let d = centre.len();
        let low: Vec<f64> = centre.iter().map(|c| (-radius).max(-c)).collect();
        let high: Vec<f64> = centre.iter().map(|c| radius.min(1.0 - c)).collect();
        let mut best = (f64::INFINITY, vec![0.0; d]);
        for code in 0..3_usize.pow(d as u32) {
            let state = |i: usize| code / 3_usize.pow(i as u32) % 3;
            let mut step: Vec<f64> = (0..d).map(|i| [0.0, low[i], high[i]][state(i)]).collect();
            let open: Vec<usize> = (0..d).filter(|i| state(*i) == 0).collect();
            let matrix =
                nalgebra::DMatrix::from_fn(open.len(), open.len(), |r, c| self.hessian[(open[r], open[c])]);
            let right = nalgebra::DVector::from_fn(open.len(), |r, _| {
                let fixed: f64 =
                    (0..d).filter(|i| state(*i) != 0).map(|i| self.hessian[(open[r], i)] * step[i]).sum();
                -self.gradient[open[r]] - fixed
            });
            if !open.is_empty() {
                let Some(factor) = matrix.cholesky() else { continue };
                let solution = factor.solve(&right);
                for (r, i) in open.iter().enumerate() {
                    step[*i] = solution[r];
                }
            }
            let inside = (0..d).all(|i| step[i] >= low[i] && step[i] <= high[i]);
            let s = nalgebra::DVector::from_column_slice(&step);
            let value = self.gradient.dot(&s) + 0.5 * s.dot(&(&self.hessian * &s));
            if inside && value < best.0 {
                best = (value, step);
            }
        }
        centre.iter().zip(&best.1).map(|(c, s)| (c + s).clamp(0.0, 1.0)).collect()
    }
}
