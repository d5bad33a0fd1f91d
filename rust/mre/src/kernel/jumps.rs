//! Where a velocity jumps between two samples: the motion has a corner there, as a triangle wave has.
//!
//! A cubic through such samples swings an eighth of the jump beyond them on both sides, and a hysteretic variable would
//! turn after another path: with 200 samples a cycle by half a hundredth of the amplitude.

use std::cell::LazyCell;

use crate::spread::median;

/// Intervals that a jump takes, and how many times what changes in the intervals before and after it is at least: one, or
/// two, in which a corner is rounded.
pub(crate) const ALONE: (usize, f64) = (1, 4.0);
pub(crate) const IN_TWO: (usize, f64) = (2, 8.0);
/// Intervals before and after.
const BESIDE: usize = 2;
/// And it is this share of the largest speed at least.
const LEAST: f64 = 0.05;
/// Steps that differ by more than this share are uneven.
const UNEVEN: f64 = 0.01;
/// A jump is so many times the median of all changes.
pub(crate) const STANDS_OUT: f64 = 12.0;
/// The place of a corner may be off by so much of an interval: displacements are noisy.
const OFF: f64 = 0.25;

/// True where values jump in so many intervals from one on, beside which little changes, two on either side or, at an
/// end, one; the largest value is known.
pub(crate) fn sharp(values: &[f64], largest: f64, i: usize, (wide, times): (usize, f64)) -> bool {
    let spans = values.len().saturating_sub(1);
    if i == 0 || i + wide >= spans {
        return false;
    }
    let change = |k: usize| (values[k + 1] - values[k]).abs();
    let jump = (values[i + wide] - values[i]).abs();
    let mut beside = (i.saturating_sub(BESIDE)..i).chain(i + wide..(i + wide + BESIDE).min(spans));
    (i..i + wide).all(|k| change(k) > LEAST * largest) && beside.all(|k| jump > times * change(k))
}

/// Intervals between samples in which the velocity jumps, in order, with the share of the interval that passes before:
/// two constant velocities that cover the distance between the displacements.
pub(crate) fn jumps(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Vec<(usize, f64)> {
    let largest = velocity.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
    let corner = |i: usize| {
        let (step, way) = (time[i + 1] - time[i], displacement[i + 1] - displacement[i]);
        let share = (velocity[i + 1] - way / step) / (velocity[i + 1] - velocity[i]);
        (share > -OFF && share < 1.0 + OFF).then_some((i, share.clamp(0.0, 1.0)))
    };
    // A motion that changes as quickly elsewhere is sampled too coarsely, and has no corners.
    let least = LazyCell::new(|| STANDS_OUT * usual_change(velocity));
    let mut found: Vec<(usize, f64)> = Vec::new();
    for i in 0..velocity.len() {
        let wide = [ALONE, IN_TWO]
            .into_iter()
            .find(|wide| sharp(velocity, largest, i, *wide) && even(time, i, *wide));
        let Some((wide, _)) = wide.filter(|(wide, _)| (velocity[i + wide] - velocity[i]).abs() > *least)
        else {
            continue;
        };
        let places: Option<Vec<(usize, f64)>> = (i..i + wide).map(corner).collect();
        // Where two corners would share an interval it is neither's.
        if let Some(places) = places
            && found.last().is_none_or(|(last, _)| *last < i)
        {
            found.extend(places);
        }
    }
    found
}

/// Samples after which a series on an even grid jumps, in order.
pub(crate) fn jumps_after(values: &[f64]) -> Vec<usize> {
    let (low, high) = crate::recording::extent(values);
    (0..values.len()).filter(|i| sharp(values, high - low, *i, ALONE)).collect()
}

/// Median of the changes between neighbours.
pub(crate) fn usual_change(values: &[f64]) -> f64 {
    median(values.windows(2).map(|v| (v[1] - v[0]).abs()).collect())
}

/// True where the samples around are evenly spaced: across a gap much changes that is no corner.
pub(crate) fn even(time: &[f64], i: usize, (wide, _): (usize, f64)) -> bool {
    let near = i.saturating_sub(BESIDE)..(i + wide + BESIDE).min(time.len() - 1);
    let step = time[i + 1] - time[i];
    near.clone().all(|k| (time[k + 1] - time[k] - step).abs() < UNEVEN * step)
}

#[cfg(test)]
mod tests {
    use super::jumps;

    #[test]
    fn a_corner_is_found_between_samples_and_a_sine_has_none() {
        let time: Vec<f64> = (0..60).map(|i| f64::from(i) / 100.0).collect();
        for corner in [0.2, 0.203, 0.2071, 0.2099] {
            let x: Vec<f64> = time.iter().map(|t| 30.0 * (corner - (t - corner).abs())).collect();
            let v: Vec<f64> = time.iter().map(|t| if *t < corner { 30.0 } else { -30.0 }).collect();
            let found = jumps(&time, &x, &v);
            assert_eq!(found.len(), 1);
            let (i, share) = found[0];
            assert!((time[i] + 0.01 * share - corner).abs() < 1e-12, "{found:?}");
        }
        // Rounded over an interval that a sample is in.
        let (corner, round) = (0.2, 0.005);
        let v: Vec<f64> =
            time.iter().map(|t| 30.0 * ((corner + 0.3 * round - t) / round).clamp(-1.0, 1.0)).collect();
        let way = |t: f64| {
            let s = ((t - corner - 0.3 * round) / round).clamp(-1.0, 1.0);
            -30.0 * (0.5 * round * s * s + (t - corner - 0.3 * round - round * s) * s)
        };
        let x: Vec<f64> = time.iter().map(|t| way(*t)).collect();
        assert_eq!(jumps(&time, &x, &v).iter().map(|(i, _)| *i).collect::<Vec<_>>(), [19, 20]);
        for samples in [5.3, 6.0, 8.0, 22.0, 200.0] {
            for phase in 0..10 {
                let at = |i: usize| std::f64::consts::TAU * (i as f64 / samples + 0.1 * f64::from(phase));
                let x: Vec<f64> = (0..60).map(|i| at(i).sin()).collect();
                let v: Vec<f64> =
                    (0..60).map(|i| 100.0 * std::f64::consts::TAU / samples * at(i).cos()).collect();
                assert_eq!(jumps(&time, &x, &v), [], "{samples} samples a cycle");
            }
        }
    }

    #[test]
    fn a_jump_is_none_less_for_a_smaller_one() {
        // From rest a sine that goes over into a quicker one where it is at rest in the middle.
        let turn = std::f64::consts::TAU;
        let (start, change) = (0.507, 10.507);
        let phase = |t: f64| turn * if t < change { 0.3 * (t - start) } else { 0.35 * (t - change) };
        let rate = |t: f64| turn * if t < change { 0.3 } else { 0.35 };
        let time: Vec<f64> = (0..1200).map(|i| f64::from(i) / 60.0).collect();
        let x: Vec<f64> = time.iter().map(|t| if *t < start { 0.0 } else { phase(*t).sin() }).collect();
        let v: Vec<f64> =
            time.iter().map(|t| if *t < start { 0.0 } else { rate(*t) * phase(*t).cos() }).collect();
        let found = jumps(&time, &x, &v);
        assert_eq!(found.iter().map(|(i, _)| *i).collect::<Vec<_>>(), [30], "{found:?}");
    }
}
