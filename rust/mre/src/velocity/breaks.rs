//! Corners between two samples of a motion: slopes of the displacement jump there, and polynomials across one ring.

use std::ops::Range;

use super::corners::corners;
use super::smoothing::Smoothing;
use super::window::Window;
use super::{Derived, END, PART_TERMS, joined};
use crate::kernel::jumps::{ALONE, IN_TWO, STANDS_OUT, even, sharp, usual_change};

/// The last samples before corners of a displacement in mm, in rising order. One within two samples of an end is not seen.
fn breaks(time: &[f64], displacement: &[f64]) -> Vec<usize> {
    let pairs = time.windows(2).zip(displacement.windows(2));
    let slopes: Vec<f64> = pairs.map(|(t, x)| (x[1] - x[0]) / (t[1] - t[0])).collect();
    let usual = usual_change(&slopes);
    let largest = slopes.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let stands_out = |i: usize, wide: (usize, f64)| {
        let jump = || (slopes[i + wide.0] - slopes[i]).abs();
        sharp(&slopes, largest, i, wide) && jump() > STANDS_OUT * usual && even(time, i, wide)
    };
    let mut found: Vec<usize> = Vec::new();
    for i in 0..slopes.len() {
        if stands_out(i, ALONE) {
            // Beside a sample, in the interval whose slope has a little of both.
            let mixed = |a: usize, b: usize| (slopes[a] - slopes[b]).abs();
            found.push(if mixed(i - 1, i) > mixed(i + 1, i + 2) { i } else { i + 1 });
        } else if stands_out(i, IN_TWO) {
            found.push(i + 1);
        }
    }
    found.dedup();
    found
}

/// Velocity and displacement between corners, each part on its own; `None` where there are no corners, or others.
pub(super) fn between_breaks(time: &[f64], displacement: &[f64]) -> Option<Derived> {
    let breaks = breaks(time, displacement);
    if breaks.is_empty() {
        return None;
    }
    let derived = between(&breaks, time, displacement, &PART_TERMS);
    // A corner that is rounded, or lost in noise.
    let others = |(part, window): &(Range<usize>, Window)| {
        let x = &displacement[part.clone()];
        let own = Smoothing(vec![(0..part.len(), *window)]);
        !corners(x, own.variance(x, &derived.displacement[part.clone()]), window.half).is_empty()
    };
    (!derived.smoothing.0.iter().any(others)).then_some(Derived { sharp: true, ..derived })
}

/// Velocity and displacement of a motion that is cut after these samples, each part on its own.
pub(super) fn between(after: &[usize], time: &[f64], displacement: &[f64], terms: &[usize]) -> Derived {
    let smoothing = Smoothing::between(after, time, displacement, terms);
    let (velocity, smooth) = smoothing.over(time, displacement);
    let mut doubted = Vec::new();
    for (part, window) in &smoothing.0 {
        let noisy = window.half.div_ceil(END).min(part.len());
        doubted.extend([part.start..part.start + noisy, part.end - noisy..part.end]);
    }
    let half = smoothing.half();
    let (corners, slight) = (joined(doubted), Vec::new());
    Derived { velocity, displacement: smooth, half, corners, sharp: false, slight, smoothing }
}

#[cfg(test)]
mod tests {
    use super::super::from_displacement;
    use super::breaks;

    #[test]
    fn the_velocity_of_a_triangle_is_that_of_its_flanks() {
        let motion = |t: f64| 4.0 / std::f64::consts::PI * (std::f64::consts::TAU * t).sin().asin();
        for samples in [24.3, 30.0, 61.7, 200.0] {
            // Six cycles, that end on a flank.
            let time: Vec<f64> =
                (0..2000).map(|i| f64::from(i) / samples + 0.013).take_while(|t| *t < 6.0).collect();
            let x: Vec<f64> = time.iter().map(|t| motion(*t)).collect();
            let derived = from_displacement(&time, &x);
            for (i, v) in derived.velocity.iter().enumerate() {
                let phase = (time[i] + 0.25).rem_euclid(1.0);
                let wanted = if phase < 0.5 { 8.0 } else { -8.0 };
                let known = derived.corners.iter().any(|range| range.contains(&i));
                assert!(known || (v - wanted).abs() < 1e-6, "{v} at sample {i} of {samples} a cycle");
            }
            let left_out: usize = derived.corners.iter().map(ExactSizeIterator::len).sum();
            assert!(3 * left_out < time.len(), "{left_out} of {} samples", time.len());
        }
    }

    #[test]
    fn smooth_and_noisy_motions_have_no_corner() {
        let time: Vec<f64> = (0..3000).map(|i| f64::from(i) / 100.0).collect();
        let noise = |i: usize| 0.02 * ((i * i) as f64 * 0.618).sin();
        for frequency in [0.3, 1.0, 5.0, 16.0] {
            let sine = |t: f64| 5.0 * (std::f64::consts::TAU * frequency * t).sin();
            let x: Vec<f64> = time.iter().map(|t| sine(*t)).collect();
            assert_eq!(breaks(&time, &x), [], "{frequency} Hz");
            let noisy: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + noise(i)).collect();
            assert_eq!(breaks(&time, &noisy), [], "{frequency} Hz with noise");
        }
    }

    #[test]
    fn two_samples_after_the_last_corner_are_left_out() {
        let motion = |t: f64| 4.0 / std::f64::consts::PI * (std::f64::consts::TAU * t).sin().asin();
        let time: Vec<f64> = (0..1053).map(|i| f64::from(i) / 200.0).collect();
        let x: Vec<f64> = time.iter().map(|t| motion(*t)).collect();
        let derived = from_displacement(&time, &x);
        assert!(derived.corners.iter().any(|range| range.end == 1053), "{:?}", derived.corners);
        let parts = super::super::Parts::of(&time, &x, &derived);
        let calm = parts.calm(&time, &x, &derived);
        assert!(calm.velocity.iter().all(|v| v.is_finite() && v.abs() < 8.1));
    }
}
