//! Joint least squares of an assembly on whitened data: coefficients exactly, shapes by Gauss-Newton
//! steps in the unit box (variable projection, Golub and Pereyra 1973, in the form of Ruhe and Wedin 1980).

use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::{Normal, Rows};
use super::point::Point;
use super::step::{Ridge, step};
use crate::assembly::Assembly;
use crate::parameter::Parameter;

/// Steps at most.
const MOST: usize = 25;
/// The search ends when a step gains less than this (in squared standard deviations).
const LEAST_GAIN: f64 = 1e-2;
/// What a parameter costs in the criterion of Akaike.
pub(super) const AKAIKE: f64 = 2.0;

/// An assembly with fitted parameters.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// Shapes in the unit box.
    pub unit: Vec<f64>,
    /// Linear coefficients.
    pub coefficients: Vec<f64>,
    /// Whitened sum of squares left.
    pub left: f64,
    /// Rows it is summed over.
    pub rows: usize,
}

impl Fitted {
    /// Number of parameters.
    pub(super) fn parameters(&self) -> usize {
        self.coefficients.len() + self.unit.len()
    }

    /// Whitened criterion of Akaike, up to a constant: what is left more than parameters take by chance.
    pub(super) fn beyond_chance(&self) -> f64 {
        self.left + AKAIKE * self.parameters() as f64
    }

    /// What the parameters that another has not cost in the Bayesian information criterion beyond Akaike's.
    pub(super) fn spared(&self, other: &Self) -> f64 {
        self.parameters().saturating_sub(other.parameters()) as f64 * (self.price() - AKAIKE)
    }

    /// What a parameter costs in the Bayesian information criterion.
    pub(super) fn price(&self) -> f64 {
        (self.rows as f64).ln()
    }

    /// Whitened Bayesian information criterion, up to a constant.
    pub(super) fn criterion(&self) -> f64 {
        self.left + self.parameters() as f64 * self.price()
    }
}

/// What a fit is made on.
#[derive(Clone, Copy)]
pub(super) struct Data<'a> {
    /// Noise of the recordings.
    pub(super) noise: &'a Noise,
    /// Samples that count, by recording.
    pub(super) rows: &'a [Rows],
    /// Whether to go on.
    pub(super) monitor: &'a dyn Monitor,
}

/// Descend from a point of the unit box.
pub(super) fn refine(assembly: &Assembly, data: Data, start: &[f64]) -> Fitted {
    refine_at_most(assembly, data, start, MOST)
}

/// Descend with a limited number of steps.
pub(super) fn refine_at_most(assembly: &Assembly, data: Data, start: &[f64], most: usize) -> Fitted {
    let first = Point::at(assembly, data, start.to_vec());
    let mut here = first.fitted.clone();
    if start.is_empty() {
        return here;
    }
    let limits = assembly.coefficients();
    let mut damping = 1e-3;
    let mut ahead = Some(first);
    let mut system = Normal::zeros(0);
    for _ in 0..most {
        if data.monitor.broken_off() {
            break;
        }
        if let Some(point) = ahead.take() {
            system = point.with_tangents(assembly, data);
            hold(&mut system, &limits, &here.coefficients);
        }
        let ridge = Ridge { coefficients: 1e-12, shapes: damping };
        let (step, promise) = step(&system.gram, &system.right, ridge, &here.unit);
        if promise < LEAST_GAIN {
            break;
        }
        let unit: Vec<f64> =
            here.unit.iter().zip(step.iter()).map(|(u, s)| (u + s).clamp(0.0, 1.0)).collect();
        let next = Point::at(assembly, data, unit);
        let gain = here.left - next.fitted.left;
        if gain > 0.0 {
            here = next.fitted.clone();
            damping = (damping * 0.2).max(1e-7);
            if gain < LEAST_GAIN {
                break;
            }
            ahead = Some(next);
        } else {
            damping *= 20.0;
            if damping > 1e4 {
                break;
            }
        }
    }
    here
}

/// Coefficients at a limit stay there while the shapes move: let go, they would take the shapes where they cannot follow.
fn hold(system: &mut Normal, limits: &[Parameter], coefficients: &[f64]) {
    for (i, (limit, value)) in limits.iter().zip(coefficients).enumerate() {
        if *value <= limit.smallest || *value >= limit.largest {
            system.gram[(i, i)] = 0.0;
        }
    }
}
