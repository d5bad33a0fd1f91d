//! One iteration of MAFSA with the paper's settings on 1,000 samples, on all cores.
#![allow(missing_docs)] // made by the macros of criterion

use std::sync::atomic::AtomicBool;

use criterion::{Criterion, criterion_group, criterion_main};
use mre::swarm::{Budget, Crowd, FishSettings, FishSwarm, Neighbourhood, Schedule, Search, run};
use mre_bench::problem;

fn iteration(c: &mut Criterion) {
    let never = AtomicBool::new(false);
    for model in ["sinh", "bouc_wen"] {
        let Ok(problem) = problem(model, 1_000) else { continue };
        let d = problem.bounds().len();
        let settings = FishSettings {
            fish: 50,
            iterations: 1,
            try_number: 50,
            delta: 0.6,
            visual: 0.5,
            step: 0.25,
            schedule: Schedule::FromStart { visual_min: 0.002, step_min: 0.0003, p: 5 },
            neighbourhood: Neighbourhood::Swarm,
            crowd: Crowd::Literal,
            search: Search::Best,
        };
        c.bench_function(&format!("mafsa_iteration/{model}"), |b| {
            b.iter(|| {
                let Ok(mut swarm) = FishSwarm::new(settings.clone(), d, 1, None) else { return };
                let mut physical = Vec::new();
                let mut evaluate = |unit: &[f64], costs: &mut [f64]| {
                    physical.resize(unit.len(), 0.0);
                    problem.bounds().to_physical(unit, &mut physical);
                    problem.fitness(&physical, costs, &never);
                };
                run(&mut swarm, &mut evaluate, d, &Budget::default(), &mut |_| true);
            });
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = iteration
}
criterion_main!(benches);
