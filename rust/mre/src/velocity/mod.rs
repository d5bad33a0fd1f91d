//! Velocity from displacement without errors-in-variables bias.
//!
//! A difference quotient of noisy displacement biases the damping coefficient towards zero, the more
//! the faster the sampling. Here a polynomial is fitted by least squares around every sample (Savitzky and
//! Golay 1964, <https://doi.org/10.1021/ac60214a047>, extended to irregular times) and the length of
//! its window is the one with the smallest generalised cross-validation error (Craven and Wahba 1979,
//! <https://doi.org/10.1007/BF01404567>).
//!
//! Known limit: displacement noise that is itself smooth cannot be told from motion.

mod corners;
mod differences;
mod local;
mod low_pass;
mod octaves;
mod stencil;
mod window;

use std::ops::Range;

use crate::recording::even_step;
pub(crate) use corners::joined;
use corners::{corners, variance};
use local::{NARROWEST, TERMS};
pub use octaves::{Calm, Calming};
use window::Window;

/// Terms of the polynomials that are tried between corners.
const PART_TERMS: [usize; 3] = [2, 4, TERMS];

/// Between corners there are more than so many times as many samples for each term.
const CALMER: f64 = 2.0;

/// Share of the largest velocity by which a slope may swing beside a corner.
const SWUNG: f64 = 2.5e-3;
/// The same where a motion turns quickly.
const TURNED: f64 = 1e-3;

/// Samples on either side of one whose slope is not resolved, of which it is not either.
const BESIDE: usize = 1;

/// Widest half window in samples of what a displacement has beside its velocity.
const WIDEST: usize = 200;

/// Noise below this share of a series, rms, is left in it.
const NEGLIGIBLE: f64 = 1e-4;

/// Noise has a median square above this share of its mean square; that of Gaussian noise is 0.45.
const EVERYWHERE: f64 = 0.1;

/// A derived velocity and the window it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Derived {
    /// Velocity in mm/s.
    pub velocity: Vec<f64>,
    /// The displacement that this is the slope of, mm.
    pub displacement: Vec<f64>,
    /// Samples that its window has on either side.
    pub half: usize,
    /// Samples that have a corner of the motion in their window, on an even grid: their velocity is not to be
    /// trusted.
    pub corners: Vec<Range<usize>>,
}

impl Derived {
    /// Length of the window in s.
    pub fn window(&self, time: &[f64]) -> f64 {
        2.0 * self.half as f64 * step(time)
    }

    /// Samples of a motion without corners, derived from this displacement in mm, where it turns within fewer samples than
    /// give a slope: about them polynomials and differences give another.
    pub fn unresolved(&self, time: &[f64], displacement: &[f64]) -> Vec<Range<usize>> {
        let noise = variance(displacement, &self.displacement, self.half).sqrt();
        let missed = differences::missed(time, displacement, &self.velocity, noise, TURNED);
        let around = |(i, _): (usize, f64)| i.saturating_sub(BESIDE)..(i + BESIDE + 1).min(time.len());
        joined(missed.into_iter().map(around).collect())
    }
}

/// Mean step of times in s.
fn step(time: &[f64]) -> f64 {
    (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64
}

/// Velocity in mm/s at every sample of a displacement in mm at strictly increasing times in s.
///
/// # Panics
/// Never for at least five samples of equal count in both slices.
pub fn from_displacement(time: &[f64], displacement: &[f64]) -> Derived {
    let window = Window::best(time, displacement, usize::MAX, &[TERMS]);
    let (velocity, smooth) = window.over(time, displacement);
    let mut derived = Derived { velocity, displacement: smooth, half: window.half, corners: Vec::new() };
    if even_step(time).is_ok() {
        between_corners(&mut derived, time, displacement, window);
    }
    derived
}

/// Displacement in mm less the noise that a recorded velocity in mm/s does not share.
///
/// What the displacement has beside the integral of the velocity is smoothed, over a window that keeps all of it
/// that is not noise: drift of the integral, and any motion that the velocity misses.
pub fn without_noise(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Vec<f64> {
    let travelled = integral(time, velocity);
    let beside: Vec<f64> = displacement.iter().zip(&travelled).map(|(x, s)| x - s).collect();
    let kept = smooth(time, &beside, WIDEST);
    let found: Vec<f64> = kept.iter().zip(&travelled).map(|(d, s)| d + s).collect();
    // The integral has an error as well.
    if apart(&found, displacement) { found } else { displacement.to_vec() }
}

/// A recorded velocity in mm/s less its noise, where it has some everywhere: jumps are none.
pub fn smoothed(time: &[f64], velocity: &[f64]) -> Vec<f64> {
    let found = smooth(time, velocity, WIDEST);
    let mut taken: Vec<f64> = found.iter().zip(velocity).map(|(a, b)| (a - b).powi(2)).collect();
    let mean = taken.iter().sum::<f64>() / taken.len() as f64;
    let middle = taken.len() / 2;
    let (_, median, _) = taken.select_nth_unstable_by(middle, f64::total_cmp);
    if apart(&found, velocity) && *median > EVERYWHERE * mean { found } else { velocity.to_vec() }
}

/// True where what was taken off a series is noise worth the change.
fn apart(found: &[f64], series: &[f64]) -> bool {
    let taken: f64 = found.iter().zip(series).map(|(a, b)| (a - b).powi(2)).sum();
    let size: f64 = series.iter().map(|x| x * x).sum();
    taken > NEGLIGIBLE.powi(2) * size
}

/// Integral from the first sample, by cubics through the values with the slopes of their neighbours.
fn integral(time: &[f64], values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(last));
        (values[b] - values[a]) / (time[b] - time[a])
    };
    let mut sum = 0.0;
    std::iter::once(0.0)
        .chain((1..=last).map(|i| {
            let h = time[i] - time[i - 1];
            sum += 0.5 * h * (values[i - 1] + values[i]) + h * h / 12.0 * (slope(i - 1) - slope(i));
            sum
        }))
        .collect()
}

