//! Small work stays on the calling thread: outside a pool rayon would start its global one, which does not
//! survive a fork. Alone in its process, so that no other test starts that pool.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::sync::atomic::AtomicBool;

use common::{Trial, fitness, problem, with_threads};
use mre::fit::{certified, exact};
use mre::fitness::Weights;
use mre::swarm::{Budget, FishSettings, FishSwarm, Schedule, run};

#[test]
fn small_work_starts_no_pool() {
    let trial =
        Trial { samples: 1000, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-2, seed: 1 };
    let recording = with_threads(1, || trial.recording());
    for (model, bounds) in [
        ("sinh", vec![]),
        ("sinh", vec![("beta", 0.01, 40.0)]),
        ("bouc_wen", vec![]),
        ("kelvin_voigt", vec![]),
    ] {
        let problem = problem(model, std::slice::from_ref(&recording), &bounds, &Weights::Samples);
        if certified::is_quick(&problem) {
            exact(&problem, &AtomicBool::new(false));
        }
        let most = (1..10_000).take_while(|count| problem.on_one_thread(*count)).last().unwrap();
        fitness(&problem, &problem.bounds().upper().repeat(most));
    }
    let settings = FishSettings { schedule: Schedule::Constant, ..FishSettings::mafsa(2) };
    let mut swarm = FishSwarm::new(settings, 5, 1, None).unwrap();
    let mut bowl = |rows: &[f64], costs: &mut [f64]| {
        for (row, cost) in rows.chunks_exact(5).zip(costs) {
            *cost = row.iter().map(|x| x * x).sum();
        }
    };
    run(&mut swarm, &mut bowl, 5, &Budget::default(), &mut |_| true);
    let unused = rayon::ThreadPoolBuilder::new().num_threads(1).build_global();
    assert!(unused.is_ok(), "something has started the global pool");
}
