//! A diagnosis that is broken off as a stage begins: what is known by then is whole, and nothing else is said.

#![allow(missing_docs, clippy::expect_used)]

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use mre::assembly::{Base, Campaign};
use mre::diagnose::{Blank, Diagnosis, Monitor, Settings, Stage, Verdict, blank, run};
use mre::recording::{Condition, Recording, Series};

/// Breaks off when stage number `at` begins.
struct Breaks {
    at: usize,
    begun: AtomicUsize,
    stages: Mutex<Vec<Stage>>,
}

impl Breaks {
    fn at(at: usize) -> Self {
        Self { at, begun: AtomicUsize::new(0), stages: Mutex::new(Vec::new()) }
    }

    fn stages(self) -> Vec<Stage> {
        self.stages.into_inner().expect("no thread failed")
    }
}

impl Monitor for Breaks {
    fn broken_off(&self) -> bool {
        self.begun.load(Ordering::SeqCst) > self.at
    }

    fn begins(&self, stage: Stage) {
        self.stages.lock().expect("no thread failed").push(stage);
        self.begun.fetch_add(1, Ordering::SeqCst);
    }
}

/// A Kelvin-Voigt device with a Maxwell branch and white noise.
fn recordings(branch: f64) -> Vec<Arc<Recording>> {
    let mut state = 7_u64;
    let mut noise = move || {
        let uniform = (0..12).map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        });
        0.3 * (uniform.sum::<f64>() - 6.0)
    };
    [0.3, 1.0, 3.0]
        .iter()
        .map(|f| {
            let time: Vec<f64> = (0..1200).map(|i| f64::from(i) / 100.0).collect();
            let displacement: Vec<f64> =
                time.iter().map(|t| 4.0 * (TAU * f * t).sin() * t.min(1.0)).collect();
            let velocity: Vec<f64> = time
                .iter()
                .map(|t| {
                    let growing = if *t < 1.0 { 4.0 * (TAU * f * t).sin() } else { 0.0 };
                    growing + 4.0 * TAU * f * (TAU * f * t).cos() * t.min(1.0)
                })
                .collect();
            let mut z = 0.0;
            let force = (0..time.len())
                .map(|i| {
                    z += 0.01 * (branch * velocity[i] - z / 0.4);
                    0.4 * velocity[i] + 8.0 * displacement[i] + z + noise()
                })
                .collect();
            let series = Series {
                time,
                displacement,
                velocity: Some(velocity),
                force: Some(force),
                simulated: None,
                current: Condition::Missing,
                temperature: Condition::Missing,
                name: String::new(),
            };
            Arc::new(Recording::new(series).expect("a good recording"))
        })
        .collect()
}

fn campaign(branch: f64) -> (Campaign, Base) {
    let recordings = recordings(branch);
    let base = Base::fitted(&recordings, "kelvin_voigt", &[vec![0, 1, 2]]).expect("a known model");
    (Campaign::new(recordings).expect("a good campaign"), base)
}

fn settings(base: &Base) -> Settings {
    Settings::new(0.01, 1, &[], base)
}

fn named(found: &Diagnosis) -> Vec<&'static str> {
    found.named.assembly.effects().iter().map(|e| e.about().effect).collect()
}

#[test]
fn what_is_known_when_a_stage_begins_is_found() {
    let (campaign, base) = campaign(3.0);
    let all = Breaks::at(usize::MAX);
    let whole = run(&campaign, &base, &[], &settings(&base), &all).expect("whole");
    let stages = all.stages();
    assert!(!whole.broken_off);
    assert_eq!(named(&whole), ["maxwell_relaxation"]);
    assert_eq!(whole.judgement.map(|j| j.verdict), Some(Verdict::MissingPhysics));
    let judged = stages.iter().position(|s| *s == Stage::Verdict).expect("a verdict");
    let laws = stages.iter().position(|s| *s == Stage::Laws).expect("other laws");
    for at in 0..stages.len() {
        let monitor = Breaks::at(at);
        let found = run(&campaign, &base, &[], &settings(&base), &monitor);
        assert_eq!(monitor.stages(), stages[..=at], "nothing begins after that");
        let Some(found) = found else {
            assert_eq!(stages[at], Stage::Base);
            continue;
        };
        assert!(found.broken_off && at > 0);
        assert_eq!(found.judgement.is_some(), at > judged, "{:?}", stages[at]);
        assert_eq!(named(&found).len(), usize::from(at >= laws), "{:?}", stages[at]);
        assert_eq!(found.effects.len(), named(&found).len());
        assert_eq!(found.proofs.is_some(), at > judged + 3, "{:?}", stages[at]);
        let all = found.base_estimates.coefficients.iter().chain(&found.estimates.coefficients);
        assert!(all.map(|e| e.value).all(f64::is_finite));
        assert!(found.final_force.iter().chain(&found.base_force).flatten().all(|f| f.is_finite()));
        if at > judged {
            assert_eq!(found.estimates, whole.estimates, "the model is the final one");
        }
    }
}

#[test]
fn blank_campaigns_name_little_and_are_the_same_on_any_number_of_threads() {
    let (campaign, base) = campaign(3.0);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let found = run(&campaign, &base, &[], &settings(&base), &()).expect("whole");
            blank(&found, &base, &[], &settings(&base), 6, &()).expect("a base that fits itself")
        })
    };
    let one = with(1);
    assert_eq!(one, with(3));
    // A strong Maxwell branch is missing from the base, but not from its simulations.
    assert_eq!(one, Blank { count: 6, named: 0, unexplained: 0, by_effect: Vec::new() });
}

#[test]
fn blank_campaigns_that_were_broken_off_do_not_count() {
    let (campaign, base) = campaign(0.0);
    let found = run(&campaign, &base, &[], &settings(&base), &()).expect("whole");
    let monitor = Breaks::at(1);
    let blanks =
        blank(&found, &base, &[], &settings(&base), 1000, &monitor).expect("a base that fits itself");
    let stages = monitor.stages();
    assert_eq!(stages.last(), Some(&Stage::Blank(blanks.count, 1000)));
    assert!((2..1000).contains(&blanks.count), "{}", blanks.count);
}
