//! Samples that pass by once against the same ones in memory.
#![allow(missing_docs, clippy::unwrap_used)]

mod common;

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use common::{Bounds, Trial, fitness, problem, with_threads};
use mre::error::Error;
use mre::fit::certified::{certificate, exact};
use mre::fit::{self, hybrid};
use mre::fitness::{Problem, Stream, Weights};
use mre::recording::Recording;
use mre::swarm::{Budget, FishSettings};
use mre::uncertainty::{bootstrap, estimate, profile};

fn recording(samples: usize) -> Arc<Recording> {
    Trial { samples, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-2, seed: 1 }.recording()
}

fn farthest(recording: &Recording) -> f64 {
    recording.displacement().iter().fold(0.0, |far: f64, x| far.max(x.abs()))
}

fn streamed(recording: &Recording, chunk: usize, bounds: Bounds) -> Problem {
    let bounds: Vec<_> = bounds.iter().map(|(name, low, high)| ((*name).to_owned(), *low, *high)).collect();
    let mut stream = Stream::new(farthest(recording), &bounds).unwrap();
    for first in (0..recording.len()).step_by(chunk) {
        let part = first..(first + chunk).min(recording.len());
        let force = &recording.force().unwrap()[part.clone()];
        stream.absorb(&recording.displacement()[part.clone()], &recording.velocity()[part], force).unwrap();
    }
    stream.into_problem().unwrap()
}

/// Rows spread over the box.
fn rows(problem: &Problem) -> Vec<f64> {
    let d = problem.bounds().len();
    let unit: Vec<f64> =
        (0..20 * d).map(|i| (0.5 + 0.618 * i as f64 + 0.1 * (i / d) as f64).fract()).collect();
    let mut rows = vec![0.0; unit.len()];
    problem.bounds().to_physical(&unit, &mut rows);
    rows
}

fn alike(a: &[f64], b: &[f64], share: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() <= share * a.abs().max(1e-3), "{a} {b}");
    }
}

#[test]
fn it_equals_the_problem_in_memory() {
    let recording = recording(50_000);
    for bounds in [&[][..], &[("beta", 0.1, 5.0)], &[("k0", 0.0, 9.0), ("alpha", -30.0, 10.0)]] {
        let whole = problem("sinh", std::slice::from_ref(&recording), bounds, &Weights::Samples);
        let stream = streamed(&recording, 7_777, bounds);
        assert_eq!(stream.samples(), 50_000);
        assert!(stream.recordings().is_empty());
        alike(whole.bounds().lower(), stream.bounds().lower(), 1e-12);
        alike(whole.bounds().upper(), stream.bounds().upper(), 1e-12);
        let rows = rows(&whole);
        alike(&fitness(&whole, &rows), &fitness(&stream, &rows), 1e-12);
        let (one, other) = (exact(&whole).unwrap(), exact(&stream).unwrap());
        alike(&[one.cost], &[other.cost], 1e-12);
        alike(&one.values, &other.values, 1e-6); // where the fitness is flat
        assert!(certificate(&stream, other.cost, 1e-9, &AtomicBool::new(false)).unwrap().certified);
    }
}

#[test]
fn chunks_and_threads_do_not_matter() {
    let recording = recording(30_000);
    let bits = |chunk, threads| {
        with_threads(threads, || {
            let problem = streamed(&recording, chunk, &[]);
            let rows = rows(&problem);
            fitness(&problem, &rows)
        })
    };
    let one = bits(30_000, 1);
    for (chunk, threads) in [(1, 1), (999, 3), (30_000, 2)] {
        assert_eq!(one, bits(chunk, threads));
    }
}

#[test]
fn more_samples_than_a_batch() {
    let recording = recording(1_100_000);
    let whole = problem("sinh", std::slice::from_ref(&recording), &[], &Weights::Samples);
    let stream = streamed(&recording, 300_000, &[]);
    let rows = rows(&whole);
    alike(&fitness(&whole, &rows), &fitness(&stream, &rows), 1e-12);
}

#[test]
fn a_wider_range_is_as_good() {
    let recording = recording(5_000);
    let mut stream = Stream::new(1.7 * farthest(&recording), &[]).unwrap();
    let force = recording.force().unwrap();
    stream.absorb(recording.displacement(), recording.velocity(), force).unwrap();
    let stream = stream.into_problem().unwrap();
    let (low, high) = (stream.bounds().lower()[3], stream.bounds().upper()[3]);
    let whole = problem("sinh", std::slice::from_ref(&recording), &[("beta", low, high)], &Weights::Samples);
    let rows = rows(&stream);
    alike(&fitness(&whole, &rows), &fitness(&stream, &rows), 1e-12);
}

