//! Velocity from displacement without errors-in-variables bias.
//!
//! A difference quotient of noisy displacement biases the damping coefficient towards zero, the more
//! the faster the sampling. Here a polynomial is fitted by least squares around every sample (Savitzky and
//! Golay 1964, <https://doi.org/10.1021/ac60214a047>, extended to irregular times) and the length of
//! its window is the one with the smallest generalised cross-validation error (Craven and Wahba 1979,
//! <https://doi.org/10.1007/BF01404567>).
//!
//! Known limit: displacement noise that is itself smooth cannot be told from motion.

mod another;
mod bends;
mod breaks;
mod calming;
mod corners;
mod cuts;
mod differences;
mod distortion;
mod kinks;
mod left;
mod local;
mod lost;
mod low_pass;
mod octaves;
mod parts;
mod recorded;
mod rest;
mod smoothing;
mod stencil;
mod steps;
mod together;
mod turns;
mod window;

use std::ops::Range;

use crate::recording::even_step;
pub(crate) use another::{Recorded, are_others};
use bends::{Bends, bends};
use breaks::{between, between_breaks};
pub use calming::{Calm, Calming};
use corners::corners;
pub(crate) use corners::joined;
pub(crate) use left::Left;
use local::{NARROWEST, TERMS};
pub(crate) use lost::give_back;
pub(crate) use parts::Parts;
pub(crate) use recorded::{Smoothed, smoothed};
pub use smoothing::Smoothing;
use stencil::grid;
pub(crate) use steps::Stepped;
pub(crate) use together::Together;
pub(crate) use turns::turns;
use window::Window;

/// Terms of the polynomials that are tried between corners.
const PART_TERMS: [usize; 3] = [2, 4, TERMS];

/// Between corners there are more than so many times as many samples for each term.
const CALMER: f64 = 2.0;

/// Share of the largest velocity by which a slope may swing beside a corner.
const SWUNG: f64 = 2.5e-3;
/// The same where a motion turns quickly.
const TURNED: f64 = 1e-3;

/// A derived velocity has about twice the noise and more within one part in so many of half a window from an end of its
/// recording: an effect that changes with time would seem to explain that.
pub(crate) const END: usize = 4;

/// Samples on either side of one whose slope is not resolved, of which it is not either.
const BESIDE: usize = 1;

/// A derived velocity and the window it came from.
#[derive(Debug, Clone, PartialEq)]
pub struct Derived {
    /// Velocity in mm/s.
    pub velocity: Vec<f64>,
    /// The displacement that this is the slope of, mm.
    pub displacement: Vec<f64>,
    /// Samples that its window has on either side.
    pub half: usize,
    /// Samples that have a corner or a bend of the motion in their window, on an even grid: their velocity is not to be
    /// trusted.
    pub corners: Vec<Range<usize>>,
    /// True where some of them are corners: slopes jump there, and not accelerations alone.
    pub sharp: bool,
    /// Last samples before bends that are slighter, which polynomials go across.
    pub slight: Vec<usize>,
    /// How both were derived.
    pub smoothing: Smoothing,
}

impl Derived {
    /// Length of the window in s.
    pub fn window(&self, time: &[f64]) -> f64 {
        2.0 * self.half as f64 * step(time)
    }

    /// How more noise is taken off it where it has no corners, derived from this displacement in mm.
    pub fn calming(&self, time: &[f64], displacement: &[f64]) -> Calming {
        let window = Window { half: self.half, terms: TERMS };
        Calming::of(time, displacement, [self.displacement.clone(), self.velocity.clone()], window)
    }

    /// Standard deviation in mm/s of the noise of this velocity where that of the displacement has this one in mm, on an
    /// even grid and without corners.
    pub fn noise(&self, time: &[f64], displacement: f64) -> f64 {
        let square = |(part, window): &(Range<usize>, Window)| {
            // No window at an end reaches the one sample.
            let around = 4 * window.half + 3;
            let even: Vec<f64> = (0..around).map(|i| i as f64 * step(time)).collect();
            let mut one = vec![0.0; around];
            one[2 * window.half + 1] = displacement;
            let slopes = window.over(&even, &one).0;
            slopes.iter().map(|v| v * v).sum::<f64>() * part.len() as f64
        };
        (self.smoothing.0.iter().map(square).sum::<f64>() / time.len() as f64).sqrt()
    }

