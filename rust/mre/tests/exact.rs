//! The exact optimum against brute force.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use common::{Bounds, Trial, by_the_book, fitness, problem, with_threads};
use mre::fit::certified::{Certificate, certificate, exact};
use mre::fitness::{Problem, Weights};
use mre::model::Model;
use mre::recording::{Condition, Recording, Series};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

fn example() -> Trial {
    Trial { samples: 1000, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-2, seed: 1 }
}

/// The certificate of a fitness.
fn proven(problem: &Problem, cost: f64) -> Certificate {
    certificate(problem, cost, 1e-9, &AtomicBool::new(false)).unwrap()
}

/// Least cost over a grid of beta and, at each, over all faces of the box of the linear coefficients.
fn brute_force(problem: &Problem, steps: usize) -> f64 {
    let (low, high) = (problem.bounds().lower().to_vec(), problem.bounds().upper().to_vec());
    let mut best = f64::INFINITY;
    for k in 0..=steps {
        let beta = low[3] + (high[3] - low[3]) * k as f64 / steps as f64;
        let factor = columns(problem, beta).qr().r();
        for face in 0..81_usize {
            let state: [usize; 4] = std::array::from_fn(|j| face / 3_usize.pow(j as u32) % 3);
            let free: Vec<usize> = (0..4).filter(|j| state[*j] == 0).collect();
            let mut u = [low[0], low[1], low[2], low[4]];
            for j in 0..4 {
                let bound = if state[j] == 2 { &high } else { &low };
                u[j] = bound[[0, 1, 2, 4][j]];
            }
            let mut rest = factor.column(4).into_owned();
            for j in (0..4).filter(|j| state[*j] != 0) {
                rest -= u[j] * factor.column(j);
            }
            if !free.is_empty() {
                let part = factor.select_columns(&free).qr();
                let Some(z) = part.r().solve_upper_triangular(&(part.q().transpose() * rest)) else {
                    continue;
                };
                for (j, z) in free.iter().zip(z.iter()) {
                    u[*j] = *z;
                }
            }
            let row = [u[0], u[1], u[2], beta, u[3]];
            if (0..5).all(|j| row[j] >= low[j] && row[j] <= high[j]) {
                let rest = factor.column(4) - factor.columns(0, 4) * DVector::from_row_slice(&u);
                best = best.min(rest.norm_squared());
            }
        }
    }
    best
}

/// `[v, x, sinh(beta x), 1, F]`, rows times the root of their weight.
fn columns(problem: &Problem, beta: f64) -> DMatrix<f64> {
    let mut rows = Vec::new();
    for (r, weight) in problem.recordings().iter().zip(problem.weights()) {
        for i in r.scored() {
            let (x, v, f) = (r.displacement()[i], r.velocity()[i], r.force().unwrap()[i]);
            rows.extend([v, x, f64::sinh(beta * x), 1.0, f].map(|entry| weight.sqrt() * entry));
        }
    }
    DMatrix::from_row_slice(rows.len() / 5, 5, &rows)
}

fn check(problem: &Problem, steps: usize) {
    let found = exact(problem).unwrap();
    let (low, high) = (problem.bounds().lower(), problem.bounds().upper());
    assert!((0..5).all(|j| found.values[j] >= low[j] && found.values[j] <= high[j]), "{found:?}");
    let book = by_the_book(problem, &found.values);
    assert!((found.cost - book).abs() <= 1e-11 * book, "{found:?} {book}");
    let brute = brute_force(problem, steps);
    assert!(found.cost <= brute * (1.0 + 1e-10), "{found:?} against {brute}");
}

#[test]
fn the_optimum_has_no_slope() {
    let problem = problem("sinh", &[example().recording()], &[], &Weights::Samples);
    let found = exact(&problem).unwrap();
    for j in 0..5 {
        for step in [-1e-4, 1e-4] {
            let mut row = found.values.clone();
            row[j] *= 1.0 + step;
            assert!(by_the_book(&problem, &row) > found.cost);
        }
    }
    check(&problem, 400);
}

#[test]
fn without_noise_it_is_the_truth() {
    let trial = Trial { noise: 0.0, ..example() };
    let problem = problem("sinh", &[trial.recording()], &[], &Weights::Samples);
    let found = exact(&problem).unwrap();
    for (value, truth) in found.values.iter().zip(trial.truth) {
        assert!((value / truth - 1.0).abs() < 1e-9, "{found:?}");
    }
    assert!(found.cost < 1e-24);
    assert!(proven(&problem, found.cost).certified);
}