#[test]
fn the_hybrid_needs_no_samples() {
    let problem = streamed(&recording(5_000), 1_000, &[]);
    let settings = FishSettings { fish: 8, try_number: 8, ..FishSettings::mafsa(8) };
    let never = AtomicBool::new(false);
    let found = hybrid(&problem, settings, 1, None, &Budget::default(), &mut |_| true, &never).unwrap();
    let best = fit::exact(&problem, &never);
    assert!(found.cost <= best.cost * (1.0 + 1e-9), "{found:?} {best:?}");
}

#[test]
fn an_uncertainty_needs_samples() {
    let recording = recording(5_000);
    let problem = streamed(&recording, 1_000, &[]);
    let (never, x) = (AtomicBool::new(false), exact(&problem).unwrap().values);
    let wanted = "problem is 5000 samples streamed, none of which is kept: \
                  an uncertainty needs a problem of recordings";
    assert_eq!(estimate(&problem, &x, 0.95, &never).unwrap_err().to_string(), wanted);
    assert_eq!(profile(&problem, &x, 0.95, &never).unwrap_err().to_string(), wanted);
    assert_eq!(bootstrap(&problem, &x, 10, 0.95, 1, &never).unwrap_err().to_string(), wanted);
    let whole = common::problem("sinh", std::slice::from_ref(&recording), &[], &Weights::Samples);
    assert_eq!(estimate(&whole, &x, 0.95, &never).unwrap().parameters.len(), 5);
}

#[test]
fn an_uncertainty_is_stopped() {
    let whole = common::problem("sinh", &[recording(5_000)], &[], &Weights::Samples);
    let (now, x) = (AtomicBool::new(true), exact(&whole).unwrap().values);
    assert_eq!(estimate(&whole, &x, 0.95, &now).unwrap_err(), Error::Stopped);
    assert_eq!(profile(&whole, &x, 0.95, &now).unwrap_err(), Error::Stopped);
    assert_eq!(bootstrap(&whole, &x, 10, 0.95, 1, &now).unwrap_err(), Error::Stopped);
}

#[test]
fn outside_its_box_it_is_infinite() {
    let problem = streamed(&recording(100), 30, &[]);
    let beyond = 1.01 * problem.bounds().upper()[3];
    assert_eq!(fitness(&problem, &[1.0, 1.0, 1.0, beyond, 0.0]), [f64::INFINITY]);
}

#[test]
fn what_cannot_be_is_said() {
    let text = |far, beta| match Stream::new(far, &[("beta".to_owned(), 0.1, beta)]) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    };
    assert_eq!(text(0.0, 1.0), "largest_displacement is 0.0: a positive number of mm, from 1e-30 to 1e30");
    assert_eq!(
        text(f64::NAN, 1.0),
        "largest_displacement is NaN: a positive number of mm, from 1e-30 to 1e30"
    );
    assert_eq!(text(4.0, 0.01), "bound of beta is 0.1:0.01: the lower bound has to be below the upper one");
    assert_eq!(
        text(4.0, 8.0),
        "upper bound of beta is 8: at most 6.25 1/mm: above it every sample has to be kept"
    );
    let refused = |x: &[f64], v: &[f64], f: &[f64]| {
        let mut stream = Stream::new(2.0, &[]).unwrap();
        stream.absorb(&[0.0, 1.0], &[0.0, 1.0], &[0.0, 1.0]).unwrap();
        match stream.absorb(x, v, f) {
            Ok(()) => stream.into_problem().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        }
    };
    assert_eq!(
        refused(&[0.0, 3.0], &[0.0; 2], &[0.0; 2]),
        "chunk 1: displacement at sample 1 is 3: within the largest_displacement of 2 mm"
    );
    assert_eq!(
        refused(&[0.0], &[0.0; 2], &[0.0]),
        "chunk 1: number of samples of velocity is 2: 1, as displacement"
    );
    assert!(refused(&[0.0], &[f64::NAN], &[0.0]).starts_with("chunk 1: velocity is NaN at sample 0"));
    assert_eq!(refused(&[], &[], &[]), "2 samples: at least 8 are needed");
    let still = |x: f64, v: f64, f: f64| {
        let mut stream = Stream::new(2.0, &[]).unwrap();
        let displacement: Vec<f64> = (0..9).map(|i| x * f64::from(i % 2)).collect();
        stream.absorb(&displacement, &[v; 9], &[f; 9]).unwrap();
        stream.into_problem().unwrap_err().to_string()
    };
    assert!(still(0.0, 1.0, 1.0).starts_with("displacement is 0 mm throughout"));
    assert!(still(1.0, 0.0, 1.0).starts_with("velocity is zero throughout"));
    assert!(still(1.0, 1.0, 0.0).starts_with("the force is zero throughout"));
}
