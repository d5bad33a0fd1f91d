//! The exact optimum of a problem: linear coefficients by projection, the others by a search that
//! covers their whole box.

mod certificate;
mod sinh_curve;
mod sinh_exact;

use std::sync::atomic::AtomicBool;

use super::bounded::factor;
use crate::error::{Error, Result};
use crate::fitness::Problem;
use crate::kernel::sinh_compressed;
use crate::law::Law;

pub use certificate::{Certificate, certificate};
pub(super) use sinh_curve::Curve;

/// The best parameters in the box.
#[derive(Debug, Clone, PartialEq)]
pub struct Exact {
    /// Values in the order of the problem's parameters.
    pub values: Vec<f64>,
    /// Their fitness, N^2.
    pub cost: f64,
    /// Evaluations, each of all linear coefficients at once.
    pub evaluations: u64,
}

/// The global optimum of the Kelvin-Voigt or sinh model within the box of the problem.
///
/// # Errors
/// Another model, or a current that changes within a recording.
pub fn exact(problem: &Problem) -> Result<Exact> {
    Ok(match Kind::of(problem) {
        Kind::Linear => linear(problem),
        Kind::Sinh => sinh(problem),
        Kind::Other => return Err(unknown(problem)),
    })
}

/// How a problem is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// No parameter but coefficients.
    Linear,
    /// Coefficients and beta.
    Sinh,
    /// Shapes that no search covers.
    Other,
}

impl Kind {
    pub(super) fn of(problem: &Problem) -> Self {
        match (problem.model().name(), problem.law()) {
            ("kelvin_voigt", Law::Shared) => Self::Linear,
            ("sinh", Law::Shared) => Self::Sinh,
            _ => Self::Other,
        }
    }
}

/// Refuse a problem for which no certificate exists.
///
/// # Errors
/// As [`exact`].
pub fn check(problem: &Problem) -> Result<()> {
    if Kind::of(problem) == Kind::Other { Err(unknown(problem)) } else { Ok(()) }
}

/// True where [`exact`] works on the calling thread alone, and for so short a time that a thread pool would
/// take longer to start.
pub fn is_quick(problem: &Problem) -> bool {
    match Kind::of(problem) {
        Kind::Linear => problem.is_small(),
        Kind::Sinh => problem.compressed().is_some(),
        Kind::Other => false,
    }
}

/// Why a problem has no proven optimum.
fn unknown(problem: &Problem) -> Error {
    let wanted = "a proven optimum exists for kelvin_voigt and sinh only";
    match problem.law() {
        Law::Affine { .. } => {
            Error::setting("current", "changing within a recording", format!("constant: {wanted}"))
        }
        Law::Shared => Error::setting("model", format!("'{}'", problem.model().name()), wanted),
    }
}

/// The optimum of a model without shapes.
pub(super) fn linear(problem: &Problem) -> Exact {
    in_box(problem, kelvin_voigt(problem), 1)
}

/// The optimum over the whole interval of beta.
pub(super) fn sinh(problem: &Problem) -> Exact {
    let (values, evaluations) = sinh_exact::optimum(problem);
    in_box(problem, values, evaluations)
}

fn in_box(problem: &Problem, mut values: Vec<f64>, evaluations: u64) -> Exact {
    let (lower, upper) = (problem.bounds().lower(), problem.bounds().upper());
    for (i, value) in values.iter_mut().enumerate() {
        *value = value.clamp(lower[i], upper[i]);
    }
    let mut cost = [0.0];
    problem.fitness(&values, &mut cost, &AtomicBool::new(false));
    Exact { values, cost: cost[0], evaluations }
}

/// `[c0, k0, F0]`: one least-squares problem.
fn kelvin_voigt(problem: &Problem) -> Vec<f64> {
    let far = match sinh_compressed::farthest(problem.recordings()) {
        0.0 => 1.0,
        far => far,
    };
    let triangle = sinh_compressed::factor(problem.recordings(), problem.weights(), far, 1);
    let size = [1.0, 1.0, far];
    let r = std::array::from_fn(|i| std::array::from_fn(|j| triangle.at(i, j) * size[j]));
    let g = std::array::from_fn(|i| triangle.at(i, 3));
    let pick = |from: &[f64]| [from[0], from[2], from[1]];
    let bounds = problem.bounds();
    let [c0, f0, k0] = factor::minimise(&r, &g, &pick(bounds.lower()), &pick(bounds.upper()));
    vec![c0, k0, f0]
}
