//! How well the parameters of a fit are determined: intervals that respect correlated residuals, the
//! combinations that are determined better than single parameters, and what is not determined in words.
//!
//! [`estimate`] takes the curvature at the optimum; [`profile`] follows the cost itself, and
//! [`bootstrap`] fits simulated repetitions of the recordings.

mod bootstrap;
mod covariance;
mod derived;
mod noise;
mod profile;
mod student;
mod tangent;
mod words;

use nalgebra::{DMatrix, DVector};

use crate::error::{Error, Result};
use crate::fitness::Problem;
use covariance::{Covariance, Tangents};
use derived::Derived;
use noise::Noise;
use tangent::{difference, force, tangents};

pub use bootstrap::{Bootstrap, bootstrap};
pub use derived::Cycle;
pub use profile::{Profile, profile};

/// A box narrower than this share of its larger end fixes its parameter.
const FIXED: f64 = 0.2;
/// An uncertainty that moves the force by less than this share of its rms matters little.
const LITTLE: f64 = 0.02;
/// Correlation with a parameter that is not determined above which another is not either: the line on
/// which both can move is straight only nearby.
const TIED: f64 = 0.9;

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
    /// [`Self::determined`], and for a parameter on a bound that is no physical limit.
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
    /// Combinations, and the steady cycle at [`Cycle`].
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
/// A level outside (0, 1), values that cannot be simulated, or fewer samples than parameters.
pub fn estimate(problem: &Problem, values: &[f64], level: f64) -> Result<Uncertainty> {
    check_level(level)?;
    let local = Local::new(problem, values)?;
    let covariance = local.tangents.covariance(&local.noise);
    let derived = Derived::new(problem)?;
    let correlation = local.correlation(&covariance.matrix);
    let parameters = parameters(&local, &covariance, &correlation, level);
    let derived = combine(&local, &covariance, &derived, level);
    let cycle = Cycle::of(problem);
    let words = words::words(&local, &parameters, &derived, cycle);
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

/// A fit with its tangents and its noise.
struct Local<'a> {
    problem: &'a Problem,
    values: &'a [f64],
    /// Parameters that the force depends on and the box leaves free.
    free: Vec<usize>,
    tangents: Tangents,
    noise: Vec<Noise>,
    /// Weighted rms of the force about its mean, N.
    force: f64,
}

impl<'a> Local<'a> {
    fn new(problem: &'a Problem, values: &'a [f64]) -> Result<Self> {
        let (law, model) = (problem.law(), problem.model());
        let mut residuals = Vec::new();
        let mut columns = Vec::new();
        let (mut first, mut second) = (0.0, 0.0);
        for (recording, weight) in problem.recordings().iter().zip(problem.weights()) {
            let measured = &recording.force().unwrap_or_default()[recording.scored()];
            let found = force(law, model, recording, values);
            first += weight * measured.iter().sum::<f64>();
            second += weight * measured.iter().map(|f| f * f).sum::<f64>();
            residuals.push(measured.iter().zip(&found).map(|(m, f)| m - f).collect::<Vec<f64>>());
            columns.push(tangents(law, model, recording, values));
        }
        let free: Vec<usize> =
            (0..values.len()).filter(|j| !fixed(problem, *j) && matters(&columns, *j)).collect();
        let tangents = factor(&columns, &free, problem.weights()).ok_or_else(|| {
            let samples: usize = residuals.iter().map(Vec::len).sum();
            let text = format!("{samples} for {} parameters that can be simulated", free.len());
            Error::setting("number of samples", text, "more samples than parameters, and a finite force")
        })?;
        let rates: Vec<f64> = problem.recordings().iter().map(|r| r.sampling_rate()).collect();
        let noise = tangents.noise(&residuals, &rates);
        Ok(Self { problem, values, free, tangents, noise, force: (second - first * first).max(0.0).sqrt() })
    }

    /// Standard errors of the free parameters, and those that would matter little, if the same motion
    /// had another amplitude.
    fn at_amplitude(&self, times: f64) -> Option<Vec<(f64, f64)>> {
        let (law, model) = (self.problem.law(), self.problem.model());
        let columns: Vec<Vec<Vec<f64>>> = self
            .problem
            .recordings()
            .iter()
            .map(|r| tangents(law, model, &r.scaled(times), self.values))
            .collect();
        let tangents = factor(&columns, &self.free, self.problem.weights())?;
        let variances = tangents.covariance(&self.noise).matrix.diagonal();
        let little = |length: &f64| LITTLE * times * self.force / length;
        Some(variances.iter().map(|v| v.sqrt()).zip(tangents.lengths().iter().map(little)).collect())
    }

