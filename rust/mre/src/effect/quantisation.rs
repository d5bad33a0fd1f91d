//! Quantisation: a force measured in steps that are not small against the noise is off by a saw tooth of the
//! true force.
//!
//! No effect of the catalogue, but a part of the measurement: the first terms of the saw tooth's Fourier
//! series (Widrow 1956), which noise within a step dampens, with free coefficients. Its place follows from the force
//! of the whole device: an effect of some steps shifts it by as many teeth.
//! Known limit: so do a hum and a drift, which are not seen here.

use super::{About, Effect, Flexibility, Scene, Sizes, signed};
use crate::parameter::Parameter;

/// A lattice finer than this share of the force's range is none.
const FINEST: f64 = 1e-4;
/// Steps are multiples of the lattice to this share of it: files round.
const TOLERANCE: f64 = 0.02;

/// Terms of the series. More would leave a rest that is not noise where the sensor is quiet.
const TERMS: usize = 2;

/// Saw tooth of the force of the device with its effects.
#[derive(Debug, Clone, Copy)]
pub struct Quantisation;

/// The step of the lattice on which all forces lie, N, if there is one.
pub(super) fn quantum(forces: &[&[f64]]) -> Option<f64> {
    let all = || forces.iter().flat_map(|f| f.windows(2)).map(|pair| (pair[1] - pair[0]).abs());
    let range = forces
        .iter()
        .map(|f| crate::recording::extent(f))
        .fold(0.0_f64, |range, (low, high)| range.max(high - low));
    let step = all().filter(|d| *d > FINEST * range).fold(f64::INFINITY, f64::min);
    let multiple = |d: f64| (d / step - (d / step).round()).abs() <= TOLERANCE;
    (step.is_finite() && all().all(multiple)).then_some(step)
}

impl Effect for Quantisation {
    fn about(&self) -> About {
        About {
            effect: "quantisation",
            law: "saw tooth",
            plain: "the force is measured in steps",
            equation: "F += sum_k a_k sin(2 pi k F/q) + b_k cos(2 pi k F/q)",
            reference: "Widrow 1956",
            limit: "steps below the noise leave no trace",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        (1..=TERMS).flat_map(|k| ["a", "b"].map(|name| signed(&format!("{name}_{k}"), "N"))).collect()
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        let Some(step) = scene.sizes.quantum else { return Vec::new() };
        let wave = |k: usize, f: fn(f64) -> f64| {
            scene.whole.iter().map(|force| f(std::f64::consts::TAU * k as f64 * force / step)).collect()
        };
        (1..=TERMS).flat_map(|k| [wave(k, f64::sin), wave(k, f64::cos)]).collect()
    }

    fn of_the_measurement(&self) -> bool {
        true
    }

    // Takes nothing from the motion, but follows from the force.
    fn flexibility(&self, _: &[f64]) -> Option<Flexibility> {
        Some(Flexibility::default())
    }
}
