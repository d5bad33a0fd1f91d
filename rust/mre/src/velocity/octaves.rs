//! Noise that the window of a derived velocity lets through.
//!
//! A local polynomial passes frequencies far above those of the motion. What a window of twice the length takes off
//! is such noise and a little of the motion: a low pass keeps of it what the motion asks for (with the smallest estimate
//! of the error: Stein 1981, <https://doi.org/10.1214/aos/1176345632>). And where a motion is slower than elsewhere,
//! octave by octave what the next window takes off is compared with what noise would leave there. Where it rests, no polynomial
//! of many terms can be as calm as the mean: what is left beside that is compared in the same way.

use rayon::prelude::*;

use super::local::TERMS;
use super::low_pass::LowPass;
use super::step;
use super::window::Window;
use crate::recording::mean;

/// Widest half window in samples.
const WIDEST: usize = 1024;
/// Cut-off frequencies that are tried are so many times apart.
const APART: f64 = 1.15;
/// An octave with less than so many times the mean square that noise has is noise.
const NOISE: f64 = 2.0;
/// A motion rests where it is as calm as the mean over so many half windows.
const RESTS: usize = 1;
/// Octaves that may hold noise beside motion.
const MIXED: usize = 2;

/// Displacement, mm, and velocity, mm/s.
type Motion = [Vec<f64>; 2];

/// A derived motion with less noise.
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
    /// Half window of the local polynomials.
    half: usize,
    /// Of a low pass of what the next window takes off, Hz.
    cut_off: Option<f64>,
    /// What is noise of each octave, as a share of it at every sample; none where no wider window fits.
    shares: Vec<Vec<f64>>,
    /// The same of what is beside the mean; empty where none was looked for.
    rest: Vec<f64>,
}

impl Calming {
    /// Of a measured displacement in mm, by what polynomials over a half window make of it.
    pub fn of(time: &[f64], measured: &[f64], motion: [Vec<f64>; 2], half: usize) -> Self {
        let share = Window { half, terms: TERMS }.leverage();
        let narrow = Smooth { motion, half, share };
        let mut noisy = Noisy { time, measured, step: step(time), variance: 0.0 };
        noisy.variance = noisy.left_by(&narrow) / (1.0 - share).max(f64::MIN_POSITIVE);
        let noise = noisy.variance.sqrt();
        let Some(wide) = noisy.smooth(2 * half) else {
            return Self { noise, half, cut_off: None, shares: Vec::new(), rest: Vec::new() };
        };
        let (best, cut_off) = noisy.low_passed(&narrow, &wide);
        let (shares, left) = noisy.shares_of_octaves(best, wide);
        let octaves = Self { noise, half, cut_off, shares, rest: Vec::new() };
        let calm = octaves.over(time, measured).displacement;
        let squares = spread(&calm, RESTS * half).into_iter().zip(left);
        let rest = squares.map(|(square, left)| noise_share(square, noisy.variance * left)).collect();
        Self { rest, ..octaves }
    }

    /// A displacement in mm less its mean around each sample.
    fn beside_the_mean(&self, time: &[f64], displacement: &[f64]) -> Vec<f64> {
        let mean = Window { half: RESTS * self.half, terms: 1 }.over(time, displacement).1;
        each(displacement, &mean, |x, mean| x - mean)
    }

