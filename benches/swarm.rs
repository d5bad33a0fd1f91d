//! MAFSA with the paper's settings on 1,000 samples, on one and two threads: one iteration of each model, and
//! the whole run with the sinh model.
#![allow(missing_docs)] // made by the macros of criterion

use std::sync::atomic::AtomicBool;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use mre::fitness::Problem;
use mre::swarm::{Budget, FishSettings, FishSwarm, OfProblem, awake, run};
use mre_bench::problem;

fn mafsa(problem: &Problem, iterations: usize) {
    let d = problem.bounds().len();
    let Ok(mut swarm) = FishSwarm::new(FishSettings::mafsa(iterations), d, 1, None) else { return };
    let never = AtomicBool::new(false);
    let mut fitness = OfProblem { problem, cancel: &never };
    run(&mut swarm, &mut fitness, d, &Budget::default(), &mut |_| true);
}

/// A model's swarm of some iterations on one and two threads.
fn on_threads(c: &mut Criterion, name: &str, model: &str, iterations: usize) {
    let Ok(problem) = problem(model, 1_000) else { return };
    let mut group = c.benchmark_group(format!("{name}/{model}/threads"));
    for threads in [1, 2] {
        let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else { continue };
        group.bench_function(BenchmarkId::from_parameter(threads), |b| {
            b.iter(|| pool.install(|| awake(|| mafsa(&problem, iterations))));
        });
    }
    group.finish();
}

fn iteration(c: &mut Criterion) {
    on_threads(c, "mafsa_iteration", "sinh", 1);
    on_threads(c, "mafsa_iteration", "bouc_wen", 1);
}

fn whole(c: &mut Criterion) {
    on_threads(c, "mafsa_run", "sinh", 300);
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = iteration, whole
}
criterion_main!(benches);
