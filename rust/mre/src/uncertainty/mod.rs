//! How well the parameters of a fit are determined: intervals that respect correlated residuals, the
//! combinations that are determined better than single parameters, and what is not determined in words.
//!
//! [`estimate`] takes the curvature at the optimum; [`profile`] follows the cost itself, and
//! [`bootstrap`] fits simulated repetitions of the recordings.

mod bootstrap;
mod covariance;
mod derived;
mod estimates;
mod levinson;
mod local;
mod noise;
mod products;
mod profile;
mod student;
mod tangent;
mod words;

use std::sync::atomic::AtomicBool;

use crate::error::{Error, Result};
use crate::fitness::Problem;
use derived::Derived;
use estimates::{combinations, parameters};
use local::Local;

pub use bootstrap::{Bootstrap, bootstrap};
pub use derived::Cycle;
pub use products::{Products, products};
pub use profile::{Profile, profile};

/// A quantity with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Name of the parameter or of the combination.
    pub name: String,
    /// Unit; empty for a pure number.
    pub unit: &'static str,
    /// Value at the fit.
    pub value: f64,
    /// Standard error; `None` where the recordings say nothing, or the box fixes the parameter.
    pub standard_error: Option<f64>,
    /// Interval within the admissible values; `None` where an interval would pretend: see
    /// [`Self::determined`], for a parameter on a bound that is no physical limit, and for a derived
    /// quantity that is not determined to within what makes up the whole force.
    pub interval: Option<(f64, f64)>,
    /// False where the interval reaches zero (unless a standard error of the parameter hardly moves the
    /// force); for a parameter also where it is wider than the box, or tied to such a one.
    pub determined: bool,
}

/// How well a fit is determined.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    /// Probability with which an interval is to hold the truth.
    pub level: f64,
    /// The problem's parameters.
    pub parameters: Vec<Estimate>,
    /// Combinations, and the steady cycle at [`Cycle`]; without what cannot be computed.
    pub derived: Vec<Estimate>,
    /// Correlation matrix of the parameters, row by row; a parameter without standard error is
    /// correlated with none.
    pub correlation: Vec<f64>,
    /// Of the tangents with columns of unit length.
    pub condition_number: f64,
    /// The cycle of the derived quantities.
    pub cycle: Cycle,
    /// What is not determined, and what would determine it; empty where everything is.
    pub words: Vec<String>,
}

/// Uncertainty of a fit, by the tangents at its values (the optimum, or near it).
///
/// Confidence intervals by Student's t around the values, from the sandwich covariance of weighted
/// least squares under noise that is an autoregression in each recording.
///
/// # Errors
/// A level outside (0, 1), values that cannot be simulated, fewer samples than parameters, a problem
/// whose samples were streamed (the noise follows from residuals that it does not have), or
/// [`Error::Stopped`] soon after `cancel` is set.
pub fn estimate(problem: &Problem, values: &[f64], level: f64, cancel: &AtomicBool) -> Result<Uncertainty> {
    check_level(level)?;
    let local = Local::new(problem, values, cancel)?;
    let covariance = local.tangents.covariance(&local.noise, cancel)?;
    let derived = Derived::new(problem);
    let correlation = local.correlation(&covariance.matrix);
    let parameters = parameters(&local, &covariance, &correlation, level);
    let derived = combinations(&local, &covariance, &derived, level);
    let cycle = Cycle::of(problem);
    Error::if_stopped(cancel)?;
    let words = words::words(&local, &parameters, &derived, cycle);
    Error::if_stopped(cancel)?;
    Ok(Uncertainty {
        level,
        correlation,
        condition_number: local.tangents.condition_number(),
        parameters,
        derived,
        cycle,
        words,
    })
}

fn check_level(level: f64) -> Result<()> {
    if level > 0.0 && level < 1.0 {
        return Ok(());
    }
    Err(Error::setting("level", level, "a probability between 0 and 1, such as 0.95"))
}
