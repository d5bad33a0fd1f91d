//! Recordings on which the benchmarks run, and rivals.

pub mod rivals;

use std::f64::consts::TAU;
use std::sync::Arc;

use mre::error::Result;
use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre::recording::{Condition, Recording, Series};

/// A 4 mm, 1 Hz test at 256 Hz of the given length, with the parameters of the replica at 1 A.
///
/// # Errors
/// Never for at least eight samples.
pub fn recording(samples: usize) -> Result<Arc<Recording>> {
    let time: Vec<f64> = (0..samples).map(|i| i as f64 / 256.0).collect();
    let displacement: Vec<f64> = time.iter().map(|t| 4.0 * (TAU * t).sin()).collect();
    let velocity: Vec<f64> = time.iter().map(|t| 4.0 * TAU * (TAU * t).cos()).collect();
    let force = displacement
        .iter()
        .zip(&velocity)
        .enumerate()
        .map(|(i, (x, v))| {
            let ripple = (12.9898 * i as f64).sin(); // stands for noise, the same on every machine
            1.108 * v + 13.702 * x + 14.645 * (0.302 * x).sinh() + 0.5 * ripple
        })
        .collect();
    let series = Series {
        time,
        displacement,
        velocity: Some(velocity),
        force: Some(force),
        simulated: None,
        current: Condition::Constant(1.0),
        temperature: Condition::Missing,
        name: "bench".into(),
    };
    Ok(Arc::new(Recording::new(series)?))
}

/// A model on such a recording, with default bounds.
///
/// # Errors
/// A name that no model has.
pub fn problem(model: &str, samples: usize) -> Result<Problem> {
    Problem::new(vec![recording(samples)?], Model::named(model)?, &[], &Weights::Samples)
}

/// Candidates spread evenly along the diagonal of the box, one row each.
pub fn candidates(problem: &Problem, count: usize) -> Vec<f64> {
    let d = problem.bounds().len();
    let mut rows = vec![0.0; count * d];
    for (i, row) in rows.chunks_exact_mut(d).enumerate() {
        problem.bounds().to_physical(&vec![(i as f64 + 0.5) / count as f64; d], row);
    }
    rows
}
