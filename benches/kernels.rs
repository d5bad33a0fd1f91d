//! Fitness evaluations on one thread, reported per evaluation: each model through its problem, and the
//! two kernels beside the same mathematics in C.
#![allow(missing_docs)] // made by the macros of criterion
#![allow(clippy::print_stdout)] // the ratios to C

use std::hint::black_box;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre_bench::{candidates, problem, recording, rivals};

const SAMPLES: usize = 1_000;

fn fitness(c: &mut Criterion) {
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return };
    let never = AtomicBool::new(false);
    for model in mre::model::names() {
        let mut group = c.benchmark_group(format!("fitness/{model}"));
        group.sample_size(10);
        for samples in [1_000, 5_000, 60_000] {
            let Ok(problem) = problem(model, samples) else { continue };
            let rows = candidates(&problem, 32);
            let mut costs = vec![0.0; 32];
            group.throughput(Throughput::Elements(32));
            group.bench_function(BenchmarkId::from_parameter(samples), |b| {
                b.iter(|| pool.install(|| problem.fitness(black_box(&rows), &mut costs, &never)));
            });
        }
        group.finish();
    }
}

/// Time both in one run, turn by turn, and print how many times as fast as C the kernel is.
fn race(c: &mut Criterion, name: &str, elements: usize, mut ours: impl FnMut(), mut rival: impl FnMut()) {
    let mut group = c.benchmark_group(name);
    group.sample_size(10).throughput(Throughput::Elements(elements as u64));
    group.bench_function("mre", |b| b.iter(&mut ours));
    group.bench_function("c", |b| b.iter(&mut rival));
    group.finish();
    let time = |job: &mut dyn FnMut()| {
        let started = Instant::now();
        job();
        started.elapsed()
    };
    let (mut best, mut best_rival) = (Duration::MAX, Duration::MAX);
    for _ in 0..50 {
        best = best.min(time(&mut ours));
        best_rival = best_rival.min(time(&mut rival));
    }
    println!("{name}: {:.2} times as fast as C\n", best_rival.as_secs_f64() / best.as_secs_f64());
}

/// The direct kernel: a box this wide leaves the compressed one.
fn sinh_direct(c: &mut Criterion) {
    let wide = [("beta".to_owned(), 0.01, 40.0)];
    let made = recording(SAMPLES)
        .and_then(|r| Problem::new(vec![r], Model::named("sinh")?, &wide, &Weights::Samples));
    let Ok(problem) = made else { return };
    let arguments: Vec<f64> = (-70_000..=70_000).map(|i| 0.01 * f64::from(i)).collect();
    for (x, sinh) in arguments.iter().zip(rivals::sinh(&arguments)) {
        assert!((sinh - x.sinh()).abs() <= 4e-15 * x.sinh().abs(), "sinh {x} in C is {sinh}");
    }
    let count = 500;
    let rows: Vec<[f64; 5]> =
        (0..count).map(|i| [1.0, 12.0, 14.0, 0.2 + 0.001 * f64::from(i), 0.1]).collect();
    let (flat, recording) = (rows.as_flattened(), &problem.recordings()[0]);
    let never = AtomicBool::new(false);
    let one_thread = |rows: &[f64], costs: &mut [f64]| {
        for (row, cost) in rows.chunks_exact(5).zip(costs.chunks_exact_mut(1)) {
            problem.fitness(row, cost, &never);
        }
    };
    let (mut costs, mut rival_costs) = (vec![0.0; rows.len()], vec![0.0; rows.len()]);
    let rival = |costs: &mut [f64]| {
        for (row, cost) in rows.iter().zip(costs) {
            *cost = rivals::sinh_fitness(recording, black_box(row));
        }
    };
    one_thread(flat, &mut costs);
    rival(&mut rival_costs);
    alike(&costs, &rival_costs, 1e-11);
    race(
        c,
        "sinh_direct",
        rows.len(),
        || one_thread(black_box(flat), &mut costs),
        || rival(&mut rival_costs),
    );
}

/// Exponent n of a lane, its place given as a share of the lanes.
type Exponent = fn(f64) -> f64;

/// Candidates that need no sub-steps, which the C version does not take.
fn bouc_wen(c: &mut Criterion) {
    let Ok(problem) = problem("bouc_wen", SAMPLES) else { return };
    let lane = |i: usize| i as f64 / rivals::LANES as f64;
    let base: Vec<f64> = (1..=100_000).map(|i| 1.3e-5 * f64::from(i)).collect();
    let exponents: Vec<f64> = (0..base.len()).map(|i| 1.0 + (i % 90) as f64 / 10.0).collect();
    for ((x, n), power) in base.iter().zip(&exponents).zip(rivals::power(&base, &exponents)) {
        assert!((power - x.powf(*n)).abs() <= 1e-13 * x.powf(*n), "{x} to the {n} in C is {power}");
    }
    let exponents: [(&str, Exponent); 3] =
        [("bouc_wen", |lane| 1.1 + lane), ("bouc_wen/n=1", |_| 1.0), ("bouc_wen/n=2", |_| 2.0)];
    for (name, exponent) in exponents {
        let rows: Vec<[f64; 7]> = (0..rivals::LANES)
            .map(|i| [1.0, 10.0, 20.0, 0.2 + 0.2 * lane(i), 0.6 + 0.8 * lane(i), exponent(lane(i)), 0.1])
            .collect();
        let mut columns = [[0.0; rivals::LANES]; 7];
        for (l, row) in rows.iter().enumerate() {
            for (column, value) in columns.iter_mut().zip(row) {
                column[l] = *value;
            }
        }
        let (flat, recording) = (rows.as_flattened(), &problem.recordings()[0]);
        let over = rivals::Intervals::of(recording);
        let never = AtomicBool::new(false);
        let mut costs = [0.0; rivals::LANES];
        problem.fitness(flat, &mut costs, &never);
        // The path in C does not meet the displacement where a cubic misses it most.
        alike(&costs, &rivals::bouc_wen_fitness(recording, &over, &columns), 1e-8);
        race(
            c,
            name,
            rivals::LANES,
            || problem.fitness(black_box(flat), &mut costs, &never),
            || {
                black_box(rivals::bouc_wen_fitness(recording, &over, black_box(&columns)));
            },
        );
    }
}

/// The rivals compute the same but for this share.
fn alike(ours: &[f64], rival: &[f64], share: f64) {
    for (a, b) in ours.iter().zip(rival) {
        assert!((a - b).abs() <= share * b.abs(), "{a} here, {b} in C");
    }
}

criterion_group!(benches, sinh_direct, bouc_wen, fitness);
criterion_main!(benches);
