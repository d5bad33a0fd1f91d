//! A stiffness or a strength that oscillates, as a ripple of the supply or a heater that cycles makes it: the displacement
//! or the force times a wave in time.
//!
//! An autoregression takes such a force for noise, because its spectrum is that of the motion moved by the frequency; but
//! in step with the motion it stands out as a line. Which frequency fits best is found by a scan without the projection;
//! the test is made at that one alone, and counts all that were scanned.

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::missing::{MORE_CAUTION, MOST_RECORDINGS, Mismatch, Projected};
use super::null::Null;
use crate::effect::Scene;
use crate::kernel::filter::dot;

/// Frequencies are half a line of the longest recording apart.
const APART: f64 = 0.5;
/// The lowest, in lines: a slower one is a stiffness that wanders.
const LOWEST: f64 = 3.0;
/// The highest, Hz, and in shares of the sampling rate.
const HIGHEST: (f64, f64) = (10.0, 0.1);
/// Most of them.
const MOST: usize = 1000;

/// A series of a recording that oscillates.
type Carrier = for<'s> fn(&'s Scene<'_>) -> &'s [f64];

/// The stiffness, or the strength as a whole.
const CARRIERS: [Carrier; 2] = [|scene| scene.displacement, |scene| scene.force];

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Oscillating {
    /// Frequency that fits best, Hz.
    pub(super) frequency: f64,
    /// What it takes off.
    pub(super) mismatch: Mismatch,
}

/// What a recording contributes to the scan.
struct Scanned {
    step: f64,
    /// A carrier, or one for waves alone, times the residual as the whitening would filter it backwards.
    products: Vec<f64>,
    /// Products of the carrier with itself, lag by lag, with those of the whitening filter.
    lags: Vec<f64>,
}

impl Scanned {
    fn of(null: &Null, r: usize, carrier: Option<Carrier>) -> Option<Self> {
        let recording = &null.assembly().campaign().recordings()[r];
        let (coefficients, deviation) = null.noise().autoregression(r);
        let left = &null.point.recordings[r].residual;
        let end = recording.scored().end;
        let start = end.checked_sub(left.len())?;
        let first = start.checked_sub(coefficients.len())?;
        let filter: Vec<f64> =
            [1.0].into_iter().chain(coefficients.iter().map(|a| -a)).map(|a| a / deviation).collect();
        let mut backwards = vec![0.0; end - first];
        for (i, e) in left.iter().enumerate() {
            for (k, a) in filter.iter().enumerate() {
                backwards[start - first + i - k] += a * e;
            }
        }
        let scene = null.scene(r);
        let carrier = carrier.map_or_else(|| vec![1.0; end - first], |of| of(&scene)[first..end].to_vec());
        let products = backwards.iter().zip(&carrier).map(|(b, c)| b * c).collect();
        let (last, taps) = (carrier.len(), filter.len());
        let lags = (0..taps.min(last)).map(|lag| {
            let twice = if lag == 0 { 1.0 } else { 2.0 };
            twice * dot(&filter[lag..], &filter[..taps - lag]) * dot(&carrier[lag..], &carrier[..last - lag])
        });
        let lags = lags.collect();
        Some(Self { step: scene.step(), products, lags })
    }

    /// Squared standard deviations at a frequency in Hz, of two on average under the null.
    fn at(&self, frequency: f64) -> f64 {
        let turn = TAU * frequency * self.step;
        let (sine, cosine) = turn.sin_cos();
        let (mut x, mut y) = (1.0, 0.0);
        let (mut along, mut across) = (0.0, 0.0);
        for product in &self.products {
            along += product * x;
            across += product * y;
            (x, y) = (x * cosine - y * sine, x * sine + y * cosine);
        }
        let square: f64 = self.lags.iter().enumerate().map(|(lag, l)| l * (turn * lag as f64).cos()).sum();
        if square > 0.0 { 2.0 * (along * along + across * across) / square } else { 0.0 }
    }
}

