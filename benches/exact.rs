//! The exact fit of Bouc-Wen on 1,000 simulated samples, on one thread, and how far it stays above the
//! best known optimum of a hundred of them.
#![allow(missing_docs)] // made by the macros of criterion
#![allow(clippy::print_stdout)] // the gaps

use std::f64::consts::TAU;
use std::hint::black_box;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use criterion::{Criterion, criterion_group, criterion_main};
use mre::error::Result;
use mre::fit::{exact, hybrid};
use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre::recording::{Condition, Recording, Series};
use mre::swarm::{Budget, Crowd, FishSettings, Neighbourhood, Schedule, Search, Stream};

const SAMPLES: usize = 1_000;
const RATE: f64 = 256.0;
/// Steps of the simulated truth between two samples.
const FINE: usize = 20;

/// A sine of random amplitude and frequency, a random Bouc-Wen isolator, and 1 % of noise.
fn trial(seed: u64) -> Result<Problem> {
    let mut stream = Stream::new(seed, 0);
    let mut within = |low: f64, high: f64| low + (high - low) * stream.uniform();
    let (amplitude, frequency) = (within(2.0, 8.0), TAU * within(0.7, 1.3));
    let (c0, kx, kw) = (within(0.0, 2.0), within(0.0, 20.0), within(10.0, 110.0));
    let (rho, sigma, n) = (within(0.0, 1.0), within(0.5, 1.2), within(1.0, 3.0));
    let rho = 1.2 / amplitude * 10_f64.powf(rho);
    let velocity_at = |t: f64| amplitude * frequency * (frequency * t).cos();
    let rate = |w: f64, v: f64| {
        let power = w.abs().powf(n);
        rho * (v - sigma * v.abs() * power.copysign(w) + (sigma - 1.0) * v * power)
    };
    let time: Vec<f64> = (0..SAMPLES).map(|i| i as f64 / RATE).collect();
    let displacement: Vec<f64> = time.iter().map(|t| amplitude * (frequency * t).sin()).collect();
    let (mut w, mut force) = (0.0, Vec::new());
    for (t, x) in time.iter().zip(&displacement) {
        force.push(c0 * velocity_at(*t) + kx * x + kw * w);
        let h = 1.0 / (RATE * FINE as f64);
        for step in 0..FINE {
            // The midpoint rule.
            let t = t + step as f64 * h;
            let middle = w + 0.5 * h * rate(w, velocity_at(t));
            w += h * rate(middle, velocity_at(t + 0.5 * h));
        }
    }
    let noise = 0.01 * force.iter().fold(0.0, |most: f64, f| most.max(f.abs()));
    for f in &mut force {
        // The sum of twelve uniform numbers is nearly normal.
        *f += noise * (0..12).map(|_| within(-0.5, 0.5)).sum::<f64>();
    }
    let series = Series {
        velocity: Some(time.iter().map(|t| velocity_at(*t)).collect()),
        time,
        displacement,
        force: Some(force),
        simulated: None,
        current: Condition::Missing,
        temperature: Condition::Missing,
        name: "trial".into(),
    };
    let recording = Arc::new(Recording::new(series)?);
    Problem::new(vec![recording], Model::named("bouc_wen")?, &[], &Weights::Samples)
}

/// The lowest cost that two hybrid fits find.
fn best_known(problem: &Problem) -> f64 {
    let never = AtomicBool::new(false);
    let settings = FishSettings {
        fish: 20,
        iterations: 15,
        try_number: 10,
        delta: 0.6,
        visual: 0.5,
        step: 0.25,
        schedule: Schedule::FromStart { visual_min: 0.002, step_min: 0.0003, p: 5 },
        neighbourhood: Neighbourhood::Swarm,
        crowd: Crowd::None,
        search: Search::Best,
    };
    let run = |seed| hybrid(problem, settings.clone(), seed, None, &Budget::default(), &mut |_| true, &never);
    (1..=2).filter_map(|seed| run(seed).ok()).fold(f64::INFINITY, |best, fit| best.min(fit.cost))
}

fn bouc_wen(c: &mut Criterion) {
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return };
    let never = AtomicBool::new(false);
    let Ok(problem) = trial(1) else { return };
    let mut group = c.benchmark_group("exact");
    group.sample_size(10);
    group.bench_function("bouc_wen", |b| b.iter(|| pool.install(|| exact(black_box(&problem), &never))));
    group.finish();
}

fn gaps(_: &mut Criterion) {
    let seeds = if std::env::args().any(|argument| argument == "--test") { 1 } else { 100 };
    let never = AtomicBool::new(false);
    let gap = |problem: Problem| {
        let found = exact(&problem, &never).cost;
        found / best_known(&problem).min(found) - 1.0
    };
    let gaps: Vec<f64> = (0..seeds).filter_map(|seed| trial(seed).ok()).map(gap).collect();
    let reached = gaps.iter().filter(|gap| **gap <= 1e-9).count();
    let worst = gaps.iter().copied().fold(0.0, f64::max);
    println!(
        "exact/bouc_wen: within 1e-9 of the best known for {reached} of {}, worst {worst:.1e}",
        gaps.len()
    );
}

criterion_group!(benches, bouc_wen, gaps);
criterion_main!(benches);
