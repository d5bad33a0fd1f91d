//! The compressed sinh kernel against sums over the samples.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::sync::Arc;

use common::{Trial, by_the_book, fitness, problem, with_threads};
use mre::fitness::Weights;
use proptest::prelude::*;

fn trial() -> impl Strategy<Value = Trial> {
    let truth = (0.0..2.0_f64, 0.0..20.0_f64, -20.0..20.0_f64, 0.2..2.5_f64, -5.0..5.0_f64);
    let size = prop_oneof![100..3000_usize, Just(40_000)];
    (size, 0.5..20.0_f64, truth, prop_oneof![Just(1e-2), Just(1e-3)], any::<u64>()).prop_map(
        |(samples, stroke, (c0, k0, alpha, b, f0), noise, seed)| Trial {
            samples,
            stroke,
            truth: [c0, k0, alpha, b / stroke, f0],
            noise,
            seed,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]
    #[test]
    fn it_is_the_sum_over_the_samples(
        trial in trial(),
        other in trial(),
        weight in 0.1..10.0_f64,
        skip in 0..60_usize,
        unit in prop::collection::vec(prop::array::uniform5(0.0..1.0_f64), 20),
        near in 0.0..0.1_f64,
        widest in 0.5..24.0_f64,
    ) {
        let second = other.recording();
        let second = Arc::new(second.with_scored(skip..second.len() - skip / 2).unwrap());
        let farthest = second.displacement().iter().fold(trial.stroke, |far, x| x.abs().max(far));
        let beta = widest / farthest;
        let problem = problem(
            "sinh",
            &[trial.recording(), second],
            &[("beta", 0.01 * beta, beta)],
            &Weights::Given(vec![1.0, weight]),
        );
        let mut rows = Vec::new();
        for (k, unit) in unit.iter().enumerate() {
            let mut row = [0.0; 5];
            problem.bounds().to_physical(unit, &mut row);
            if k % 2 == 0 {
                row = std::array::from_fn(|i| trial.truth[i] * (1.0 + near * (unit[i] - 0.5)));
            }
            rows.extend(row);
        }
        let costs = fitness(&problem, &rows);
        for (row, cost) in rows.chunks(5).zip(&costs) {
            let wanted = by_the_book(&problem, row);
            prop_assert!((cost - wanted).abs() <= 1e-12 * wanted, "{cost} {wanted} of {row:?}");
            prop_assert_eq!(fitness(&problem, row)[0].to_bits(), cost.to_bits(), "alone and among others");
        }
    }
}

fn example(samples: usize) -> Trial {
    Trial { samples, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-3, seed: 1 }
}

/// One thousandth of noise: the share of digits that cancel is known.
#[test]
fn long_recordings_keep_their_digits() {
    let problem = problem("sinh", &[example(400_000).recording()], &[], &Weights::Samples);
    let wanted = by_the_book(&problem, &example(0).truth);
    let cost = fitness(&problem, &example(0).truth)[0];
    assert!((cost - wanted).abs() <= 1e-12 * wanted, "{cost} {wanted}");
}

#[test]
fn candidates_outside_the_box_are_evaluated_too() {
    let problem = problem("sinh", &[example(1000).recording()], &[], &Weights::Samples);
    let row = [1.0, 10.0, 0.1, 5.0, 0.0];
    let wanted = by_the_book(&problem, &row);
    assert!((fitness(&problem, &row)[0] - wanted).abs() <= 1e-13 * wanted);
    assert_eq!(fitness(&problem, &[1.0, 10.0, 0.1, 500.0, 0.0])[0], f64::INFINITY);
    assert_eq!(fitness(&problem, &[1.0, f64::NAN, 0.1, 0.3, 0.0])[0], f64::INFINITY);
}

#[test]
fn negative_beta_mirrors_alpha() {
    let problem = problem("sinh", &[example(1000).recording()], &[], &Weights::Samples);
    let costs = fitness(&problem, &[1.0, 10.0, 9.0, 0.3, 0.0, 1.0, 10.0, -9.0, -0.3, 0.0]);
    assert_eq!(costs[0].to_bits(), costs[1].to_bits());
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let recording = example(100_000).recording();
    let run = |threads| {
        with_threads(threads, || {
            let problem = problem("sinh", std::slice::from_ref(&recording), &[], &Weights::Samples);
            let mut rows = vec![0.0; 5 * 3001];
            for (k, row) in rows.chunks_mut(5).enumerate() {
                problem.bounds().to_physical(&[k as f64 / 3001.0; 5], row);
            }
            fitness(&problem, &rows)
        })
    };
    let one = run(1);
    assert!(run(2) == one && run(3) == one);
}
