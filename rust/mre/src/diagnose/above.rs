//! Frequencies that a motion does not reach.

use std::f64::consts::PI;

use crate::assembly::Campaign;
use crate::kernel::filter::dot;
use crate::recording::Recording;

/// Multiples of the frequency of a motion above which little follows it.
const ABOVE: f64 = 3.0;
/// Half-cosines that are looked at there.
const SOME: usize = 64;
/// They reach up to this share of half the sampling rate: an anti-aliasing filter does what it likes above.
const UP_TO: f64 = 0.6;

/// Frequency of a motion, Hz: that of the sine with its root mean squares.
pub(super) fn frequency(recording: &Recording) -> f64 {
    let (x, v) = (recording.displacement(), recording.velocity());
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let squares = dot(x, x) - mean * mean * x.len() as f64;
    if squares > 0.0 { (dot(v, v) / squares).sqrt() / (2.0 * PI) } else { 0.0 }
}

/// Frequency of the fastest motion of a campaign, Hz.
pub(super) fn fastest(campaign: &Campaign) -> f64 {
    campaign.recordings().iter().map(|recording| frequency(recording)).fold(0.0, f64::max)
}

/// Some half-cosines of `n` samples that a motion of this frequency, Hz, does not reach, evenly apart on a logarithmic
/// scale; none where there is less than an octave.
pub(super) fn above(motion: f64, n: usize, step: f64) -> Vec<usize> {
    let first = (2.0 * ABOVE * motion * n as f64 * step).max(1.0);
    let last = UP_TO * n as f64;
    if last < 2.0 * first {
        return Vec::new();
    }
    let place = |i: usize| first * (last / first).powf(i as f64 / (SOME - 1) as f64);
    let mut places: Vec<usize> = (0..SOME).map(|i| place(i) as usize).collect();
    places.dedup();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_nothing_is_above_the_motion_that_tells_nothing() {
        assert!(above(40.0, 2_000, 0.005).is_empty());
        let places = above(2.0, 2_000, 0.005);
        assert!(places.len() > 50 && places[0] == 120 && places.iter().all(|k| *k <= 1_200));
    }
}
