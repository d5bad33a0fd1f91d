//! Noise that the window of a derived velocity lets through.
//!
//! A local polynomial passes frequencies far above those of the motion. What a window of twice the length takes off
//! is such noise and a little of the motion: a low pass keeps of it what the motion asks for (with the smallest estimate
//! of the error: Stein 1981, <https://doi.org/10.1214/aos/1176345632>). And where a motion is slower than elsewhere,
//! octave by octave what the next window takes off is compared with what noise would leave there. Where it rests, no polynomial
//! of many terms can be as calm as the mean: what is left beside that is compared in the same way.

use super::distortion::Distortion;
use super::octaves::{Motion, Noisy, Smooth, each, less, low_passed};
use super::rest::at_rest;
use super::step;
use super::window::Window;

/// Octaves that may hold noise beside motion.
const MIXED: usize = 2;

/// A motion with less noise, or what is left of noise alone.
pub struct Calm {
    /// Displacement, mm.
    pub displacement: Vec<f64>,
    /// Velocity, mm/s.
    pub velocity: Vec<f64>,
    /// Parts of the displacement, mm, and of the velocity, mm/s, that are noise or may hold some: what was taken off,
    /// and what was left of the fastest octaves.
    pub noisy: Vec<Motion>,
}

/// How noise is taken off a derived motion on an even grid: the same way off everything that is added to it.
#[derive(Debug, Clone)]
pub struct Calming {
    /// Standard deviation of the noise of the measured displacement, mm.
    pub noise: f64,
    /// Of the local polynomials.
    window: Window,
    /// Of a low pass of what the next window takes off, Hz.
    cut_off: Option<f64>,
    /// What is noise of each octave, as a share of it at every sample; none where no wider window fits.
    shares: Vec<Vec<f64>>,
    /// The same of what is beside the mean; empty where none was looked for.
    rest: Vec<f64>,
    /// What is motion of all that is taken off.
    distortion: Option<Distortion>,
}

impl Calming {
    /// Of a measured displacement in mm, by the motion that local polynomials make of it.
    pub(super) fn of(time: &[f64], measured: &[f64], motion: Motion, window: Window) -> Self {
        let narrow = Smooth { motion, window, share: window.leverage() };
        let variance = narrow.left_of(measured) / (1.0 - narrow.share).max(f64::MIN_POSITIVE);
        Self::knowing(variance, [time, measured], narrow.motion, window)
    }

    /// The same where the noise of the displacement is known to have a variance in mm².
    pub(super) fn knowing(
        variance: f64,
        [time, measured]: [&[f64]; 2],
        motion: Motion,
        window: Window,
    ) -> Self {
        let narrow = Smooth { motion, window, share: window.leverage() };
        Self::from(&narrow, &Noisy { time, measured, step: step(time), variance })
    }

    fn from(narrow: &Smooth, noisy: &Noisy) -> Self {
        let (noise, window) = (noisy.variance.sqrt(), narrow.window);
        let Some(wide) = noisy.smooth(window.wider(1)) else {
            let (shares, rest) = (Vec::new(), Vec::new());
            return Self { noise, window, cut_off: None, shares, rest, distortion: None };
        };
        let (best, cut_off) = noisy.low_passed(narrow, &wide);
        let (shares, left) = noisy.shares_of_octaves(best, wide);
        let octaves = Self { noise, window, cut_off, shares, rest: Vec::new(), distortion: None };
        let calm = octaves.over(noisy.time, noisy.measured);
        let left: Vec<f64> = left.iter().map(|left| noisy.variance * left).collect();
        let rest = at_rest(&calm.displacement, &left, window.half, octaves.shares.len());
        let calming = Self { rest, ..octaves };
        let rests = !calming.rest.is_empty();
        let calm = if rests { calming.over(noisy.time, noisy.measured) } else { calm };
        let Calm { displacement, velocity, .. } = calm;
        let taken = |all: &Motion| {
            let Calm { displacement, velocity, .. } = calming.over(noisy.time, &all[0]);
            less(all, &[displacement, velocity])
        };
        let off = each(noisy.measured, &displacement, |all, calm| all - calm);
        let distortion = Distortion::of(&[displacement, velocity], noisy.time, taken);
        let distortion = distortion.filter(|own| own.stands_out(&off, noisy.variance));
        Self { distortion, ..calming }
    }

    /// A displacement in mm less its mean around each sample.
    fn beside_the_mean(&self, time: &[f64], displacement: &[f64]) -> Vec<f64> {
        let mean = Window { terms: 1, ..self.window }.over(time, displacement).1;
        each(displacement, &mean, |x, mean| x - mean)
    }

