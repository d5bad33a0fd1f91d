//! Excitations that a test machine can follow, within limits.

use std::f64::consts::{PI, TAU};

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::limits::Limits;

/// Kinds of excitation, the plainest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A slow sine of full stroke.
    SlowSine,
    /// A sine at the highest frequency, as large as the speed allows.
    FastSine,
    /// Sines of rising and falling amplitude with rests.
    Amplitudes,
    /// A sine of full stroke, a rest, and the sine again.
    Rest,
    /// A sine whose frequency rises, as large as stroke and speed allow.
    Sweep,
    /// A step away from the middle, held.
    Hold,
    /// Odd random-phase multisine: odd harmonics of a slow sine with random phases.
    Multisine,
    /// A sine under steps of the current, up and down.
    CurrentSteps,
}

/// All kinds.
pub const KINDS: [Kind; 8] = [
    Kind::SlowSine,
    Kind::FastSine,
    Kind::Amplitudes,
    Kind::Rest,
    Kind::Sweep,
    Kind::Hold,
    Kind::Multisine,
    Kind::CurrentSteps,
];

/// Levels of [`Kind::Amplitudes`], as shares of the stroke.
const LEVELS: [f64; 7] = [0.15, 0.35, 0.65, 1.0, 0.65, 0.35, 0.15];
/// Levels of [`Kind::CurrentSteps`], as shares of the range.
const CURRENTS: [f64; 6] = [0.0, 0.5, 1.0, 0.5, 0.0, 1.0];
/// Time over which a motion starts and ends, s.
const RAMP: f64 = 1.0;
/// Cycles of the slowest sine.
const SLOW_CYCLES: f64 = 4.0;
/// A sine's cycle has so much of a sample more than a whole number of them, a golden section: samples at the same phases in
/// every cycle, a turn among them, would show less of it.
const GOLDEN: f64 = 0.381_966;
/// Ratio of neighbouring frequencies of a multisine.
const SPACING: f64 = 1.25;

/// A command signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// s.
    pub time: Vec<f64>,
    /// mm.
    pub displacement: Vec<f64>,
    /// A, where it is commanded.
    pub current: Option<Vec<f64>>,
    /// Frequency of the drive, or the highest in it, Hz.
    pub frequency: f64,
    /// Largest displacement, mm.
    pub amplitude: f64,
}

impl Kind {
    /// As in `diagnosis.json`.
    pub fn id(self) -> &'static str {
        match self {
            Self::SlowSine => "slow_sine",
            Self::FastSine => "fast_sine",
            Self::Amplitudes => "rising_and_falling_amplitudes",
            Self::Rest => "sine_before_and_after_a_rest",
            Self::Sweep => "sweep",
            Self::Hold => "hold",
            Self::Multisine => "multisine",
            Self::CurrentSteps => "current_steps",
        }
    }

    /// The signal, at so many times the rate of the limits; `None` where these leave no room for it.
    pub fn signal(self, limits: &Limits, times: usize) -> Option<Signal> {
        let Limits { stroke, speed, highest, duration, current, .. } = *limits;
        let rate = times as f64 * limits.rate;
        let apart = |f: f64| limits.rate / ((limits.rate / f - GOLDEN).ceil() + GOLDEN);
        let fast = apart(highest);
        let slow = apart(SLOW_CYCLES / duration).min(fast);
        // The frequency at which full stroke needs half the speed.
        let middle = apart(0.5 * speed / (TAU * stroke)).clamp(slow, fast);
        let largest = |f: f64| stroke.min(speed / (TAU * f));
        let count = (duration * rate).round() as usize;
        let time: Vec<f64> = (0..count).map(|i| i as f64 / rate).collect();
        let sine = |f: f64| time.iter().map(|t| largest(f) * (TAU * f * t).sin()).collect::<Vec<f64>>();
        let (motion, frequency): (Vec<f64>, f64) = match self {
            Self::SlowSine => (sine(slow), slow),
            Self::FastSine => (sine(fast), fast),
            Self::Amplitudes => (amplitudes(&time, duration, middle, stroke), middle),
            Self::Rest => (rest(&sine(middle), &time, duration), middle),
            Self::Sweep => (sweep(&time, duration, (slow, highest), (stroke, speed)), highest),
            Self::Hold => (time.iter().map(|t| 0.8 * stroke * smooth((t - RAMP) / RAMP)).collect(), slow),
            Self::Multisine => (multisine(&time, slow, highest), highest),
            Self::CurrentSteps => (sine(middle), middle),
        };
        let current = match (self, current) {
            (Self::CurrentSteps, None) => return None,
            (Self::CurrentSteps, Some((low, high))) => Some(
                time.iter()
                    .map(|t| {
                        let step = (t / duration * CURRENTS.len() as f64) as usize;
                        low + (high - low) * CURRENTS[step.min(CURRENTS.len() - 1)]
                    })
                    .collect(),
            ),
            _ => None,
        };
        let ramped: Vec<f64> = motion
            .iter()
            .zip(&time)
            .map(|(x, t)| {
                let end = if self == Self::Hold { 1.0 } else { smooth((duration - t) / RAMP) };
                x * smooth(t / RAMP) * end
            })
            .collect();
        let displacement = within(ramped, limits, rate);
        let amplitude = displacement.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        Some(Signal { time, displacement, current, frequency, amplitude })
    }
}

