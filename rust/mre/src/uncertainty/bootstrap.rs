//! Bootstrap: the recordings are simulated anew with noise like theirs, and fitted again.
//!
//! Noise that is like theirs is made of moving blocks: the residuals are whitened by their
//! autoregression, blocks of what is left are drawn at random, and coloured again (post-blackening,
//! Davison and Hinkley 1997, <https://doi.org/10.1017/CBO9780511802843>, section 8.2.3). So short
//! blocks suffice for noise with a long memory.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::check_level;
use super::derived::Derived;
use super::local::Local;
use super::noise::Noise;
use super::tangent::force;
use crate::error::{Error, Result};
use crate::fit::refit;
use crate::fitness::Problem;
use crate::swarm::Stream;

/// Most replicates.
const MOST: usize = 1_000_000;

/// What refits of simulated recordings gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Bootstrap {
    /// Parameters, then derived quantities that can be computed: name and unit.
    pub names: Vec<(String, &'static str)>,
    /// Number of parameters among them.
    pub parameters: usize,
    /// One row a replicate.
    pub rows: Vec<f64>,
    /// Percentile interval of every column.
    pub intervals: Vec<(f64, f64)>,
    /// Samples of a block, one number a recording.
    pub blocks: Vec<usize>,
}

/// Fit `replicates` simulated repetitions of the recordings, each from its own stream of the seed.
///
/// Parameters are kept in the box of the problem. After `cancel` is set it ends soon, with rows of
/// the original values.
///
/// # Errors
/// As [`super::estimate`], and fewer than two replicates.
pub fn bootstrap(
    problem: &Problem,
    values: &[f64],
    replicates: usize,
    level: f64,
    seed: u64,
    cancel: &AtomicBool,
) -> Result<Bootstrap> {
    check_level(level)?;
    if !(2..=MOST).contains(&replicates) {
        return Err(Error::setting("replicates", replicates, format!("a whole number from 2 to {MOST}")));
    }
    let local = Local::new(problem, values, cancel)?;
    let derived = Derived::new(problem);
    let sources: Vec<Source> = (0..problem.recordings().len()).map(|r| Source::new(&local, r)).collect();
    let rows: Result<Vec<Vec<f64>>> = (0..replicates)
        .into_par_iter()
        .map(|i| {
            let mut found = values.to_vec();
            if !cancel.load(Ordering::Relaxed) {
                let mut stream = Stream::new(seed, i);
                let forces = sources.iter().map(|source| source.force(&mut stream)).collect();
                found = refit(&problem.with_forces(forces)?, values, cancel);
            }
            let more = derived.values(&found);
            found.extend(more);
            Ok(found)
        })
        .collect();
    let mut rows = rows?;
    let mut names: Vec<(String, &'static str)> =
        problem.parameters().iter().map(|p| (p.name.clone(), p.unit)).collect();
    names.extend(derived.names(values));
    let known: Vec<bool> =
        (0..names.len()).map(|j| j < values.len() || rows.iter().all(|row| row[j].is_finite())).collect();
    names = picked(names, &known);
    rows = rows.into_iter().map(|row| picked(row, &known)).collect();
    let intervals =
        (0..names.len()).map(|j| percentiles(rows.iter().map(|row| row[j]).collect(), level)).collect();
    Ok(Bootstrap {
        names,
        parameters: values.len(),
        rows: rows.concat(),
        intervals,
        blocks: sources.iter().map(|source| source.block).collect(),
    })
}

/// Columns that could be computed in every replicate.
fn picked<T>(row: Vec<T>, known: &[bool]) -> Vec<T> {
    row.into_iter().zip(known).filter_map(|(value, known)| known.then_some(value)).collect()
}

/// Ends between which the middle share of the values lies, by linear interpolation.
fn percentiles(mut values: Vec<f64>, level: f64) -> (f64, f64) {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * (values.len() - 1) as f64;
        let (low, high) = (values[place.floor() as usize], values[place.ceil() as usize]);
        low + (high - low) * place.fract()
    };
    (at(0.5 - 0.5 * level), at(0.5 + 0.5 * level))
}

/// Makes forces like that of one recording.
struct Source<'a> {
    noise: &'a Noise,
    /// Whitened residuals about their mean, as large as the innovations of the noise.
    innovations: Vec<f64>,
    block: usize,
    /// Force of the fit over all samples, of which these are scored.
    fitted: Vec<f64>,
    scored: std::ops::Range<usize>,
}

impl<'a> Source<'a> {
    fn new(local: &'a Local<'_>, r: usize) -> Self {
        let (problem, noise) = (local.problem, &local.noise[r]);
        let recording = &problem.recordings()[r];
        let scored = recording.scored();
        let fitted = force(problem.law(), problem.model(), recording, local.values);
        let measured = &recording.force().unwrap_or_default()[scored.clone()];
        let residual: Vec<f64> = measured.iter().zip(&fitted).map(|(m, f)| m - f).collect();
        let order = noise.phi.len();
        let mut innovations: Vec<f64> =
            (order..residual.len()).map(|t| residual[t] - noise.recall(&residual, t)).collect();
        let n = innovations.len() as f64;
        let mean = innovations.iter().sum::<f64>() / n;
        let square = innovations.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / n;
        let scale = if square > 0.0 { (noise.variance / square).sqrt() } else { 0.0 };
        for a in &mut innovations {
            *a = scale * (*a - mean);
        }
        let mut whole = recording.force().unwrap_or_default().to_vec();
        whole[scored.clone()].copy_from_slice(&fitted);
        Self { noise, innovations, block: n.cbrt().round().max(1.0) as usize, fitted: whole, scored }
    }

    /// The force of the fit with noise.
    fn force(&self, stream: &mut Stream) -> Vec<f64> {
        // As many samples again go before the first, so that the noise starts anywhere.
        let warm_up = if self.noise.phi.is_empty() { 0 } else { self.scored.len() };
        let wanted = warm_up + self.scored.len();
        let starts = self.innovations.len() - self.block + 1;
        let mut noise: Vec<f64> = Vec::with_capacity(wanted);
        while noise.len() < wanted {
            let start = (stream.uniform() * starts as f64) as usize;
            for a in self.innovations[start..start + self.block].iter().take(wanted - noise.len()) {
                let t = noise.len();
                noise.push(a + self.noise.recall(&noise, t));
            }
        }
        let mut force = self.fitted.clone();
        for (f, e) in force[self.scored.clone()].iter_mut().zip(&noise[warm_up..]) {
            *f += e;
        }
        force
    }
}