    /// What it leaves of a displacement in mm.
    pub fn over(&self, time: &[f64], displacement: &[f64]) -> Calm {
        let smooth = |window: Window| {
            let (slope, value) = window.over(time, displacement);
            [value, slope]
        };
        let mut fast = smooth(self.window);
        let mut calm = fast.clone();
        let mut taken = [0, 1].map(|_| vec![0.0; time.len()]);
        let mut mixed = Vec::new();
        for (k, shares) in self.shares.iter().enumerate() {
            let wider = self.window.wider(k + 1);
            let slow = smooth(wider);
            if let Some(frequency) = self.cut_off.filter(|_| k == 0)
                && let Some(passed) = low_passed(&fast, (&slow, wider.half), frequency, step(time))
            {
                (fast, calm) = (passed.clone(), passed);
            }
            let octave = less(&fast, &slow);
            let noise = octave.clone().map(|part| each(&part, shares, |octave, share| share * octave));
            if k < MIXED {
                mixed.push(less(&octave, &noise));
            }
            for (taken, noise) in taken.iter_mut().zip(&noise) {
                *taken = each(taken, noise, |taken, noise| taken + noise);
            }
            fast = slow;
        }
        if !self.rest.is_empty() {
            let [displacement, velocity] = less(&calm, &taken);
            let beside = [self.beside_the_mean(time, &displacement), velocity];
            let noise = beside.map(|part| each(&part, &self.rest, |part, share| share * part));
            taken = [0, 1].map(|k| each(&taken[k], &noise[k], |taken, noise| taken + noise));
        }
        if let Some(distortion) = &self.distortion {
            let smooth = less(&calm, &taken);
            let part = distortion.part_of(&each(displacement, &smooth[0], |all, smooth| all - smooth));
            taken = less(&taken, &part);
        }
        let [displacement, velocity] = less(&calm, &taken);
        let noisy = if self.shares.is_empty() { Vec::new() } else { [vec![taken], mixed].concat() };
        Calm { displacement, velocity, noisy }
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rand_chacha::ChaCha8Rng;
    use rand_core::{Rng, SeedableRng};

    use super::*;
    use crate::velocity::from_displacement;

    const SAMPLES: usize = 2000;

    /// Errors of the velocity derived and of the calmed one, rms over a part of 10 s, with noise of this size in mm.
    fn errors(motion: impl Fn(f64) -> [f64; 2], size: f64, part: std::ops::Range<usize>) -> [f64; 2] {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut uniform = || f64::from(random.next_u32()) / f64::from(u32::MAX) - 0.5;
        let time: Vec<f64> = (0..SAMPLES).map(|i| i as f64 / 200.0).collect();
        let measured: Vec<f64> =
            time.iter().map(|t| motion(*t)[0] + size * 12.0_f64.sqrt() * uniform()).collect();
        let derived = from_displacement(&time, &measured);
        let calm = derived.calming(&time, &measured).over(&time, &measured);
        [&derived.velocity, &calm.velocity].map(|velocity| {
            let square = |i: usize| (velocity[i] - motion(time[i])[1]).powi(2);
            (part.clone().map(square).sum::<f64>() / part.len() as f64).sqrt()
        })
    }

    #[test]
    fn what_is_slower_than_elsewhere_loses_its_noise() {
        // 2 Hz that dies away, then 0.3 Hz alone.
        let motion = |t: f64| {
            let (fast, slow) = (TAU * 2.0, TAU * 0.3);
            let decay = 5.0 * (-1.5 * t).exp();
            let rate = decay * (fast * (fast * t).cos() - 1.5 * (fast * t).sin());
            [decay * (fast * t).sin() + 0.5 * (slow * t).sin(), rate + 0.5 * slow * (slow * t).cos()]
        };
        let [before, after] = errors(motion, 0.005, 1200..1900);
        assert!(after < 0.5 * before, "{before} to {after}");
    }

    #[test]
    fn noise_is_smoothed_as_beside_the_motion() {
        let time: Vec<f64> = (0..SAMPLES).map(|i| i as f64 / 200.0).collect();
        let measured: Vec<f64> =
            time.iter().map(|t| 5.0 * (TAU * 2.0 * t).sin() * (-0.5 * t).exp()).collect();
        // No multiple of a step of the displacement: as good as noise.
        let noise: Vec<f64> = (0..SAMPLES).map(|i| 0.01 * ((i * i) as f64 * 0.618).sin()).collect();
        let both = each(&measured, &noise, |a, b| a + b);
        let calming = from_displacement(&time, &both).calming(&time, &both);
        let [all, motion, alone] = [&both, &measured, &noise].map(|series| calming.over(&time, series));
        let apart = |all: &[f64], a: &[f64], b: &[f64]| {
            let apart = |((all, a), b): ((&f64, &f64), &f64)| (all - a - b).abs();
            all.iter().zip(a).zip(b).map(apart).fold(0.0, f64::max)
        };
        assert!(apart(&all.displacement, &motion.displacement, &alone.displacement) < 1e-9);
        assert!(apart(&all.velocity, &motion.velocity, &alone.velocity) < 1e-7);
        let rms = (noise.iter().map(|e| e * e).sum::<f64>() / SAMPLES as f64).sqrt();
        assert!((calming.noise / rms - 1.0).abs() < 0.1, "{} of {rms}", calming.noise);
    }

    #[test]
    fn a_steady_motion_loses_what_is_faster_and_keeps_itself() {
        let motion = |t: f64| {
            let turn = TAU * 3.0;
            [5.0 * (turn * t).sin(), 5.0 * turn * (turn * t).cos()]
        };
        let [before, after] = errors(motion, 0.005, 200..1800);
        assert!(after < 0.8 * before, "{before} to {after}");
        let [_, clean] = errors(motion, 0.0, 0..SAMPLES);
        assert!(clean < 1e-6 * 5.0 * TAU * 3.0, "{clean}");
    }

    #[test]
    fn a_motion_at_rest_has_no_velocity_and_a_ramp_keeps_its_own() {
        // Up in a second, and down; 5 s in all at rest.
        let motion = |t: f64| {
            let bell = |from: f64| {
                let s = (t - from).clamp(0.0, 1.0);
                let turn = TAU * s;
                [s - turn.sin() / TAU, 1.0 - turn.cos()]
            };
            let (up, down) = (bell(2.0), bell(6.0));
            [0, 1].map(|k| 4.0 * (up[k] - down[k]))
        };
        let [before, after] = errors(motion, 0.002, 800..1100);
        assert!(after < 0.1 * before, "{before} to {after}");
        let [before, after] = errors(motion, 0.002, 440..560);
        assert!(after < 1.1 * before, "{before} to {after}");
    }
}