impl Null<'_> {
    /// Test for what oscillates, with a phase of its own in each recording.
    ///
    /// A tone of the measurement is none: there is no test where one explains more. `None` where no test could be made.
    pub(super) fn oscillating(&self) -> Option<Oscillating> {
        let campaign = self.assembly().campaign();
        let (count, sizes) = (campaign.recordings().len(), campaign.sizes());
        if count > MOST_RECORDINGS || !self.knows_its_noise() {
            return None;
        }
        let apart = APART / sizes.duration;
        let highest = HIGHEST.0.min(HIGHEST.1 / sizes.step);
        let frequencies: Vec<f64> = (0..MOST)
            .map(|k| (LOWEST + APART * k as f64) / sizes.duration)
            .take_while(|frequency| *frequency < highest)
            .collect();
        if frequencies.is_empty() {
            return None;
        }
        let tones: Vec<f64> =
            (0..2 * (frequencies.len() + LOWEST as usize)).map(|k| apart * k as f64).collect();
        let of_tones = self.scanned(&tones, None)?.into_iter().fold(0.0, f64::max);
        let tested = |carrier: &Carrier| {
            let all = self.scanned(&frequencies, Some(*carrier))?;
            let (best, most) = all.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
            (most > of_tones).then(|| self.oscillates(*carrier, frequencies[best], &all))
        };
        let tested = CARRIERS.iter().filter_map(tested);
        let best = tested.min_by(|a, b| a.mismatch.p_value.total_cmp(&b.mismatch.p_value))?;
        let tests = (CARRIERS.len() * frequencies.len()) as f64;
        let p_value = (tests * best.mismatch.p_value).min(1.0);
        Some(Oscillating { mismatch: Mismatch { p_value, ..best.mismatch }, ..best })
    }

    /// Squared standard deviations at each frequency, of all recordings.
    fn scanned(&self, frequencies: &[f64], carrier: Option<Carrier>) -> Option<Vec<f64>> {
        let recordings = self.assembly().campaign().recordings().len();
        let scanned: Vec<Scanned> =
            (0..recordings).map(|r| Scanned::of(self, r, carrier)).collect::<Option<_>>()?;
        Some(frequencies.par_iter().map(|f| scanned.iter().map(|s| s.at(*f)).sum()).collect())
    }

    /// The test at one frequency, beside a tone there; `all` tells how much larger than under a noise of even size they
    /// are.
    fn oscillates(&self, carrier: Carrier, frequency: f64, all: &[f64]) -> Oscillating {
        let count = self.assembly().campaign().recordings().len();
        let projected = self.project(4 * count, |view, r| {
            let scene = view.scene(r);
            let turns = |t: &f64| TAU * frequency * t;
            let waves = [f64::sin, f64::cos].map(|wave| scene.time.iter().map(|t| wave(turns(t))).collect());
            let carried = waves.clone().map(|wave: Vec<f64>| {
                wave.iter().zip(carrier(&scene)).map(|(wave, c)| wave * c).collect::<Vec<f64>>()
            });
            let all = waves.into_iter().chain(carried);
            all.enumerate().map(|(k, column)| (k * count + r, column)).collect()
        });
        let gain = |some: usize| Projected::of(&projected, &(0..some).collect::<Vec<_>>()).mismatch();
        let (tones, both) = (gain(2 * count), gain(4 * count));
        let (gain, freedom) = (both.gain - tones.gain, both.freedom - tones.freedom);
        let excess = (median(all) / median_of_chi_square(2 * count)).max(1.0);
        Oscillating { frequency, mismatch: Mismatch::new(gain / (MORE_CAUTION * excess), freedom) }
    }
}

fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// By the cube root that is nearly normal (Wilson and Hilferty 1931).
fn median_of_chi_square(freedom: usize) -> f64 {
    let n = freedom as f64;
    n * (1.0 - 2.0 / (9.0 * n)).powi(3)
}