/// From zero to one with continuous slope and bend: where the bend jumps, what models make of it between the samples
/// differs.
fn smooth(share: f64) -> f64 {
    let s = share.clamp(0.0, 1.0);
    s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
}

/// Scaled into stroke and speed.
fn within(motion: Vec<f64>, limits: &Limits, rate: f64) -> Vec<f64> {
    let far = motion.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let fast = motion.windows(2).fold(0.0_f64, |m, p| m.max((p[1] - p[0]).abs())) * rate;
    let share = (far / limits.stroke).max(fast / limits.speed).max(1.0);
    motion.into_iter().map(|x| x / share).collect()
}

fn amplitudes(time: &[f64], duration: f64, frequency: f64, stroke: f64) -> Vec<f64> {
    let each = duration / LEVELS.len() as f64;
    // The last fifth of each level is a rest; the motion is whole cycles long.
    let cycles = (0.8 * each * frequency).floor().max(1.0);
    let moving = (cycles / frequency).min(0.95 * each);
    time.iter()
        .map(|t| {
            let k = ((t / each) as usize).min(LEVELS.len() - 1);
            let own = t - k as f64 * each;
            let rise = (1.0 / frequency).min(0.25 * moving);
            let ends = smooth(own / rise) * smooth((moving - own) / rise);
            stroke * LEVELS[k] * ends * (TAU * frequency * own).sin()
        })
        .collect()
}

/// The motion, with its middle third at rest.
fn rest(motion: &[f64], time: &[f64], duration: f64) -> Vec<f64> {
    let moving = |t: f64| smooth((duration / 3.0 - t) / RAMP) + smooth((t - 2.0 * duration / 3.0) / RAMP);
    motion.iter().zip(time).map(|(x, t)| x * moving(*t)).collect()
}

fn sweep(time: &[f64], duration: f64, (low, high): (f64, f64), (stroke, speed): (f64, f64)) -> Vec<f64> {
    let growth = (high / low).max(1.0 + 1e-9).ln() / duration;
    let corner = speed / (TAU * stroke);
    // The smaller of what stroke and speed allow, without the corner between them.
    let largest = |f: f64| stroke * (1.0 + (f / corner).powi(8)).powf(-0.125);
    time.iter()
        .map(|t| {
            let f = low * (growth * t).exp();
            largest(f) * (TAU * (f - low) / growth).sin()
        })
        .collect()
}

