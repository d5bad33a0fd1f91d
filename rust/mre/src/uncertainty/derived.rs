//! Quantities that the parameters determine together, often far better than each of them.

use std::f64::consts::{SQRT_2, TAU};
use std::sync::OnceLock;

use crate::error::Result;
use crate::fitness::Problem;
use crate::recording::{Condition, Recording, Series, extent};

/// Cycles of the steady motion; the last one counts.
const CYCLES: usize = 3;
/// Samples a cycle, multiples of four so that the displacement extremes are among them. The first at which
/// the force can be computed counts: a stiff device wants small steps.
const SAMPLES: [usize; 5] = [256, 1024, 4096, 16384, 65536];

/// A combination of a model's parameters by formula.
pub(super) struct Combination {
    pub(super) name: &'static str,
    unit: &'static str,
    pub(super) members: &'static [&'static str],
    of: fn(&[f64]) -> f64,
}

/// Combinations of a model that the field has names for: stiffness about the origin, cubic stiffness.
pub(super) fn combinations(model: &str) -> &'static [Combination] {
    match model {
        "sinh" => &[
            Combination {
                name: "k0 + alpha beta",
                unit: "N/mm",
                members: &["k0", "alpha", "beta"],
                of: |p| p[1] + p[2] * p[3],
            },
            Combination {
                name: "alpha beta^3 / 6",
                unit: "N/mm^3",
                members: &["alpha", "beta"],
                of: |p| p[2] * p[3].powi(3) / 6.0,
            },
        ],
        "bouc_wen" => &[Combination {
            name: "kx + kw rho",
            unit: "N/mm",
            members: &["kx", "kw", "rho"],
            of: |p| p[1] + p[2] * p[3],
        }],
        _ => &[],
    }
}

/// The largest tested amplitude, and the frequency at which it was tested.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Half of the range of the displacement, mm.
    pub amplitude: f64,
    /// Ratio of the rms of velocity and displacement over 2 pi, Hz: the frequency of a sine, and the
    /// mean frequency of any other motion (Rice 1944).
    pub frequency: f64,
}

impl Cycle {
    /// Of the recording that moves most.
    pub fn of(problem: &Problem) -> Self {
        let mut largest = Self { amplitude: 0.0, frequency: 1.0 };
        for recording in problem.recordings() {
            let scored = recording.scored();
            let x = &recording.displacement()[scored.clone()];
            let (low, high) = extent(x);
            if 0.5 * (high - low) > largest.amplitude {
                let frequency = rms(&recording.velocity()[scored]) / rms(x) / TAU;
                largest = Self { amplitude: 0.5 * (high - low), frequency };
            }
        }
        largest
    }

    /// Steady sines at this amplitude and frequency, from rest.
    fn motion(&self, samples: usize) -> Result<Recording> {
        let time: Vec<f64> =
            (0..CYCLES * samples).map(|i| i as f64 / (samples as f64 * self.frequency)).collect();
        let phase = |t: &f64| TAU * self.frequency * t;
        let series = Series {
            displacement: time.iter().map(|t| self.amplitude * phase(t).sin()).collect(),
            velocity: Some(
                time.iter().map(|t| self.amplitude * TAU * self.frequency * phase(t).cos()).collect(),
            ),
            time,
            force: None,
            simulated: None,
            current: Condition::Missing,
            temperature: Condition::Missing,
            name: "steady cycle".into(),
        };
        Recording::new(series)
    }
}

/// Root mean square about the mean.
fn rms(values: &[f64]) -> f64 {
    let mean = crate::recording::mean(values);
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
}

/// Evaluates the quantities of a problem.
pub(super) struct Derived<'a> {
    problem: &'a Problem,
    cycle: Cycle,
    /// The motion at each of [`SAMPLES`], where it was wanted.
    motions: [OnceLock<Option<Recording>>; SAMPLES.len()],
}

impl<'a> Derived<'a> {
    pub(super) fn new(problem: &'a Problem) -> Self {
        Self { problem, cycle: Cycle::of(problem), motions: Default::default() }
    }

    /// Name and unit of every quantity.
    pub(super) fn names(&self, values: &[f64]) -> Vec<(String, &'static str)> {
        let levels = self.problem.law().levels(values, None);
        let mut out = Vec::new();
        for level in &levels {
            let suffix = match level.current {
                Some(current) if levels.len() > 1 => format!(" ({current} A)"),
                _ => String::new(),
            };
            let combined = combinations(self.problem.model().name()).iter().map(|c| (c.name, c.unit));
            let cycle = [("effective stiffness", "N/mm"), ("energy per cycle", "N mm")];
            out.extend(combined.chain(cycle).map(|(name, unit)| (format!("{name}{suffix}"), unit)));
        }
        out
    }

    /// Size of a quantity that alone makes up a force of this rms on the steady motion: beyond it, an
    /// interval that reaches zero says nothing.
    pub(super) fn size(&self, unit: &str, rms: f64) -> f64 {
        let (amplitude, peak) = (self.cycle.amplitude, SQRT_2 * rms);
        match unit {
            "N/mm^3" => peak / amplitude.powi(3),
            "N mm" => 4.0 * peak * amplitude, // a rectangle
            _ => peak / amplitude,
        }
    }

    /// Their values; not finite where the steady motion cannot be computed at any number of samples.
    pub(super) fn values(&self, values: &[f64]) -> Vec<f64> {
        let model = self.problem.model();
        let mut out = Vec::new();
        for level in self.problem.law().levels(values, None) {
            out.extend(combinations(model.name()).iter().map(|c| (c.of)(&level.values)));
            out.extend(self.effective(&level.values));
        }
        out
    }

    /// Stiffness between the displacement extremes, and the area of the last cycle.
    fn effective(&self, values: &[f64]) -> [f64; 2] {
        for (samples, motion) in SAMPLES.into_iter().zip(&self.motions) {
            let Some(motion) = motion.get_or_init(|| self.cycle.motion(samples).ok()) else { continue };
            let (mut force, mut column) = (vec![0.0; motion.len()], vec![0.0; motion.len()]);
            self.problem.model().add_force(motion, values, None, &mut column, &mut force);
            if force.iter().all(|f| f.is_finite()) {
                return over_last_cycle(motion, samples, &force);
            }
        }
        [f64::NAN; 2]
    }
}

fn over_last_cycle(motion: &Recording, samples: usize, force: &[f64]) -> [f64; 2] {
    let first = (CYCLES - 1) * samples;
    let (top, bottom) = (first + samples / 4, first + 3 * samples / 4);
    let x = motion.displacement();
    let stiffness = (force[top] - force[bottom]) / (x[top] - x[bottom]);
    // One period of even samples: the sum is the integral to all digits for a smooth force.
    let power: f64 = force[first..].iter().zip(&motion.velocity()[first..]).map(|(f, v)| f * v).sum();
    [stiffness, power * (motion.time()[1] - motion.time()[0])]
}
