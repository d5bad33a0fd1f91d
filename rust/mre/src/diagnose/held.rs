//! Laws refined beside a fitted model whose tangents are held: their own shapes move, the model bends along
//! its tangents only. A hundredth of the work of a joint fit, and a good start for one.

use nalgebra::{DMatrix, DVector};

use super::bounded;
use super::null::Null;
use super::projection::Projection;
use super::screen::Score;
use super::step::{Ridge, step};

/// Step of the difference quotients, in the unit box.
const STEP: f64 = 1e-4;
/// Steps at most.
const MOST: usize = 8;
/// The search ends when a step promises less than this (in squared standard deviations).
const LEAST_GAIN: f64 = 0.02;
/// Keeps the normal equations solvable, scaled to ones on the diagonal.
const RIDGE: f64 = 1e-10;

/// A law at its best shapes.
#[derive(Clone)]
pub(super) struct Held<'s> {
    /// Its score test.
    pub(super) score: &'s Score,
    /// Shapes in their units.
    pub(super) shape: Vec<f64>,
    /// Squared standard deviations that it takes off.
    pub(super) gain: f64,
}

/// A law at some shapes: what it gains, and the Gauss-Newton step to better ones.
struct Local {
    gain: f64,
    gram: DMatrix<f64>,
    right: DVector<f64>,
}

impl Null<'_> {
    /// Refine a law from its strongest start.
    pub(super) fn held<'s>(&self, score: &'s Score) -> Held<'s> {
        let joint = self.with(score.effect);
        let base = self.shapes();
        let all: Vec<f64> = base.iter().chain(&score.start).copied().collect();
        let mut unit = joint.unit(&all).split_off(base.len());
        let of_base = joint.unit(&base);
        let physical = |unit: &[f64]| {
            let all: Vec<f64> = of_base.iter().chain(unit).copied().collect();
            joint.physical(&all).split_off(base.len())
        };
        let stay = |gain: f64| Held { score, shape: score.start.clone(), gain };
        if unit.is_empty() || self.broken_off() {
            return stay(score.gain);
        }
        let mut here = self.local(score, &unit, &physical);
        let mut damping = 1e-3;
        for _ in 0..MOST {
            if self.broken_off() {
                break;
            }
            let ridge = Ridge { coefficients: RIDGE, shapes: RIDGE + damping };
            let (step, promise) = step(&here.gram, &here.right, ridge, &unit);
            if promise < LEAST_GAIN {
                break;
            }
            let tried: Vec<f64> = unit.iter().zip(&step).map(|(u, s)| (u + s).clamp(0.0, 1.0)).collect();
            let next = self.local(score, &tried, &physical);
            if next.gain > here.gain {
                (here, unit) = (next, tried);
                damping *= 0.2;
            } else {
                damping *= 30.0;
            }
        }
        // Where the change is not proportional to a coefficient the start may be too far for its size.
        if here.gain <= 0.0 { stay(0.0) } else { Held { score, shape: physical(&unit), gain: here.gain } }
    }

    fn local(&self, score: &Score, unit: &[f64], physical: &dyn Fn(&[f64]) -> Vec<f64>) -> Local {
        let moves: Vec<f64> = unit.iter().map(|u| if u + STEP > 1.0 { -STEP } else { STEP }).collect();
        let mut shapes = vec![physical(unit)];
        for (j, step) in moves.iter().enumerate() {
            let mut moved = unit.to_vec();
            moved[j] += step;
            shapes.push(physical(&moved));
        }
        let w = score.freedom;
        let Projection { gram, right, .. } = self.project_as_they_are(w * shapes.len(), |view, r| {
            self.law_columns(view, (score.effect, w), &shapes, r)
        });
        let effect = score.effect.coefficients();
        let values = if effect.is_empty() {
            vec![1.0; w]
        } else {
            let limit = |k: usize| &effect[k % effect.len()];
            let lower: Vec<f64> = (0..w).map(|k| limit(k).smallest).collect();
            let upper: Vec<f64> = (0..w).map(|k| limit(k).largest).collect();
            let own = gram.view((0, 0), (w, w)).into_owned();
            bounded::minimise(&own, &right.rows(0, w).into_owned(), &lower, &upper)
        };
        // Columns of the linearised law: those of the coefficients, and one for each shape.
        let free = if effect.is_empty() { 0 } else { w };
        let mut basis = DMatrix::<f64>::zeros(w * shapes.len(), free + unit.len());
        let mut model = DVector::<f64>::zeros(w * shapes.len());
        // One at its limit does not move with the shapes.
        let moves_too = |k: usize| {
            effect
                .get(k % effect.len().max(1))
                .is_some_and(|p| p.smallest < values[k] && values[k] < p.largest)
        };
        for (k, value) in values.iter().enumerate() {
            model[k] = *value;
            if moves_too(k) {
                basis[(k, k)] = 1.0;
            }
            for (j, step) in moves.iter().enumerate() {
                basis[((j + 1) * w + k, free + j)] = value / step;
                basis[(k, free + j)] = -value / step;
            }
        }
        let carried = &gram * &model;
        let gain = 2.0 * right.dot(&model) - model.dot(&carried);
        Local {
            gain: if gain.is_finite() { gain } else { 0.0 },
            gram: basis.transpose() * &gram * &basis,
            right: basis.transpose() * (right - carried),
        }
    }
}
