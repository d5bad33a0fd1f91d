//! The exact optimum of a problem: linear coefficients by projection, the others by a search that
//! covers their whole box.

mod certificate;
mod projection;
mod sinh_curve;
mod sinh_exact;

use std::sync::atomic::AtomicBool;

use crate::error::{Error, Result};
use crate::fitness::Problem;
use crate::kernel::sinh_compressed;
use crate::law::Law;

pub use certificate::{Certificate, certificate};

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
/// Another model, a current that changes within a recording, or a box in which sinh overflows.
pub fn exact(problem: &Problem) -> Result<Exact> {
    let (mut values, evaluations) = match Kind::of(problem)? {
        Kind::Linear => (kelvin_voigt(problem), 1),
        Kind::Sinh => sinh_exact::optimum(problem)?,
    };
    let (lower, upper) = (problem.bounds().lower(), problem.bounds().upper());
    for (i, value) in values.iter_mut().enumerate() {
        *value = value.clamp(lower[i], upper[i]);
    }
    let mut cost = [0.0];
    problem.fitness(&values, &mut cost, &AtomicBool::new(false));
    Ok(Exact { values, cost: cost[0], evaluations })
}

/// How a problem is solved.
enum Kind {
    /// No parameter but coefficients.
    Linear,
    /// Coefficients and beta.
    Sinh,
}

impl Kind {
    fn of(problem: &Problem) -> Result<Self> {
        let wanted = "the exact optimum is known for kelvin_voigt and sinh";
        match (problem.model().name(), problem.law()) {
            (_, Law::Affine { .. }) => {
                Err(Error::setting("current", "changing within a recording", format!("constant: {wanted}")))
            }
            ("kelvin_voigt", _) => Ok(Self::Linear),
            ("sinh", _) => Ok(Self::Sinh),
            (other, _) => Err(Error::setting("model", format!("'{other}'"), wanted)),
        }
    }
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
    let [c0, f0, k0] = projection::bounded(&r, &g, &pick(bounds.lower()), &pick(bounds.upper()));
    vec![c0, k0, f0]
}
