//! Mains interference: a hum of the power supply on the force channel.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `A_k`, `B_k` | sine and cosine of the k-th harmonic | N | any, in each recording |
//! | f | frequency of the mains | Hz | 45 to 65 |
//!
//! Of the measurement, not of the device: a simulation leaves it out.
//! Known limit: a hum that is aliased to below a quarter of the sampling rate is not looked for: motion is there.

use std::f64::consts::TAU;

use super::{About, Effect, Scene, Sizes, signed, within};
use crate::parameter::Parameter;

/// Nominal frequencies, Hz.
const NOMINAL: [f64; 2] = [50.0, 60.0];
/// A fit starts within this of a nominal frequency, Hz.
const AROUND: f64 = 0.1;
/// A hum is told from motion above this share of the sampling rate, aliased or not, or where a period has so many
/// samples.
const FAST: f64 = 0.25;
const SAMPLES: f64 = 2.2;
/// At half the sampling rate a sine may vanish at all samples: below this size it is none.
const VANISHED: f64 = 1e-6;

/// True where a frequency in Hz is sampled well enough, so many seconds apart.
pub(crate) fn sampled(frequency: f64, step: f64) -> bool {
    SAMPLES * frequency * step <= 1.0
}

/// True where samples so many seconds apart show a hum of this frequency in Hz, and motion is elsewhere.
pub(crate) fn told(frequency: f64, step: f64) -> bool {
    let turns = frequency * step;
    sampled(frequency, step) || (turns - turns.round()).abs() >= FAST
}

/// A hum with so many harmonics.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mains {
    /// Harmonics, the fundamental included.
    pub(super) harmonics: u8,
}

impl Mains {
    /// The nominal frequencies that are told from motion; folded harmonics may be one another.
    fn seen(self, sizes: &Sizes) -> Vec<f64> {
        let highest = f64::from(self.harmonics);
        let told =
            |f: &f64| if highest > 1.0 { sampled(highest * f, sizes.step) } else { told(*f, sizes.step) };
        NOMINAL.into_iter().filter(told).collect()
    }
}

impl Effect for Mains {
    fn about(&self) -> About {
        let one = self.harmonics == 1;
        About {
            effect: "mains_interference",
            law: if one { "fundamental" } else { "with harmonics" },
            plain: "the power mains hum on the measured force",
            equation: if one {
                "F_measured = F + A_1 sin(2 pi f t) + B_1 cos(2 pi f t)"
            } else {
                "F_measured = F + sum_k A_k sin(2 pi k f t) + B_k cos(2 pi k f t), k = 1 to 3"
            },
            reference: "general",
            limit: "a hum that is aliased to below a quarter of the sampling rate is not looked for",
        }
    }

    fn of_the_measurement(&self) -> bool {
        true
    }

    fn follows_the_motion(&self) -> bool {
        false
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        !self.seen(sizes).is_empty()
    }

    fn coefficients(&self) -> Vec<Parameter> {
        (1..=self.harmonics)
            .flat_map(|k| [signed(&format!("A_{k}"), "N"), signed(&format!("B_{k}"), "N")])
            .collect()
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        vec![within("f", "Hz", 45.0, 65.0)]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        // As far apart as the longest recording resolves.
        let apart = (0.6 / sizes.duration).clamp(0.01, 0.05);
        let beside = if self.harmonics == 1 { (AROUND / apart).round() as i32 } else { 0 };
        self.seen(sizes)
            .into_iter()
            .flat_map(|f| (-beside..=beside).map(move |k| vec![f + f64::from(k) * apart]))
            .collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        (1..=self.harmonics)
            .flat_map(|k| {
                let turn = TAU * f64::from(k) * shape[0];
                let phase = move |t: &f64| turn * (t - scene.time[0]);
                let sin = scene.time.iter().map(|t| phase(t).sin()).collect();
                [sin, scene.time.iter().map(|t| phase(t).cos()).collect::<Vec<f64>>()]
            })
            .map(
                |column| {
                    if column.iter().all(|v| v.abs() < VANISHED) { vec![0.0; column.len()] } else { column }
                },
            )
            .collect()
    }
}
