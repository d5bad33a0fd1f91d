//! The sinh model with all samples in one triangular factor beside the direct kernel, on one thread;
//! reported per evaluation.
#![allow(missing_docs)] // made by the macros of criterion

use std::hint::black_box;
use std::sync::atomic::AtomicBool;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mre::fit::certified;
use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre_bench::{candidates, problem, recording};

fn evaluation(c: &mut Criterion) {
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(1).build() else { return };
    let never = AtomicBool::new(false);
    let mut group = c.benchmark_group("sinh");
    group.sample_size(10);
    for samples in [1_000, 10_000, 100_000, 1_000_000] {
        let Ok(compressed) = problem("sinh", samples) else { continue };
        // A box this wide leaves the compressed kernel; the candidates are the same.
        let wide = [("beta".to_owned(), 0.01, 40.0)];
        let direct = recording(samples)
            .and_then(|r| Problem::new(vec![r], Model::named("sinh")?, &wide, &Weights::Samples));
        let Ok(direct) = direct else { continue };
        for (name, problem, count) in
            [("direct", &direct, 2_000_000 / samples), ("compressed", &compressed, 2_000)]
        {
            let rows = candidates(&compressed, count);
            let mut costs = vec![0.0; count];
            group.throughput(Throughput::Elements(count as u64));
            group.bench_function(BenchmarkId::new(name, samples), |b| {
                b.iter(|| pool.install(|| problem.fitness(black_box(&rows), &mut costs, &never)));
            });
        }
        group.throughput(Throughput::Elements(samples as u64));
        group.bench_function(BenchmarkId::new("set_up", samples), |b| {
            let recordings = compressed.recordings();
            let again = || Problem::new(recordings.to_vec(), Model::named("sinh")?, &[], &Weights::Samples);
            b.iter(|| pool.install(again).is_ok());
        });
    }
    group.finish();
}

fn exact(c: &mut Criterion) {
    let Ok(problem) = problem("sinh", 1_000) else { return };
    let never = AtomicBool::new(false);
    let mut group = c.benchmark_group("exact/1000");
    group.bench_function("optimum", |b| b.iter(|| certified::exact(black_box(&problem))));
    if let Ok(found) = certified::exact(&problem) {
        group.bench_function("certificate", |b| {
            b.iter(|| certified::certificate(&problem, found.cost, 1e-9, &never).is_ok());
        });
    }
    let recordings = problem.recordings();
    group.bench_function("set_up_and_optimum", |b| {
        b.iter(|| {
            let model = Model::named("sinh")?;
            certified::exact(&Problem::new(recordings.to_vec(), model, &[], &Weights::Samples)?)
        });
    });
    group.finish();
}

criterion_group!(benches, evaluation, exact);
criterion_main!(benches);