#[test]
fn active_bounds_are_honoured() {
    let recording = [example().recording()];
    let cases: [Bounds; 8] = [
        &[("c0", 2.0, 3.0)],
        &[("k0", 0.0, 5.0)],
        &[("k0", 18.0, 30.0)],
        &[("alpha", 20.0, 60.0)],
        &[("alpha", -50.0, 0.1)],
        &[("beta", 0.4, 0.7)],
        &[("beta", 0.01, 0.2)],
        &[("c0", 0.0, 0.5), ("F0", 3.0, 4.0), ("beta", 0.01, 0.1), ("k0", 0.0, 3.0)],
    ];
    for bounds in cases {
        let problem = problem("sinh", &recording, bounds, &Weights::Samples);
        check(&problem, 200);
        let found = exact(&problem).unwrap();
        assert!(problem.bounds().on_bound(&found.values).iter().any(|side| *side != 0), "{found:?}");
        let proof = proven(&problem, found.cost);
        assert!(proof.certified, "{bounds:?} {found:?} {proof:?}");
    }
}

#[test]
fn zero_is_a_bound_of_damping_and_stiffness() {
    let trial = Trial { truth: [-0.3, -5.0, 30.0, 0.3, 0.0], ..example() };
    let problem = problem("sinh", &[trial.recording()], &[], &Weights::Samples);
    check(&problem, 200);
    let found = exact(&problem).unwrap();
    assert_eq!(found.values[0], 0.0);
    assert_eq!(found.values[1], 0.0);
}

#[test]
fn beta_up_to_overflow_is_searched_sample_by_sample() {
    let trial = Trial { samples: 300, noise: 1e-4, ..example() };
    for truth in [[1.1, 13.7, 14.6, 0.3, 1.0], [1.1, 13.7, 1e-12, 9.0, 1.0]] {
        let problem = problem(
            "sinh",
            &[Trial { truth, ..trial.clone() }.recording()],
            &[("beta", 0.05, 178.0), ("alpha", 0.0, 100.0)],
            &Weights::Samples,
        );
        let found = exact(&problem).unwrap();
        assert!((found.values[3] / truth[3] - 1.0).abs() < 0.2, "{found:?}");
        let book = by_the_book(&problem, &found.values);
        assert!((found.cost - book).abs() <= 1e-9 * book);
        assert!(found.cost <= by_the_book(&problem, &truth));
    }
    let bad = [("beta".to_owned(), 0.05, 1e6)];
    let refused =
        Problem::new(vec![trial.recording()], Model::named("sinh").unwrap(), &bad, &Weights::Samples);
    let text = refused.unwrap_err().to_string();
    assert!(
        text.starts_with("bound of beta is 0.05:1000000: at most 17") && text.contains("overflows"),
        "{text}"
    );
}

#[test]
fn what_is_not_the_optimum_is_not_certified() {
    for (model, at) in [("sinh", 2), ("kelvin_voigt", 1)] {
        let problem = problem(model, &[example().recording()], &[], &Weights::Samples);
        let found = exact(&problem).unwrap();
        let mut near = found.values.clone();
        near[at] *= 1.01;
        let cost = fitness(&problem, &near)[0];
        let proof = proven(&problem, cost);
        assert!(!proof.certified && proof.gap > 1e-6, "{proof:?}");
        assert!(proof.lower <= found.cost * (1.0 + 1e-12), "{proof:?} {found:?}");
    }
}

#[test]
fn a_tolerance_is_a_share() {
    let problem = problem("sinh", &[example().recording()], &[], &Weights::Samples);
    for wrong in [-1e-9, 0.0, 1.0, f64::NAN] {
        let error = certificate(&problem, 1.0, wrong, &AtomicBool::new(false)).unwrap_err();
        assert_eq!(error.to_string(), format!("tolerance is {wrong}: a number above 0 and below 1"));
    }
}

#[test]
fn a_certificate_needs_no_compression() {
    let trial = Trial { samples: 300, noise: 1e-3, truth: [1.1, 13.7, 1e-12, 8.0, 1.0], ..example() };
    let problem = problem("sinh", &[trial.recording()], &[("beta", 0.05, 10.0)], &Weights::Samples);
    let found = exact(&problem).unwrap();
    let proof = proven(&problem, found.cost);
    assert!(proof.certified, "{proof:?}");
}