    /// Samples of a motion, derived from this displacement in mm, where it turns within fewer samples than
    /// give a slope, or has a slight bend: about them polynomials and differences give another.
    pub fn unresolved(&self, time: &[f64], displacement: &[f64]) -> Vec<Range<usize>> {
        let noise = self.smoothing.variance(displacement, &self.displacement).sqrt();
        let missed = differences::missed(time, displacement, &self.velocity, noise, TURNED);
        let around = |(i, _): (usize, f64)| around(i, time.len());
        // As far as a window has a slight bend in it.
        let across = |i: &usize| {
            let own = |(part, window): &(Range<usize>, Window)| part.contains(i).then_some(window.half);
            let reach = self.smoothing.0.iter().rev().find_map(own).unwrap_or(0);
            (i + 1).saturating_sub(reach)..(i + 1 + reach).min(time.len())
        };
        joined(missed.into_iter().map(around).chain(self.slight.iter().map(across)).collect())
    }
}

/// A sample of so many whose slope is not resolved, and those beside it.
fn around(i: usize, samples: usize) -> Range<usize> {
    i.saturating_sub(BESIDE)..(i + BESIDE + 1).min(samples)
}

/// Mean step of times in s.
fn step(time: &[f64]) -> f64 {
    (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64
}

/// So many samples in parts, cut after some of them.
fn cut(after: &[usize], samples: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = std::iter::once(0).chain(after.iter().map(|i| i + 1));
    let ends = after.iter().map(|i| i + 1).chain(std::iter::once(samples));
    starts.zip(ends).map(|(start, end)| start..end)
}

/// Velocity in mm/s at every sample of a displacement in mm at strictly increasing times in s.
///
/// # Panics
/// Never for at least five samples of equal count in both slices.
pub fn from_displacement(time: &[f64], displacement: &[f64]) -> Derived {
    if let Some(derived) = between_breaks(time, displacement) {
        return derived;
    }
    let window = Window::best(time, displacement, usize::MAX, &[TERMS]);
    let smoothing = Smoothing(vec![(0..time.len(), window)]);
    let (velocity, smooth) = smoothing.over(time, displacement);
    let corners = Vec::new();
    let mut derived = Derived {
        velocity,
        displacement: smooth,
        half: window.half,
        corners,
        sharp: false,
        slight: Vec::new(),
        smoothing,
    };
    if even_step(time).is_ok() {
        between_corners(&mut derived, time, displacement, window);
        if derived.corners.is_empty() && grid(time).is_some() {
            let variance = derived.smoothing.variance(displacement, &derived.displacement);
            let Bends { after, sharp, slight } = bends(time, displacement, variance, window.half);
            derived.slight.clone_from(&slight);
            if !after.is_empty() {
                derived = Derived { sharp, slight, ..between(&after, time, displacement, &[TERMS]) };
                let unresolved = derived.unresolved(time, displacement);
                derived.corners = joined(derived.corners.into_iter().chain(unresolved).collect());
            }
        }
    }
    derived
}

/// Between true corners the motion is smoother than with them: there it is smoothed part by part. Otherwise there
/// are no corners.
fn between_corners(derived: &mut Derived, time: &[f64], displacement: &[f64], whole: Window) {
    let variance = derived.smoothing.variance(displacement, &derived.displacement);
    let corners = corners(displacement, variance, whole.half);
    let parts: Vec<(Range<usize>, Window)> = corners
        .windows(2)
        .map(|pair| pair[0].end..pair[1].start)
        .filter(|part| part.len() > 2 * NARROWEST)
        .map(|part| {
            let (time, x) = (&time[part.clone()], &displacement[part.clone()]);
            (part, Window::knowing(variance, time, x, &PART_TERMS))
        })
        .collect();
    let samples = |of: &dyn Fn(&Window) -> bool| -> usize {
        parts.iter().filter(|(_, own)| of(own)).map(|(part, _)| part.len()).sum()
    };
    if corners.is_empty() || 2 * samples(&|own| own.calm() > CALMER * whole.calm()) < samples(&|_| true) {
        return;
    }
    derived.sharp = true;
    derived.smoothing.0.extend(parts);
    (derived.velocity, derived.displacement) = derived.smoothing.over(time, displacement);
    let doubted = differences::missed(time, displacement, &derived.velocity, variance.sqrt(), SWUNG);
    // What has a memory needs all of the way, there too.
    for (i, difference) in &doubted {
        derived.velocity[*i] = *difference;
    }
    let doubted = doubted.into_iter().map(|(i, _)| i..i + 1);
    derived.corners = joined(corners.into_iter().chain(doubted).collect());
}
