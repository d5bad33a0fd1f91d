//! Descents to local minima of a smooth function on the unit box, side by side, by quadratic models: made
//! for functions of a few variables whose values come cheaper in batches.

use nalgebra::{DMatrix, DVector};

/// A quadratic model is trusted at most this far.
const FARTHEST: f64 = 0.1;
/// A descent ends when the trusted distance falls below this,
const NEAREST: f64 = 1e-6;
/// or when the model promises no larger share of the value than this.
const GAIN: f64 = 1e-9;
/// Two descents this near to each other go to the same minimum.
const SAME: f64 = 1e-3;
/// Steps tried from every model, in trusted distances.
const TRIALS: [f64; 4] = [0.0625, 0.25, 1.0, 4.0];

/// A point of the unit box and its value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    pub(crate) at: Vec<f64>,
    pub(crate) value: f64,
}

/// One descent under way.
struct Descent {
    best: Point,
    radius: f64,
}

/// The best point that descents from several points come to, and the number of trials. `models` and
/// `values` take rows of points.
///
/// A descent that comes near a better one is given up.
pub(crate) fn descend(
    starts: Vec<Point>,
    radius: f64,
    models: &dyn Fn(&[f64]) -> Vec<Quadratic>,
    values: &dyn Fn(&[f64]) -> Vec<f64>,
) -> (Option<Point>, u64) {
    let mut under_way: Vec<Descent> =
        starts.into_iter().map(|best| Descent { best, radius: radius.min(FARTHEST) }).collect();
    let (mut ended, mut evaluations) = (Vec::new(), 0);
    while !under_way.is_empty() {
        let centres: Vec<f64> = under_way.iter().flat_map(|descent| descent.best.at.clone()).collect();
        let (mut steps, mut gains) = (Vec::new(), Vec::new());
        for (descent, model) in under_way.iter().zip(models(&centres)) {
            let wished = TRIALS.map(|share| model.minimise((share * descent.radius).min(FARTHEST)));
            gains.push(wished[TRIALS.len() - 1].1);
            steps.extend(wished.into_iter().flat_map(|(at, _)| at));
        }
        let found = values(&steps);
        evaluations += found.len() as u64;
        let trials = steps.chunks_exact(steps.len() / under_way.len()).zip(found.chunks_exact(TRIALS.len()));
        let mut going: Vec<Descent> = Vec::new();
        for ((mut descent, (steps, found)), gain) in under_way.into_iter().zip(trials).zip(gains) {
            descent.take_best(steps, found);
            if descent.radius > NEAREST && gain > GAIN * descent.best.value {
                going.push(descent);
            } else {
                ended.push(descent.best);
            }
        }
        under_way = apart(going, &ended);
    }
    (ended.into_iter().min_by(|a, b| a.value.total_cmp(&b.value)), evaluations)
}

impl Descent {
    /// Go to the best of the trials, if it is better, and trust the model as far as that was.
    fn take_best(&mut self, steps: &[f64], found: &[f64]) {
        let winner = (0..found.len()).min_by(|a, b| found[*a].total_cmp(&found[*b])).unwrap_or(0);
        if found[winner] < self.best.value {
            let d = self.best.at.len();
            self.best = Point { at: steps[winner * d..(winner + 1) * d].to_vec(), value: found[winner] };
            self.radius = (self.radius * TRIALS[winner]).min(FARTHEST);
        } else {
            self.radius *= 0.5 * TRIALS[0];
        }
    }
}

/// The descents that are not near a better one.
fn apart(descents: Vec<Descent>, ended: &[Point]) -> Vec<Descent> {
    let places: Vec<Point> = descents.iter().map(|d| d.best.clone()).collect();
    let given_up = |own: usize| {
        let better = |other: &Point| {
            other.value <= places[own].value
                && other.at.iter().zip(&places[own].at).all(|(a, b)| (a - b).abs() < SAME)
        };
        let earlier = |i: usize| i < own || places[i].value < places[own].value;
        ended.iter().any(better) || (0..places.len()).any(|i| i != own && earlier(i) && better(&places[i]))
    };
    descents.into_iter().enumerate().filter(|(own, _)| !given_up(*own)).map(|(_, descent)| descent).collect()
}

/// `g' s + s' H s / 2` for steps s from the centre.
pub(crate) struct Quadratic {
    pub(super) centre: Vec<f64>,
    pub(super) gradient: DVector<f64>,
    pub(super) hessian: DMatrix<f64>,
}

impl Quadratic {
    /// A model that promises nothing.
    pub(super) fn flat(centre: &[f64]) -> Self {
        let d = centre.len();
        Self { centre: centre.to_vec(), gradient: DVector::zeros(d), hessian: DMatrix::zeros(d, d) }
    }

    /// Minimum within a distance (in every coordinate) of the centre and within the box, and the gain
    /// expected there; by trying every set of active walls: exact for the few variables that there are.
    pub(super) fn minimise(&self, radius: f64) -> (Vec<f64>, f64) {
        let (centre, d) = (&self.centre, self.centre.len());
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
        (centre.iter().zip(&best.1).map(|(c, s)| (c + s).clamp(0.0, 1.0)).collect(), -best.0)
    }
}