#[test]
fn a_few_samples_are_enough() {
    for samples in [8, 12, 40] {
        let trial = Trial { samples, ..example() };
        let problem = problem("sinh", &[trial.recording()], &[], &Weights::Samples);
        check(&problem, 200);
        let found = exact(&problem).unwrap();
        assert!(proven(&problem, found.cost).certified);
    }
}

#[test]
fn kelvin_voigt_is_one_projection() {
    let problem = problem("kelvin_voigt", &[example().recording()], &[("c0", 0.0, 1.0)], &Weights::Samples);
    let found = exact(&problem).unwrap();
    assert_eq!(found.values[0], 1.0);
    for step in [-1e-3, 1e-3] {
        for j in 1..3 {
            let mut row = found.values.clone();
            row[j] += step;
            assert!(fitness(&problem, &row)[0] > found.cost);
        }
    }
    assert!(proven(&problem, found.cost).certified);
}

#[test]
fn other_problems_are_named() {
    let wrong = problem("bouc_wen", &[example().recording()], &[], &Weights::Samples);
    assert_eq!(
        exact(&wrong).unwrap_err().to_string(),
        "model is 'bouc_wen': a proven optimum exists for kelvin_voigt and sinh only"
    );
    let still = example().recording();
    let current = (0..still.len()).map(|i| if i < 500 { 0.0 } else { 2.0 }).collect();
    let series = Series {
        time: still.time().to_vec(),
        displacement: still.displacement().to_vec(),
        velocity: None,
        force: still.force().map(<[f64]>::to_vec),
        simulated: None,
        current: Condition::Series(current),
        temperature: Condition::Missing,
        name: String::new(),
    };
    let changing = Arc::new(Recording::new(series).unwrap());
    let wrong = problem("sinh", &[changing], &[], &Weights::Samples);
    let proof = certificate(&wrong, 1.0, 1e-9, &AtomicBool::new(false));
    for error in [exact(&wrong).unwrap_err(), proof.unwrap_err()] {
        assert!(error.to_string().starts_with("current is changing"));
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let recording = Trial { samples: 60_000, ..example() }.recording();
    let run = |threads| {
        with_threads(threads, || {
            let problem = problem("sinh", std::slice::from_ref(&recording), &[], &Weights::Samples);
            exact(&problem).unwrap()
        })
    };
    assert_eq!(run(1), run(3));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]
    #[test]
    fn nothing_is_better(
        truth in (-0.2..2.0_f64, -5.0..20.0_f64, -20.0..20.0_f64, 0.2..2.5_f64, -5.0..5.0_f64),
        stroke in 0.5..20.0_f64,
        noise in prop_oneof![Just(1e-3), Just(1e-2), Just(0.3)],
        seed in any::<u64>(),
        squeeze in prop::array::uniform5((0.0..0.5_f64, 0.5..1.0_f64)),
        squeezed in any::<bool>(),
        skip in 0..60_usize,
        widest in 1.0..20.0_f64,
    ) {
        let (c0, k0, alpha, b, f0) = truth;
        let trial = Trial { samples: 400, stroke, truth: [c0, k0, alpha, b / stroke, f0], noise, seed };
        let first = trial.recording();
        let second = Trial { seed: seed.wrapping_add(1), samples: 200, ..trial }.recording();
        let recordings = [Arc::new(first.with_scored(skip..400).unwrap()), second];
        let all = problem("sinh", &recordings, &[("beta", 0.0, widest / stroke)], &Weights::Force);
        let part = |j: usize| {
            let (low, high) = (all.bounds().lower()[j], all.bounds().upper()[j]);
            let at = |share| low + share * (high - low);
            if squeezed { (at(squeeze[j].0), at(squeeze[j].1)) } else { (low, high) }
        };
        let names = ["c0", "k0", "alpha", "beta", "F0"];
        let bounds: [_; 5] = std::array::from_fn(|j| (names[j], part(j).0, part(j).1));
        let problem = problem("sinh", &recordings, &bounds, &Weights::Force);
        check(&problem, 60);
        let found = exact(&problem).unwrap();
        let proof = proven(&problem, found.cost);
        prop_assert!(proof.certified, "{found:?} {proof:?}");
        prop_assert!(proof.lower <= found.cost);
    }
}