    fn correlation(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
        let d = self.values.len();
        let mut out = vec![0.0; d * d];
        for i in 0..d {
            out[i * d + i] = 1.0;
        }
        for (a, i) in self.free.iter().enumerate() {
            for (b, j) in self.free.iter().enumerate().filter(|(b, _)| *b != a) {
                let scale = (covariance[(a, a)] * covariance[(b, b)]).sqrt();
                let share = if scale > 0.0 { covariance[(a, b)] / scale } else { 0.0 };
                out[i * d + j] = share.clamp(-1.0, 1.0);
            }
        }
        out
    }
}

/// True where the box leaves a parameter no room.
fn fixed(problem: &Problem, j: usize) -> bool {
    let (low, high) = (problem.bounds().lower()[j], problem.bounds().upper()[j]);
    high - low < FIXED * low.abs().max(high.abs())
}

/// True where the force depends on a parameter.
fn matters(columns: &[Vec<Vec<f64>>], j: usize) -> bool {
    columns.iter().any(|recording| recording[j].iter().any(|value| *value != 0.0))
}

fn factor(columns: &[Vec<Vec<f64>>], free: &[usize], weights: &[f64]) -> Option<Tangents> {
    let picked: Vec<Vec<&[f64]>> =
        columns.iter().map(|c| free.iter().map(|j| c[*j].as_slice()).collect()).collect();
    Tangents::new(&picked, weights)
}

fn parameters(local: &Local<'_>, covariance: &Covariance, correlation: &[f64], level: f64) -> Vec<Estimate> {
    let (problem, values, d) = (local.problem, local.values, local.values.len());
    // Standard error, half of the interval, and whether they are small, of every free parameter.
    let mut spreads = vec![None; d];
    for (place, &j) in local.free.iter().enumerate() {
        let unit = DVector::from_fn(local.free.len(), |i, _| if i == place { 1.0 } else { 0.0 });
        let (error, reach) = spread(covariance, &unit, level);
        let little = LITTLE * local.force / local.tangents.lengths()[place];
        let p = &problem.parameters()[j];
        let small = (reach < values[j].abs() || error < little) && 2.0 * reach < p.upper - p.lower;
        spreads[j] = Some((error, reach, small));
    }
    let loose: Vec<bool> =
        (0..d).map(|j| spreads[j].map_or_else(|| !fixed(problem, j), |(_, _, small)| !small)).collect();
    let tied = |j: usize| (0..d).any(|i| loose[i] && correlation[j * d + i].abs() > TIED);
    let sides = problem.bounds().on_bound(values);
    (0..d)
        .map(|j| {
            let (p, value) = (&problem.parameters()[j], values[j]);
            let determined = !loose[j] && !tied(j);
            let at_box = (sides[j] < 0 && p.lower > p.smallest) || (sides[j] > 0 && p.upper < p.largest);
            let shown = spreads[j].filter(|_| determined && !at_box);
            Estimate {
                name: p.name.clone(),
                unit: p.unit,
                value,
                standard_error: spreads[j].map(|(error, ..)| error),
                interval: shown
                    .map(|(_, reach, _)| ((value - reach).max(p.smallest), (value + reach).min(p.largest))),
                determined,
            }
        })
        .collect()
}

/// Standard error of a combination, and half of its interval.
fn spread(covariance: &Covariance, combination: &DVector<f64>, level: f64) -> (f64, f64) {
    let (variance, freedom) = covariance.of(combination);
    let error = variance.max(0.0).sqrt();
    (error, error * student::two_sided(level, freedom))
}

/// Derived quantities by the delta method.
fn combine(local: &Local<'_>, covariance: &Covariance, derived: &Derived<'_>, level: f64) -> Vec<Estimate> {
    let values = derived.values(local.values);
    let bounds = local.problem.bounds();
    let slopes: Vec<Vec<f64>> = local
        .free
        .iter()
        .map(|&j| {
            let room = bounds.upper()[j] - bounds.lower()[j];
            let size = local.values[j].abs().max(0.01 * room);
            difference(local.values, j, size, |moved| derived.values(moved))
        })
        .collect();
    let names = derived.names(local.values).into_iter().zip(values).enumerate();
    names
        .map(|(k, ((name, unit), value))| {
            let slope = DVector::from_fn(local.free.len(), |i, _| slopes[i][k]);
            let (error, reach) = spread(covariance, &slope, level);
            let determined = reach < value.abs();
            let interval = Some((value - reach, value + reach));
            Estimate { name, unit, value, standard_error: Some(error), interval, determined }
        })
        .collect()
}
