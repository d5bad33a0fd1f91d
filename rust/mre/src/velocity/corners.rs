//! Corners of a motion: within a window of them no smooth polynomial gives the velocity.

use std::ops::Range;

/// Share of the squares around a corner that a broken line leaves at most. Of a sine it leaves 1.28 % at least, at
/// any length of the window; of several tones it may leave less.
const SHARE: f64 = 0.011;
/// What a straight line leaves outside the window at most: so many variances of the noise, and this share of how
/// far the motion goes there.
const NOISE: f64 = 2.0;
const STRAIGHT: f64 = 1e-3;
/// Half widths of the window over which a corner is looked at: a round one is told from a smooth motion over more,
/// and a short motion has only less.
const REACHES: [usize; 2] = [2, 3];
/// Share of a displacement that its own arithmetic does not resolve.
const EXACT: f64 = 1e-9;

/// Samples within `half` samples of a corner, as ranges in rising order that do not touch.
///
/// `displacement` in mm on an even grid, with noise of this `variance` in mm². At a corner two straight lines meet, which the window may round: it is looked at over more than the window, and only the
/// even part around it tells it from a smooth motion.
pub(super) fn corners(displacement: &[f64], variance: f64, half: usize) -> Vec<Range<usize>> {
    let last = displacement.len();
    let broken = |i: usize| REACHES.iter().any(|reach| broken(displacement, i, half, reach * half, variance));
    let middles: Vec<usize> = (half..last.saturating_sub(half)).filter(|i| broken(*i)).collect();
    if middles.is_empty() {
        return Vec::new();
    }
    // A motion that has corners may well start and end with one.
    let (start, end) = (0..half / 2, last - half / 2..last);
    let windows = middles.into_iter().map(|i| i - half..i + half + 1);
    joined(std::iter::once(start).chain(windows).chain(std::iter::once(end)).collect())
}

/// The same samples as ranges in rising order that do not touch.
pub(crate) fn joined(mut ranges: Vec<Range<usize>>) -> Vec<Range<usize>> {
    ranges.sort_by_key(|range| range.start);
    let mut found: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match found.last_mut() {
            Some(known) if known.end >= range.start => known.end = known.end.max(range.end),
            _ => found.push(range),
        }
    }
    found
}

/// True where two straight lines meet around a sample, as far as `reach` samples on either side of it.
fn broken(displacement: &[f64], i: usize, half: usize, reach: usize, variance: f64) -> bool {
    if i < reach || i + reach >= displacement.len() {
        return false;
    }
    let even: Vec<f64> = (0..=reach).map(|k| 0.5 * (displacement[i + k] + displacement[i - k])).collect();
    let whole = Line::through(&even, |k| if k == 0 { 1.0 } else { 2.0 });
    // On a flank, or at rest, of an exact or a rounded displacement there may be nothing at all.
    let nothing = EXACT * even.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if whole.left > SHARE * whole.spread || whole.spread <= nothing.powi(2) {
        return false;
    }
    let outside = Line::through(&even[half..], |_| 1.0);
    // The mean of two samples has half their variance.
    outside.left <= 0.5 * NOISE * variance + (STRAIGHT * outside.rise).powi(2)
}

/// A straight line by least squares through values one sample apart.
struct Line {
    /// Mean square of the values about their mean.
    spread: f64,
    /// Mean square that the line leaves.
    left: f64,
    /// How far the line rises.
    rise: f64,
}

impl Line {
    fn through(values: &[f64], weight: impl Fn(usize) -> f64) -> Self {
        let mean_of = |f: &dyn Fn(usize) -> f64| {
            let (sum, total) =
                (0..values.len()).fold((0.0, 0.0), |(s, t), k| (s + weight(k) * f(k), t + weight(k)));
            sum / total
        };
        let (place, mean) = (mean_of(&|k| k as f64), mean_of(&|k| values[k]));
        let along = mean_of(&|k| (k as f64 - place).powi(2));
        let spread = mean_of(&|k| (values[k] - mean).powi(2));
        let slope = mean_of(&|k| (k as f64 - place) * (values[k] - mean)) / along;
        Self { spread, left: spread - slope * slope * along, rise: slope * (values.len() - 1) as f64 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::velocity::from_displacement;

    const RATE: f64 = 250.0;

    /// Corners of a motion in mm on a time in s, with 2 µm of noise.
    fn found(motion: impl Fn(f64) -> f64) -> Vec<Range<usize>> {
        let time: Vec<f64> = (0..1500).map(|i| f64::from(i) / RATE).collect();
        let noise = |i: usize| 0.002 * (f64::from((i * i * 37 % 1013) as u32) / 506.0 - 1.0);
        let x: Vec<f64> = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i)).collect();
        from_displacement(&time, &x).corners
    }

    fn triangle(t: f64) -> f64 {
        4.0 * (std::f64::consts::TAU * t).sin().asin()
    }

    #[test]
    fn the_corners_of_a_triangle_are_found_round_or_not() {
        let round = |t: f64| (0..20).map(|k| triangle(t + 0.001 * f64::from(k) - 0.0095)).sum::<f64>() / 20.0;
        for corners in [found(triangle), found(round)] {
            // The first and the last are the ends.
            let inner = &corners[1..corners.len() - 1];
            assert_eq!(inner.len(), 12, "{inner:?}");
            for (k, samples) in inner.iter().enumerate() {
                let corner = (0.25 + 0.5 * k as f64) * RATE;
                assert!(samples.start as f64 <= corner && corner <= samples.end as f64, "{inner:?}");
                assert!(samples.len() < 40, "{inner:?}");
            }
        }
    }

    #[test]
    fn flanks_and_rests_that_are_exact_or_rounded_have_none() {
        let flank = |t: f64| (4.0 * (t.rem_euclid(5.0) - 2.5).abs() - 5.0).clamp(-2.0, 2.0);
        let time: Vec<f64> = (0..3000).map(|i| f64::from(i) / RATE).collect();
        for digits in [100.0, 1e3, 1e5, 1e12] {
            let x: Vec<f64> = time.iter().map(|t| (flank(*t) * digits).round() / digits).collect();
            let corners = from_displacement(&time, &x).corners;
            let left_out: usize = corners.iter().map(ExactSizeIterator::len).sum();
            assert!(!corners.is_empty() && 5 * left_out < 3000, "{digits}: {left_out} of 3000 samples");
        }
    }

    #[test]
    fn smooth_motions_have_none() {
        let turn = std::f64::consts::TAU;
        let sweep = |t: f64| 5.0 * (turn * 0.2 * ((0.6 * t).exp() - 1.0) / 0.6).sin();
        let tones = |t: f64| {
            [1.0, 3.0, 5.0, 7.0, 9.0]
                .iter()
                .map(|k| (turn * 0.4 * k * t + k * k).sin() / k.sqrt())
                .sum::<f64>()
        };
        let burst = |t: f64| 5.0 * (turn * 2.0 * t).sin() * (-(t - 3.0).powi(2)).exp();
        assert_eq!(found(|t| 5.0 * (turn * t).sin()), []);
        assert_eq!(found(|t| 0.3 * (turn * 0.3 * t).sin()), []);
        assert_eq!(found(sweep), []);
        // Several tones may meet like two lines somewhere; hardly anything is lost.
        assert!(found(tones).iter().map(ExactSizeIterator::len).sum::<usize>() < 1500 / 8);
        assert_eq!(found(burst), []);
    }
}
