//! One fitness evaluation of each model, on one thread; reported per evaluation.
#![allow(missing_docs)] // made by the macros of criterion

use std::hint::black_box;
use std::sync::atomic::AtomicBool;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mre_bench::{candidates, problem};

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

criterion_group!(benches, fitness);
criterion_main!(benches);