/// A series less its noise, over windows of at most this half width.
fn smooth(time: &[f64], series: &[f64], widest: usize) -> Vec<f64> {
    Window::best(time, series, widest, &[TERMS]).over(time, series).1
}

/// Between true corners the motion is smoother than with them: there it is smoothed part by part. Otherwise there
/// are no corners.
fn between_corners(derived: &mut Derived, time: &[f64], displacement: &[f64], whole: Window) {
    let corners = corners(displacement, &derived.displacement, whole.half);
    let parts: Vec<(Range<usize>, Window)> = corners
        .windows(2)
        .map(|pair| pair[0].end..pair[1].start)
        .filter(|part| part.len() > 2 * NARROWEST)
        .map(|part| {
            let (time, x) = (&time[part.clone()], &displacement[part.clone()]);
            (part, Window::best(time, x, usize::MAX, &PART_TERMS))
        })
        .collect();
    let samples = |of: &dyn Fn(&Window) -> bool| -> usize {
        parts.iter().filter(|(_, own)| of(own)).map(|(part, _)| part.len()).sum()
    };
    if corners.is_empty() || 2 * samples(&|own| own.calm() > CALMER * whole.calm()) < samples(&|_| true) {
        return;
    }
    let noise = variance(displacement, &derived.displacement, whole.half).sqrt();
    for (part, own) in parts {
        let (velocity, smooth) = own.over(&time[part.clone()], &displacement[part.clone()]);
        derived.velocity[part.clone()].copy_from_slice(&velocity);
        derived.displacement[part].copy_from_slice(&smooth);
    }
    let doubted = differences::missed(time, displacement, &derived.velocity, noise, SWUNG);
    // What has a memory needs all of the way, there too.
    for (i, difference) in &doubted {
        derived.velocity[*i] = *difference;
    }
    let doubted = doubted.into_iter().map(|(i, _)| i..i + 1);
    derived.corners = joined(corners.into_iter().chain(doubted).collect());
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 5 mm at 1 Hz on 200 Hz, with noise of this size in mm that repeats after 101 samples.
    fn shaken(size: f64) -> [Vec<f64>; 4] {
        let turn = std::f64::consts::TAU;
        let time: Vec<f64> = (0..2000).map(|i| f64::from(i) / 200.0).collect();
        let truth: Vec<f64> = time.iter().map(|t| 5.0 * (turn * t).sin()).collect();
        let velocity = time.iter().map(|t| 5.0 * turn * (turn * t).cos()).collect();
        let noise = |i: usize| size * (f64::from((i * 37 % 101) as u32) / 50.0 - 1.0);
        let shown = truth.iter().enumerate().map(|(i, x)| x + noise(i)).collect();
        [time, shown, velocity, truth]
    }

    fn rms(a: &[f64], b: &[f64]) -> f64 {
        (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
    }

    #[test]
    fn noise_that_the_velocity_does_not_share_is_taken_off() {
        let [time, shown, velocity, truth] = shaken(0.01);
        let found = without_noise(&time, &shown, &velocity);
        assert!(rms(&found, &truth) < 0.2 * rms(&shown, &truth));
    }

    #[test]
    fn an_offset_and_a_motion_that_the_velocity_misses_stay() {
        let [time, shown, velocity, truth] = shaken(0.01);
        // A velocity sensor of 3 % too much, and a zero that is elsewhere.
        let much: Vec<f64> = velocity.iter().map(|v| 1.03 * v).collect();
        let apart: Vec<f64> = shown.iter().map(|x| x + 2.0).collect();
        let wanted: Vec<f64> = truth.iter().map(|x| x + 2.0).collect();
        assert!(rms(&without_noise(&time, &apart, &much), &wanted) < 0.5 * rms(&shown, &truth));
    }

    #[test]
    fn a_motion_without_noise_stays_to_the_bit() {
        let [time, shown, velocity, _] = shaken(0.0);
        assert_eq!(without_noise(&time, &shown, &velocity), shown);
        assert_eq!(smoothed(&time, &velocity), velocity);
    }

    #[test]
    fn noise_of_a_velocity_is_taken_off_and_its_jumps_stay() {
        let [time, noisy, _, truth] = shaken(0.05);
        assert!(rms(&smoothed(&time, &noisy), &truth) < 0.5 * rms(&noisy, &truth));
        let triangle: Vec<f64> = truth.iter().map(|x| x.signum()).collect();
        assert_eq!(smoothed(&time, &triangle), triangle);
    }
}
