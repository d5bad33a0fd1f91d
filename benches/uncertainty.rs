//! Uncertainty of a fit of the sinh model to 1,000 samples: by tangents, by profiles, and by 10,000
//! refits of simulated repetitions, on one thread and on two.
#![allow(missing_docs)] // made by the macros of criterion

use std::hint::black_box;
use std::sync::atomic::AtomicBool;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use mre::fit::certified;
use mre::uncertainty;
use mre_bench::problem;

const LEVEL: f64 = 0.95;
const REPLICATES: usize = 10_000;

fn refits(c: &mut Criterion) {
    let Ok(problem) = problem("sinh", 1_000) else { return };
    let Ok(found) = certified::exact(&problem) else { return };
    let never = AtomicBool::new(false);
    let mut group = c.benchmark_group("uncertainty/1000");
    group.sample_size(10);
    group.bench_function("tangents", |b| {
        b.iter(|| uncertainty::estimate(black_box(&problem), &found.values, LEVEL, &never));
    });
    for threads in [1, 2] {
        let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { return };
        group.bench_function(BenchmarkId::new("profiles", threads), |b| {
            b.iter(|| pool.install(|| uncertainty::profile(&problem, &found.values, LEVEL, &never)));
        });
        group.bench_function(BenchmarkId::new("10000_refits", threads), |b| {
            let job = || uncertainty::bootstrap(&problem, &found.values, REPLICATES, LEVEL, 1, &never);
            b.iter(|| pool.install(job));
        });
    }
    group.finish();
}

criterion_group!(benches, refits);
criterion_main!(benches);