    /// What it leaves of a displacement in mm.
    pub fn over(&self, time: &[f64], displacement: &[f64]) -> Calm {
        let smooth = |half: usize| {
            let (slope, value) = Window { half, terms: TERMS }.over(time, displacement);
            [value, slope]
        };
        let mut fast = smooth(self.half);
        let mut calm = fast.clone();
        let mut taken = [0, 1].map(|_| vec![0.0; time.len()]);
        let mut mixed = Vec::new();
        for (k, shares) in self.shares.iter().enumerate() {
            let half = self.half << (k + 1);
            let slow = smooth(half);
            if let Some(frequency) = self.cut_off.filter(|_| k == 0)
                && let Some(passed) = low_passed(&fast, (&slow, half), frequency, step(time))
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
        let [displacement, velocity] = less(&calm, &taken);
        if !self.rest.is_empty() {
            let beside = [self.beside_the_mean(time, &displacement), velocity.clone()];
            let noise = beside.map(|part| each(&part, &self.rest, |part, share| share * part));
            taken = [0, 1].map(|k| each(&taken[k], &noise[k], |taken, noise| taken + noise));
        }
        let [displacement, velocity] = less(&calm, &taken);
        let noisy = if self.shares.is_empty() { Vec::new() } else { [vec![taken], mixed].concat() };
        Calm { displacement, velocity, noisy }
    }
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

/// What a wider window takes off a motion.
fn octave(narrow: &Motion, (wide, half): (&Motion, usize)) -> Motion {
    let n = narrow[0].len();
    // Near its ends a recording has windows that are off their middle.
    let rises = |i: usize| ((i.min(n - 1 - i) as f64 / half as f64) - 1.0).clamp(0.0, 1.0);
    less(narrow, wide).map(|part| part.iter().enumerate().map(|(i, d)| rises(i) * d).collect())
}

/// A motion of whose octave beyond a wider window only what is below a frequency in Hz is left.
fn low_passed(narrow: &Motion, wide: (&Motion, usize), frequency: f64, step: f64) -> Option<Motion> {
    let octave = octave(narrow, wide);
    let kept = LowPass::new(frequency, step).over_both(&octave)?;
    Some(less(narrow, &less(&octave, &kept)))
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

    /// The motion of a window with the low pass, of what a wider one takes off, that has the smallest error; and its
    /// cut-off frequency in Hz, if one is better than none.
    fn low_passed(&self, narrow: &Smooth, wide: &Smooth) -> (Smooth, Option<f64>) {
        let risk = |smooth: &Smooth| self.left_by(smooth) + 2.0 * self.variance * smooth.share;
        let mut frequency = 0.5 * narrow.share / self.step;
        let (mut least, mut best) = (risk(narrow), (narrow.clone(), None));
        while 2.0 * frequency * self.step > wide.share {
            let passed = low_passed(&narrow.motion, (&wide.motion, wide.half), frequency, self.step);
            let Some(motion) = passed else { break };
            let tried = Smooth { motion, half: narrow.half, share: 2.0 * frequency * self.step };
            let of_tried = risk(&tried);
            if of_tried < least {
                (least, best) = (of_tried, (tried, Some(frequency)));
            }
            frequency /= APART;
        }
        best
    }

    /// Octave by octave from a motion and the next slower one on: what share of it is noise, sample by sample; and what
    /// share of the variance of the noise is left then.
    fn shares_of_octaves(&self, fastest: Smooth, next: Smooth) -> (Vec<Vec<f64>>, Vec<f64>) {
        let mut shares = Vec::new();
        let mut left = vec![fastest.share; self.time.len()];
        let (mut fast, mut slower) = (fastest, Some(next));
        while let Some(slow) = slower {
            // The kernel of a least squares fit is a polynomial, which a narrower fit keeps.
            let less = (fast.share - slow.share).max(0.0);
            let octave = each(&fast.motion[0], &slow.motion[0], |fast, slow| fast - slow);
            let squares = around(&octave, 2 * slow.half);
            let own: Vec<f64> =
                squares.into_iter().map(|square| noise_share(square, self.variance * less)).collect();
            left = each(&left, &own, |left, own| left - own * less);
            shares.push(own);
            slower = self.smooth(2 * slow.half);
            fast = slow;
        }
        (shares, left)
    }
}

/// What share of something is noise that has this mean square where noise alone has that.
fn noise_share(square: f64, noise: f64) -> f64 {
    if square > NOISE * noise { (NOISE * noise / square).powi(2) } else { 1.0 }
}

/// Mean square about the mean over so many samples on either side.
fn spread(series: &[f64], reach: usize) -> Vec<f64> {
    let of = |i: usize| {
        let own = &series[i.saturating_sub(reach)..(i + reach + 1).min(series.len())];
        let middle = mean(own);
        own.iter().map(|x| (x - middle).powi(2)).sum::<f64>() / own.len() as f64
    };
    (0..series.len()).into_par_iter().map(of).collect()
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
}
