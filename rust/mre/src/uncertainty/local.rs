//! A fit with what its uncertainty follows from.

use std::sync::atomic::AtomicBool;

use nalgebra::DMatrix;

use super::covariance::Tangents;
use super::noise::Noise;
use super::tangent::{force, tangents};
use crate::device::computed;
use crate::error::{Error, Result};
use crate::fitness::Problem;

/// A box narrower than this share of its larger end fixes its parameter.
const FIXED: f64 = 0.2;
/// An uncertainty that moves the force by less than this share of its rms matters little.
pub(super) const LITTLE: f64 = 0.02;

/// A fit with its tangents and its noise.
pub(super) struct Local<'a> {
    pub(super) problem: &'a Problem,
    pub(super) values: &'a [f64],
    /// Parameters that the force depends on and the box leaves free.
    pub(super) free: Vec<usize>,
    pub(super) tangents: Tangents,
    pub(super) noise: Vec<Noise>,
    cancel: &'a AtomicBool,
    /// Weighted rms of the force about its mean, N.
    pub(super) force: f64,
}

impl<'a> Local<'a> {
    pub(super) fn new(problem: &'a Problem, values: &'a [f64], cancel: &'a AtomicBool) -> Result<Self> {
        check(problem, values)?;
        let (law, model) = (problem.law(), problem.model());
        let mut residuals = Vec::new();
        let mut columns = Vec::new();
        let (mut first, mut second) = (0.0, 0.0);
        for (recording, weight) in problem.recordings().iter().zip(problem.weights()) {
            let measured = &recording.force().unwrap_or_default()[recording.scored()];
            let found = force(law, model, recording, values);
            computed(model, recording, recording.scored().start, &found)?;
            first += weight * measured.iter().sum::<f64>();
            second += weight * measured.iter().map(|f| f * f).sum::<f64>();
            residuals.push(measured.iter().zip(&found).map(|(m, f)| m - f).collect::<Vec<f64>>());
            columns.push(tangents(law, model, recording, values, cancel)?);
        }
        let free: Vec<usize> =
            (0..values.len()).filter(|j| !fixed(problem, *j) && matters(&columns, *j)).collect();
        let tangents = factor(&columns, &free, problem.weights()).ok_or_else(|| {
            let samples: usize = residuals.iter().map(Vec::len).sum();
            let text = format!("{samples} for {} parameters that can be simulated", free.len());
            Error::setting("number of samples", text, "more samples than parameters, and a finite force")
        })?;
        let rates: Vec<f64> = problem.recordings().iter().map(|r| r.sampling_rate()).collect();
        let noise = tangents.noise(&residuals, &rates, cancel)?;
        let force = (second - first * first).max(0.0).sqrt();
        Ok(Self { problem, values, free, tangents, noise, cancel, force })
    }

    /// Standard errors of the free parameters, and those that would matter little, if the same motion
    /// had another amplitude.
    pub(super) fn at_amplitude(&self, times: f64) -> Option<Vec<(f64, f64)>> {
        let (law, model) = (self.problem.law(), self.problem.model());
        let columns: Result<Vec<Vec<Vec<f64>>>> = self
            .problem
            .recordings()
            .iter()
            .map(|r| tangents(law, model, &r.scaled(times), self.values, self.cancel))
            .collect();
        let tangents = factor(&columns.ok()?, &self.free, self.problem.weights())?;
        let variances = tangents.covariance(&self.noise, self.cancel).ok()?.matrix.diagonal();
        let little = |length: &f64| LITTLE * times * self.force / length;
        Some(variances.iter().map(|v| v.sqrt()).zip(tangents.lengths().iter().map(little)).collect())
    }

    pub(super) fn correlation(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
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

fn check(problem: &Problem, values: &[f64]) -> Result<()> {
    if problem.recordings().is_empty() {
        let what = format!("{} samples streamed, none of which is kept", problem.samples());
        return Err(Error::setting("problem", what, "an uncertainty needs a problem of recordings"));
    }
    let names: Vec<&str> = problem.parameters().iter().map(|p| p.name.as_str()).collect();
    if values.len() != names.len() {
        return Err(Error::setting("number of parameters", values.len(), names.join(", ")));
    }
    match values.iter().zip(names).find(|(value, _)| !value.is_finite()) {
        Some((value, name)) => Err(Error::setting(name, value, "a finite number")),
        None => Ok(()),
    }
}

/// True where the box leaves a parameter no room.
pub(super) fn fixed(problem: &Problem, j: usize) -> bool {
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
