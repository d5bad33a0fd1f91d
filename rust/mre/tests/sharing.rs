//! Candidates and looks shared among threads: the same bits as on one.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::sync::atomic::AtomicBool;

use common::{Trial, fitness, problem, with_threads};
use mre::fitness::{Problem, Weights};
use mre::swarm::{Budget, FishSettings, FishSwarm, Fitness, History, OfProblem, Search, Stream, Swarm, run};

fn example(model: &str) -> Problem {
    let trial = Trial { samples: 300, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-2, seed: 1 };
    problem(model, &[trial.recording()], &[], &Weights::Samples)
}

/// Rows of the unit box, a tenth of the coordinates on a wall.
fn unit_rows(count: usize) -> Vec<f64> {
    let mut stream = Stream::new(3, 0);
    (0..count).map(|_| (1.1 * stream.uniform() - 0.05).clamp(0.0, 1.0)).collect()
}

#[test]
fn points_of_the_box_cost_what_their_parameters_cost() {
    for model in ["sinh", "bouc_wen", "kelvin_voigt"] {
        let problem = example(model);
        let d = problem.bounds().len();
        let alone = (1..10_000).take_while(|count| problem.on_one_thread(*count)).last().unwrap();
        for count in [0, 1, 17, alone, alone + 1, 2 * alone + 63] {
            let unit = unit_rows(count * d);
            let mut rows = vec![0.0; unit.len()];
            problem.bounds().to_physical(&unit, &mut rows);
            let one_by_one: Vec<f64> = rows.chunks(d).flat_map(|row| fitness(&problem, row)).collect();
            for threads in [1, 2, 3] {
                let mut costs = vec![0.0; count];
                with_threads(threads, || {
                    problem.fitness_in_box(&unit, &mut costs, &AtomicBool::new(false));
                });
                assert_eq!(costs, one_by_one, "{model}, {count} candidates, {threads} threads");
            }
        }
    }
}

fn swarm(search: Search) -> FishSwarm {
    in_a_box_of(5, search)
}

fn in_a_box_of(dimension: usize, search: Search) -> FishSwarm {
    FishSwarm::new(FishSettings { search, ..FishSettings::mafsa(20) }, dimension, 1, None).unwrap()
}

/// Where a swarm has come to.
fn swim(mut swarm: FishSwarm, fitness: &mut dyn Fitness) -> (Vec<f64>, History) {
    let dimension = swarm.bulletin().position.len();
    run(&mut swarm, fitness, dimension, &Budget::default(), &mut |_| true);
    (swarm.bulletin().position.clone(), swarm.history().clone())
}

#[test]
fn fish_swim_the_same_on_any_number_of_threads() {
    let never = AtomicBool::new(false);
    // Both have points that threads share: by a kernel of its own, and term by term.
    for model in ["sinh", "kelvin_voigt"] {
        let problem = example(model);
        let new = |search| in_a_box_of(problem.bounds().len(), search);
        let mut one_after_the_other =
            |rows: &[f64], costs: &mut [f64]| problem.fitness_in_box(rows, costs, &never);
        for search in [Search::Best, Search::Step] {
            let drawn_first = swim(new(search), &mut one_after_the_other);
            let mut fitness = OfProblem { problem: &problem, cancel: &never };
            assert_eq!(swim(new(search), &mut fitness), drawn_first, "{model}, {search:?}, outside a pool");
            for threads in [1, 2, 3, 8] {
                let found = with_threads(threads, || swim(new(search), &mut fitness));
                assert_eq!(found, drawn_first, "{model}, {search:?}, {threads} threads");
            }
        }
    }
}

#[test]
fn what_was_broken_off_is_not_taken_for_seen() {
    let problem = example("sinh");
    let never = AtomicBool::new(false);
    let mut fitness = OfProblem { problem: &problem, cancel: &never };
    let whole = swim(swarm(Search::Best), &mut fitness);
    let mut broken = swarm(Search::Best);
    while broken.asked() < 500 {
        let mut costs = vec![0.0; broken.asked()];
        broken.ask_and_evaluate(&fitness, &mut costs);
        broken.tell(&costs);
    }
    let cancelled = OfProblem { problem: &problem, cancel: &AtomicBool::new(true) };
    let mut costs = vec![0.0; broken.asked()];
    broken.ask_and_evaluate(&cancelled, &mut costs);
    assert!(costs.iter().all(|cost| cost.is_nan()));
    broken.tell_some(&costs);
    assert_eq!(swim(broken, &mut fitness), whole);
}

#[test]
fn costs_may_be_told_without_asking_again() {
    let problem = example("sinh");
    let (mut asking, mut silent) = (swarm(Search::Best), swarm(Search::Best));
    while !asking.finished() {
        let mut costs = vec![0.0; asking.asked()];
        problem.fitness_in_box(asking.ask(), &mut costs, &AtomicBool::new(false));
        asking.tell(&costs);
        silent.tell(&costs);
    }
    assert!(silent.finished());
    assert_eq!(silent.bulletin(), asking.bulletin());
}
