//! Recordings with a known truth.
#![allow(dead_code, unreachable_pub, missing_docs, clippy::unwrap_used)]

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre::recording::{Condition, Recording, Series};

/// How a recording is made.
#[derive(Debug, Clone)]
pub struct Trial {
    pub samples: usize,
    pub stroke: f64,
    /// c0, k0, alpha, beta, F0.
    pub truth: [f64; 5],
    /// Standard deviation as a share of the largest force.
    pub noise: f64,
    pub seed: u64,
}

impl Trial {
    /// Two tones, and the force of the sinh model with white noise.
    pub fn recording(&self) -> Arc<Recording> {
        let time: Vec<f64> = (0..self.samples).map(|i| i as f64 / 200.0).collect();
        let mut state = self.seed.wrapping_mul(2).wrapping_add(1);
        let mut uniform = || {
            // splitmix64
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
        };
        let tones = [(0.7 * self.stroke, 6.3), (0.3 * self.stroke, 15.0 + 5.0 * uniform())];
        let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f64> {
            time.iter().map(|t| tones.iter().map(|(a, w)| f(*a, *w, *t)).sum()).collect()
        };
        let displacement = sum(&|a, w, t| a * (w * t).sin());
        let velocity = sum(&|a, w, t| a * w * (w * t).cos());
        let [c0, k0, alpha, beta, f0] = self.truth;
        let clean = displacement.iter().zip(&velocity);
        let mut force: Vec<f64> =
            clean.map(|(x, v)| c0 * v + k0 * x + alpha * (beta * x).sinh() + f0).collect();
        let largest = force.iter().fold(0.0, |m: f64, f| f.abs().max(m));
        for f in &mut force {
            let (a, b) = (1.0 - uniform(), uniform());
            *f += self.noise * largest * (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos();
        }
        let series = Series {
            time,
            displacement,
            velocity: Some(velocity),
            force: Some(force),
            simulated: None,
            current: Condition::Constant(1.0),
            temperature: Condition::Missing,
            name: "two tones".into(),
        };
        Arc::new(Recording::new(series).unwrap())
    }
}

/// Bounds by name.
pub type Bounds<'a> = &'a [(&'a str, f64, f64)];

/// A problem with some bounds of its own.
pub fn problem(model: &str, recordings: &[Arc<Recording>], bounds: Bounds, weights: &Weights) -> Problem {
    let bounds: Vec<_> = bounds.iter().map(|(name, low, high)| ((*name).to_owned(), *low, *high)).collect();
    Problem::new(recordings.to_vec(), Model::named(model).unwrap(), &bounds, weights).unwrap()
}

/// Fitness of rows.
pub fn fitness(problem: &Problem, rows: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; rows.len() / problem.bounds().len()];
    problem.fitness(rows, &mut out, &AtomicBool::new(false));
    out
}

/// Eq. 5 with weights, by the book.
pub fn by_the_book(problem: &Problem, row: &[f64]) -> f64 {
    let [c0, k0, alpha, beta, f0] = [row[0], row[1], row[2], row[3], row[4]];
    let each = problem.recordings().iter().zip(problem.weights()).map(|(r, weight)| {
        let (x, v, f) = (r.displacement(), r.velocity(), r.force().unwrap());
        let error = |i| c0 * v[i] + k0 * x[i] + alpha * f64::sinh(beta * x[i]) + f0 - f[i];
        weight * r.scored().map(|i| error(i) * error(i)).sum::<f64>()
    });
    each.sum()
}

/// In a pool of that many threads.
pub fn with_threads<T: Send>(threads: usize, job: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(job)
}
