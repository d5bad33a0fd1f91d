//! A stiffness or a strength that oscillates, as a ripple of the supply or a heater that cycles makes it: the displacement
//! or the force times a wave in time.
//!
//! An autoregression takes such a force for noise, because its spectrum is that of the motion moved by the frequency; but
//! in step with the motion it stands out as a line. Which frequency fits best is found by a scan without the projection;
//! the test is made at that one alone, and counts all that were scanned. A multiple of a sinusoidal drive is left to
//! other tests: such a wave is the same in every cycle, as any mismatch is.

use std::f64::consts::TAU;

use super::distribution::chi_square_tail;
use super::locate::drive;
use super::missing::{MORE_CAUTION, MOST_RECORDINGS, Mismatch, Projected};
use super::null::Null;
use super::scan::{Carrier, HIGHEST_SHARE, LOWEST, told};

/// Frequencies are half a line of the longest recording apart.
const APART: f64 = 0.5;
/// The highest, Hz.
const HIGHEST: f64 = 10.0;
/// Most of them.
const MOST: usize = 1000;
/// A chance by the scan above this needs no test.
const BY_CHANCE: f64 = 0.1;
/// Multiples of a drive.
const MULTIPLES: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

/// The stiffness, or the strength as a whole.
const CARRIERS: [Carrier; 2] = [|scene| scene.displacement, |scene| scene.force];

/// Kinds of columns of the test: the wave, and tones at its frequency, and above and below by that of the drive.
const CARRIED: usize = 0;
const THERE: usize = 1;
const ABOVE: usize = 2;
const BELOW: usize = 3;
const KINDS: usize = 4;

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Oscillating {
    /// Frequency that fits best, Hz.
    pub(super) frequency: f64,
    /// What it takes off.
    pub(super) mismatch: Mismatch,
}

impl Null<'_> {
    /// Test for what oscillates, with a phase of its own in each recording.
    ///
    /// A tone of the measurement is none: there is no test where one explains more. `None` where none could be made, or
    /// the scan shows that none is needed.
    pub(super) fn oscillating(&self) -> Option<Oscillating> {
        let campaign = self.assembly().campaign();
        let (count, sizes) = (campaign.recordings().len(), campaign.sizes());
        if count > MOST_RECORDINGS || !self.knows_its_noise() || self.broken_off() {
            return None;
        }
        let frequencies = self.frequencies();
        let tests = (CARRIERS.len() * frequencies.len()) as f64;
        let mut promising = Vec::new();
        for carrier in CARRIERS {
            let scan = self.scanned(&frequencies, Some(carrier))?;
            let excess = scan.excess();
            let Some((best, gain)) = scan.largest(&excess) else { continue };
            if tests * chi_square_tail(gain, 2 * count) < BY_CHANCE {
                promising.push((carrier, frequencies[best], gain, excess.into_iter().fold(1.0, f64::max)));
            }
        }
        if promising.is_empty() {
            return None;
        }
        let last = frequencies.last()? * sizes.duration / APART;
        let tones: Vec<f64> = (0..2 * last as usize).map(|k| APART * k as f64 / sizes.duration).collect();
        let tones = self.scanned(&tones, None)?;
        let (_, of_tones) = tones.largest(&tones.excess())?;
        let tested = promising.into_iter().filter(|(_, _, gain, _)| *gain > of_tones).map(
            |(carrier, frequency, _, excess)| {
                let Mismatch { gain, freedom, .. } = self.oscillates(carrier, frequency);
                // The largest of so many reaches about twice their logarithm more by chance.
                let (one, by_chance) =
                    (Mismatch::new(gain / (MORE_CAUTION * excess), freedom), 2.0 * tests.ln());
                let p_value = (tests * one.p_value).min(1.0);
                let mismatch = Mismatch { p_value, freedom: freedom + by_chance.ceil() as usize, ..one };
                Oscillating { frequency, mismatch }
            },
        );
        tested.max_by(|a, b| a.mismatch.gain.total_cmp(&b.mismatch.gain))
    }

    /// Frequencies that are scanned, Hz.
    fn frequencies(&self) -> Vec<f64> {
        let recordings = 0..self.assembly().campaign().recordings().len();
        let sizes = self.assembly().campaign().sizes();
        let highest = HIGHEST.min(HIGHEST_SHARE / sizes.step);
        let drives: Vec<(f64, f64)> =
            recordings.filter_map(|r| Some((drive(&self.scene(r))?, self.scene(r).duration()))).collect();
        let follows = |frequency: f64| {
            let of = |(drive, duration): &(f64, f64)| {
                MULTIPLES.iter().any(|times| (frequency - times * drive).abs() * duration < 1.0)
            };
            drives.iter().any(of)
        };
        (0..MOST)
            .map(|k| (LOWEST + APART * k as f64) / sizes.duration)
            .take_while(|frequency| *frequency < highest)
            .filter(|frequency| !follows(*frequency))
            .collect()
    }

    /// What a wave at one frequency takes off beside the tone that leaves it least: one there, where the motion is about
    /// another place than zero, or of a sinusoidal motion one on a side. A tone of the measurement shows as part of a wave.
    fn oscillates(&self, carrier: Carrier, frequency: f64) -> Mismatch {
        let count = self.assembly().campaign().recordings().len();
        let projected = self.project(KINDS * 2 * count, |view, r| {
            let scene = view.scene(r);
            if !told(&scene).contains(&frequency) {
                return Vec::new();
            }
            let waves = |frequency: f64| {
                let of =
                    |wave: fn(f64) -> f64| scene.time.iter().map(|t| wave(TAU * frequency * t)).collect();
                [of(f64::sin), of(f64::cos)]
            };
            let carried = waves(frequency).map(|wave: Vec<f64>| {
                wave.iter().zip(carrier(&scene)).map(|(wave, c)| wave * c).collect::<Vec<f64>>()
            });
            let place = |kind: usize, part: usize| (2 * kind + part) * count + r;
            let at = |kind: usize, columns: [Vec<f64>; 2]| {
                columns.into_iter().enumerate().map(move |(part, column)| (place(kind, part), column))
            };
            let sides = drive(&scene).into_iter().flat_map(|drive| {
                at(ABOVE, waves(frequency + drive)).chain(at(BELOW, waves(frequency - drive)))
            });
            at(CARRIED, carried).chain(at(THERE, waves(frequency))).chain(sides).collect()
        });
        let of = |kinds: &[usize]| {
            let places = kinds.iter().flat_map(|kind| 2 * kind * count..2 * (kind + 1) * count);
            Projected::of(&projected, &places.collect::<Vec<_>>()).gains().unwrap_or_default()
        };
        let beside = |tone: usize| {
            let ((tones, fewer), (all, more)) = (of(&[tone]), of(&[tone, CARRIED]));
            let gain = (all[0] - tones[0]).min(all[1] - tones[1]);
            Mismatch { p_value: 1.0, gain, freedom: more - fewer }
        };
        let [there, above, below] = [THERE, ABOVE, BELOW].map(beside);
        [above, below]
            .into_iter()
            .fold(there, |least, other| if other.gain < least.gain { other } else { least })
    }
}