/// Odd harmonics of half the slowest frequency, about evenly in the logarithm, each with the same speed.
fn multisine(time: &[f64], slow: f64, highest: f64) -> Vec<f64> {
    let mut stream = ChaCha8Rng::seed_from_u64(1);
    let mut found = vec![0.0; time.len()];
    let mut wanted = slow;
    while wanted <= highest {
        let harmonic = 2.0 * (wanted / slow).floor() + 1.0;
        let f = 0.5 * slow * harmonic;
        let phase = TAU * f64::from(stream.next_u32()) / f64::from(u32::MAX);
        for (x, t) in found.iter_mut().zip(time) {
            *x += (TAU * f * t + phase).sin() / f;
        }
        wanted = (wanted * SPACING).max(wanted + slow);
    }
    let far = found.iter().fold(f64::MIN_POSITIVE, |m: f64, x| m.max(x.abs()));
    // More than any stroke: what is too large is scaled down.
    found.into_iter().map(|x| 1e3 * PI * x / far).collect()
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use super::*;

    fn limits(rate: f64) -> Limits {
        Limits { stroke: 5.0, speed: 40.0, highest: 8.0, duration: 20.0, rate, current: Some((0.0, 3.0)) }
    }

    #[test]
    fn every_signal_keeps_its_limits_and_starts_at_rest() {
        let limits = limits(200.0);
        for kind in KINDS {
            let signal = kind.signal(&limits, 1).expect("room");
            assert_eq!(signal.time.len(), 4000);
            assert_eq!(signal.displacement[0], 0.0, "{kind:?}");
            let far = signal.displacement.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let fast =
                signal.displacement.windows(2).fold(0.0_f64, |m, p| m.max((p[1] - p[0]).abs())) * 200.0;
            assert!(far <= 5.0 + 1e-9 && fast <= 40.0 + 1e-9, "{kind:?} {far} {fast}");
            assert!(far > 0.1, "{kind:?} {far}");
            let resting = signal.displacement[1500..2500].iter().all(|x| *x == 0.0);
            assert_eq!(resting, kind == Kind::Rest, "{kind:?}");
        }
        assert!(Kind::CurrentSteps.signal(&Limits { current: None, ..limits }, 1).is_none());
    }

    #[test]
    fn few_samples_are_at_the_turn_of_a_sine() {
        // Twenty and forty to a cycle.
        for rate in [160.0, 320.0] {
            let Signal { displacement, time, .. } = Kind::FastSine.signal(&limits(rate), 1).expect("room");
            let velocity: Vec<f64> = displacement.windows(3).map(|w| w[2] - w[0]).collect();
            let turns = velocity.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
            assert!(turns > time.len() / 25, "{turns}");
            // By chance one of 25.
            assert!(15 * crate::velocity::turns(&velocity).len() < turns, "{rate}: {turns}");
        }
    }

    #[test]
    fn a_finer_signal_is_the_same_motion() {
        for kind in KINDS {
            let [coarse, fine] = [1, 5].map(|times| kind.signal(&limits(200.0), times).expect("room"));
            assert_eq!(coarse.frequency, fine.frequency);
            let apart = coarse.displacement.iter().zip(fine.displacement.iter().step_by(5));
            let apart = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // Scaled by its steepest step, which a finer one has steeper.
            assert!(apart < 0.02 * coarse.amplitude, "{kind:?}: {apart}");
        }
    }

    #[test]
    fn no_acceleration_jumps() {
        let turn = |signal: &Signal| {
            let third = |w: &[f64]| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).abs();
            signal.displacement.windows(4).map(third).fold(0.0, f64::max)
        };
        for kind in KINDS {
            let [coarse, fine] =
                [2000.0, 4000.0].map(|rate| turn(&kind.signal(&limits(rate), 1).expect("room")));
            // An eighth; of a jump of the acceleration a quarter.
            assert!((7.0..9.0).contains(&(coarse / fine)), "{kind:?}: {coarse} {fine}");
        }
    }
}
