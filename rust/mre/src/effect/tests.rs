//! Laws against closed forms, and what every law has to keep.

mod channels;
mod columns;
mod every_law;
mod friction;
mod softening;
mod steady;

use std::f64::consts::TAU;
use std::sync::OnceLock;

use super::{Acceleration, Effect, Scene, Sizes, named};
use crate::recording::{Condition, Past, Recording, Series};

/// A recording with everything that a scene needs.
struct Stage {
    recording: Recording,
    acceleration: OnceLock<Vec<f64>>,
    current: Option<Vec<f64>>,
    temperature: Vec<f64>,
    force: Vec<f64>,
    sizes: Sizes,
}

impl Stage {
    fn new(time: Vec<f64>, motion: impl Fn(f64) -> (f64, f64), current: Option<Vec<f64>>) -> Self {
        let displacement: Vec<f64> = time.iter().map(|t| motion(*t).0).collect();
        let velocity: Vec<f64> = time.iter().map(|t| motion(*t).1).collect();
        let force: Vec<f64> = displacement.iter().zip(&velocity).map(|(x, v)| 5.0 * x + 0.3 * v).collect();
        let temperature: Vec<f64> = time.iter().map(|t| 20.0 + 3.0 * t).collect();
        let recording = Recording::new(Series {
            time,
            displacement,
            velocity: Some(velocity),
            force: Some(force.clone()),
            simulated: None,
            current: current.clone().map_or(Condition::Missing, Condition::Series),
            temperature: Condition::Series(temperature.clone()),
            name: "test".into(),
        })
        .expect("valid series");
        let sizes = Sizes::of(std::iter::once(&recording));
        Self { recording, acceleration: OnceLock::new(), current, temperature, force, sizes }
    }

    /// `amplitude * sin(2 pi f t)` at 1000 Hz.
    fn sine(amplitude: f64, frequency: f64, duration: f64) -> Self {
        let w = TAU * frequency;
        Self::new(grid(1e-3, duration), |t| (amplitude * (w * t).sin(), amplitude * w * (w * t).cos()), None)
    }

    fn scene(&self) -> Scene<'_> {
        Scene {
            time: self.recording.time(),
            displacement: self.recording.displacement(),
            velocity: self.recording.velocity(),
            acceleration: Acceleration { recording: &self.recording, known: &self.acceleration },
            current: self.current.as_deref(),
            temperature: Some(&self.temperature),
            force: &self.force,
            whole: &self.force,
            fading: &[],
            before: 0.0,
            past: Past::default(),
            sizes: &self.sizes,
        }
    }
}

fn grid(step: f64, duration: f64) -> Vec<f64> {
    (0..=(duration / step).round() as usize).map(|i| i as f64 * step).collect()
}

fn law(effect: &str, law: &str) -> &'static dyn Effect {
    named(effect, law).unwrap_or_else(|| panic!("no law {law} of {effect}"))
}

/// In-phase and quadrature part of the last periods of a series against a sine.
fn harmonic(stage: &Stage, series: &[f64], frequency: f64, periods: f64) -> (f64, f64) {
    let time = stage.recording.time();
    let start = time[time.len() - 1] - periods / frequency;
    let mut sums = (0.0, 0.0, 0.0);
    for (t, y) in time.iter().zip(series).filter(|(t, _)| **t > start + 1e-9) {
        let (sin, cos) = (TAU * frequency * t).sin_cos();
        sums = (sums.0 + y * sin, sums.1 + y * cos, sums.2 + 0.5);
    }
    (sums.0 / sums.2, sums.1 / sums.2)
}

fn column(effect: &str, name: &str, scene: &Scene, shape: &[f64]) -> Vec<f64> {
    law(effect, name).columns(scene, shape).swap_remove(0)
}

fn close(found: f64, wanted: f64, share: f64) {
    assert!((found - wanted).abs() <= share * wanted.abs(), "{found} instead of {wanted}");
}
