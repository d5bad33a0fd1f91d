//! A series that may step, as a current does, without its noise.

use std::ops::Range;

use rand_chacha::ChaCha8Rng;

use super::PART_TERMS;
use super::local::{NARROWEST, TERMS};
use super::recorded::everywhere;
use super::smoothing::Smoothing;
use super::window::Window;
use crate::deviate::normal;
use crate::kernel::filter::third_differences;
use crate::spread::deviation;

/// Sum of squares of the weights of a third difference.
const THIRD: f64 = 20.0;
/// Standard deviations of a difference that a step is at least.
const STANDS_OUT: f64 = 6.0;
/// And so many times what changes on one side of it, less this many of them.
const SHARPER: f64 = 4.0;
const USUAL: f64 = 2.5;
/// Changes on a side.
const BESIDE: usize = 2;

/// How noise was taken off a series that may step: the same way off everything that is added to it.
#[derive(Debug, Clone)]
pub(crate) struct Stepped {
    smoothing: Smoothing,
    /// Standard deviation of the noise that the series had.
    noise: f64,
}

impl Stepped {
    /// How it is taken off a series at times in s, and what is left; `None` where it has none.
    ///
    /// The windows are a third as wide as those of the least error: what a current that follows the motion loses at its kinks
    /// goes with the motion as well, and is no noise.
    pub(crate) fn of(time: &[f64], series: &[f64]) -> Option<(Self, Vec<f64>)> {
        let noise = deviation(&third_differences(series)) / THIRD.sqrt();
        if noise <= 0.0 {
            return None;
        }
        let after = steps_in_noise(series, noise);
        let mut smoothing = if after.is_empty() {
            Smoothing(vec![(0..time.len(), Window::best(time, series, usize::MAX, &[TERMS]))])
        } else {
            Smoothing::between(&after, time, series, &PART_TERMS)
        };
        for (_, window) in &mut smoothing.0 {
            window.half = (window.half / 3).max(NARROWEST.min(window.half));
        }
        let (_, smooth) = smoothing.over(time, series);
        let noise = smoothing.noise(series, &smooth).0;
        everywhere(&smooth, series).then_some((Self { smoothing, noise }, smooth))
    }

    /// What is left of as much noise as there was, drawn anew.
    pub(crate) fn drawn(&self, time: &[f64], stream: &mut ChaCha8Rng) -> Vec<f64> {
        let noise: Vec<f64> = time.iter().map(|_| self.noise * normal(stream)).collect();
        self.smoothing.over(time, &noise).1
    }
}

/// The last samples before steps of a series whose noise has this standard deviation: at least one side of a step is
/// quieter.
fn steps_in_noise(series: &[f64], noise: f64) -> Vec<usize> {
    let changes: Vec<f64> = series.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let noise = std::f64::consts::SQRT_2 * noise;
    let stands_out = |i: &usize| {
        let change = changes[*i];
        let quieter = |side: Range<usize>| {
            let largest = changes[side].iter().fold(0.0_f64, |largest, c| largest.max(*c));
            change > STANDS_OUT * noise + SHARPER * (largest - USUAL * noise).max(0.0)
        };
        quieter(i.saturating_sub(BESIDE)..*i) || quieter(i + 1..(i + 1 + BESIDE).min(changes.len()))
    };
    (0..changes.len()).filter(stands_out).collect()
}

#[cfg(test)]
mod tests {
    use super::super::together::tests::rms;
    use super::*;

    /// 8 s at 200 Hz, and with noise of 10 mA.
    fn measured(of: impl Fn(f64) -> f64) -> [Vec<f64>; 3] {
        let time: Vec<f64> = (0..1600).map(|i| f64::from(i) / 200.0).collect();
        let noise = |i: usize| {
            let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
            0.01 * 12.0_f64.sqrt() * (x - x.floor() - 0.5)
        };
        let truth: Vec<f64> = time.iter().map(|t| of(*t)).collect();
        let shown = truth.iter().enumerate().map(|(i, value)| value + noise(i)).collect();
        [time, truth, shown]
    }

    fn stepped(t: f64) -> f64 {
        [0.0, 2.0, 1.0, 3.0, 0.5, 2.0][(t / 1.3 + 1e-9) as usize % 6]
    }

    #[test]
    fn noise_is_taken_off_a_smooth_current_and_off_one_that_steps() {
        let smooth = |t: f64| 1.5 + 1.2 * (std::f64::consts::TAU * 0.9 * t).sin();
        // Steps that a driver follows with 30 ms.
        let late = |t: f64| {
            let since = t % 1.3;
            let before = stepped((t - since - 0.1).max(0.0));
            stepped(t) + (before - stepped(t)) * (-since / 0.03).exp()
        };
        for (of, share) in [(&smooth as &dyn Fn(f64) -> f64, 0.3), (&stepped, 0.2), (&late, 0.6)] {
            let [time, truth, shown] = measured(of);
            let calm = Stepped::of(&time, &shown).map_or_else(|| shown.clone(), |(_, calm)| calm);
            let left = rms(&calm, &truth) / rms(&shown, &truth);
            assert!(left < share, "{left}");
        }
    }

    #[test]
    fn a_command_has_none() {
        let chatter = |t: f64| if ((t * 7.3).sin() * (t * 3.1).cos()) > 0.1 { 2.0 } else { 0.0 };
        for of in [&stepped as &dyn Fn(f64) -> f64, &chatter] {
            let [time, truth, _] = measured(of);
            assert!(Stepped::of(&time, &truth).is_none());
        }
    }
}
