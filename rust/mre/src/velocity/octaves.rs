//! Noise that the window of a derived velocity lets through.
//!
//! A local polynomial passes frequencies far above those of the motion. What a window of twice the length takes off
//! is such noise and a little of the motion: a low pass keeps of it what the motion asks for (with the smallest estimate
//! of the error: Stein 1981, <https://doi.org/10.1214/aos/1176345632>). And where a motion is slower than elsewhere,
//! octave by octave what the next window takes off is compared with what noise would leave there.

use super::local::TERMS;
use super::low_pass::LowPass;
use super::window::Window;
use super::{Derived, step};

/// Widest half window in samples.
const WIDEST: usize = 1024;
/// Cut-off frequencies that are tried are so many times apart.
const APART: f64 = 1.15;
/// An octave with less than so many times the mean square that noise has is noise.
const NOISE: f64 = 2.0;
/// Octaves that may hold noise beside motion.
const MIXED: usize = 2;

/// Displacement, mm, and velocity, mm/s.
type Motion = [Vec<f64>; 2];

/// A derived motion with less noise.
pub struct Calmed {
    /// Displacement, mm.
    pub displacement: Vec<f64>,
    /// Velocity, mm/s.
    pub velocity: Vec<f64>,
    /// Parts of the displacement, mm, and of the velocity, mm/s, that are noise or may hold some: what was taken off,
    /// and what was left of the fastest octaves.
    pub noisy: Vec<Motion>,
}

/// A derived motion on an even grid less its noise, from the measured displacement in mm.
pub fn calmed(time: &[f64], measured: &[f64], derived: &Derived) -> Calmed {
    let half = derived.half;
    let share = Window { half, terms: TERMS }.leverage();
    let motion = [derived.displacement.clone(), derived.velocity.clone()];
    let narrow = Smooth { motion, half, share };
    let mut noisy = Noisy { time, measured, step: step(time), variance: 0.0 };
    noisy.variance = noisy.left_by(&narrow) / (1.0 - share).max(f64::MIN_POSITIVE);
    let Some(wide) = noisy.smooth(2 * half) else {
        let [displacement, velocity] = narrow.motion;
        return Calmed { displacement, velocity, noisy: Vec::new() };
    };
    let best = noisy.low_passed(&narrow, &wide);
    let (taken, mixed) = noisy.of_octaves(&best, wide);
    let [displacement, velocity] = less(&best.motion, &taken);
    Calmed { displacement, velocity, noisy: std::iter::once(taken).chain(mixed).collect() }
}

/// A motion that was smoothed.
#[derive(Clone)]
struct Smooth {
    motion: Motion,
    /// Half window of the local polynomials, before any low pass.
    half: usize,
    /// Share of white noise that is left in the displacement, mean square.
    share: f64,
}

fn each(a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| of(*a, *b)).collect()
}

fn less(all: &Motion, part: &Motion) -> Motion {
    [0, 1].map(|k| each(&all[k], &part[k], |all, part| all - part))
}

/// A measured displacement on an even grid, and the variance of its noise.
struct Noisy<'a> {
    time: &'a [f64],
    measured: &'a [f64],
    step: f64,
    variance: f64,
}

impl Noisy<'_> {
    /// The motion of a window, where it is not too wide.
    fn smooth(&self, half: usize) -> Option<Smooth> {
        let window = Window { half, terms: TERMS };
        (half <= WIDEST.min(self.time.len() / 4)).then(|| {
            let (slope, value) = window.over(self.time, self.measured);
            Smooth { motion: [value, slope], half, share: window.leverage() }
        })
    }

    /// Mean square that smoothing takes off.
    fn left_by(&self, smooth: &Smooth) -> f64 {
        let square = |(a, b): (&f64, &f64)| (a - b).powi(2);
        self.measured.iter().zip(&smooth.motion[0]).map(square).sum::<f64>() / self.time.len() as f64
    }

    /// The motion of a window with the low pass, of what a wider one takes off, that has the smallest error.
    fn low_passed(&self, narrow: &Smooth, wide: &Smooth) -> Smooth {
        let n = self.time.len();
        // Near its ends a recording has windows that are off their middle.
        let rises = |i: usize| ((i.min(n - 1 - i) as f64 / wide.half as f64) - 1.0).clamp(0.0, 1.0);
        let octave = less(&narrow.motion, &wide.motion)
            .map(|part| part.iter().enumerate().map(|(i, d)| rises(i) * d).collect());
        let risk = |smooth: &Smooth| self.left_by(smooth) + 2.0 * self.variance * smooth.share;
        let mut frequency = 0.5 * narrow.share / self.step;
        let (mut least, mut best) = (risk(narrow), narrow.clone());
        while 2.0 * frequency * self.step > wide.share {
            let Some(kept) = LowPass::new(frequency, self.step).over_both(&octave) else { break };
            let motion = less(&narrow.motion, &less(&octave, &kept));
            let tried = Smooth { motion, half: narrow.half, share: 2.0 * frequency * self.step };
            let of_tried = risk(&tried);
            if of_tried < least {
                (least, best) = (of_tried, tried);
            }
            frequency /= APART;
        }
        best
    }

    /// Octave by octave from a motion and the next slower one on: what is noise there, and what the fastest have
    /// besides.
    fn of_octaves(&self, fastest: &Smooth, next: Smooth) -> (Motion, Vec<Motion>) {
        let mut mixed = Vec::new();
        let mut taken = [0, 1].map(|_| vec![0.0; self.time.len()]);
        let (mut fast, mut slower) = (fastest.clone(), Some(next));
        while let Some(slow) = slower {
            // The kernel of a least squares fit is a polynomial, which a narrower fit keeps.
            let noise = self.variance * (fast.share - slow.share).max(0.0);
            let mut octave = less(&fast.motion, &slow.motion);
            let shares: Vec<f64> = around(&octave[0], 2 * slow.half)
                .into_iter()
                .map(|square| if square > NOISE * noise { (NOISE * noise / square).powi(2) } else { 1.0 })
                .collect();
            for (taken, octave) in taken.iter_mut().zip(&mut octave) {
                for ((taken, octave), share) in taken.iter_mut().zip(octave).zip(&shares) {
                    *taken += share * *octave;
                    *octave *= 1.0 - share;
                }
            }
            if mixed.len() < MIXED {
                mixed.push(octave);
            }
            slower = self.smooth(2 * slow.half);
            fast = slow;
        }
        (taken, mixed)
    }
}

/// Mean square over so many samples on either side.
fn around(series: &[f64], reach: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    sums.extend(series.iter().scan(0.0, |sum, e| {
        *sum += e * e;
        Some(*sum)
    }));
    (0..series.len())
        .map(|i| {
            let (first, end) = (i.saturating_sub(reach), (i + reach + 1).min(series.len()));
            (sums[end] - sums[first]) / (end - first) as f64
        })
        .collect()
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
        let calm = calmed(&time, &measured, &derived);
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
}
