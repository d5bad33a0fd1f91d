//! A displacement and the velocity that was recorded beside it, as one motion.

use super::PART_TERMS;
use super::local::TERMS;
use super::recorded::{Smoothed, everywhere};
use super::smoothing::Smoothing;
use super::window::Window;
use crate::kernel::filter::dot;
use crate::kernel::intervals::Plan;
use crate::recording::mean;

/// Widest half window in samples of what a displacement has beside its velocity.
pub(super) const WIDEST: usize = 200;

/// Noise below this share of a series, rms, is left in it.
const NEGLIGIBLE: f64 = 1e-4;
/// White noise below this share of it: beside a slow noise of the force it stands out.
const FAINT: f64 = 1e-6;

/// Neighbours whose correlation tells white noise from the error of a path.
const LAGS: usize = 4;
/// It is less than this.
const WHITE: f64 = 0.2;

/// A displacement and the path of its velocity come apart by this share of it where noise of the velocity moves a path; what
/// follows displacement, velocity or acceleration is another error.
const WANDER: f64 = 3e-4;

/// Terms of the polynomials between jumps of the velocity: beside the path of a good one a displacement has a constant there.
const BESIDE_TERMS: [usize; 1 + PART_TERMS.len()] = [1, PART_TERMS[0], PART_TERMS[1], PART_TERMS[2]];

/// Half window in samples, at least, over which the two come together again.
const SLOW: usize = 20;

/// How a displacement loses the noise that a recorded velocity does not share, and the velocity that which makes its
/// path leave the displacement.
///
/// What the displacement has beside the path of the velocity is smoothed, over a window that keeps all of it
/// that is not noise: drift of the path, and any motion that the velocity misses. Where the velocity jumps between two samples
/// the path has the error of the place of its corner, and each part is smoothed on its own.
#[derive(Debug, Clone)]
pub(crate) struct Together {
    /// Standard deviation of the noise that the displacement had, mm; zero where there was none to be taken off.
    pub(crate) noise: f64,
    /// Of what is beside the path.
    smoothing: Smoothing,
    /// Over which a path that wanders comes back.
    slow: Option<Window>,
}

impl Together {
    /// Of a displacement in mm and a velocity in mm/s less its noise, with what it makes of both.
    pub(crate) fn of(time: &[f64], displacement: &[f64], recorded: &Smoothed) -> (Self, [Vec<f64>; 2]) {
        let velocity = &recorded.velocity;
        let path = Plan::of(time, displacement, velocity).path();
        let beside = less(displacement, &path);
        let smoothing = if recorded.jumps.is_empty() {
            Smoothing(vec![(0..time.len(), Window::best(time, &beside, WIDEST, &[TERMS]))])
        } else {
            Smoothing::between(&recorded.jumps, time, &beside, &BESIDE_TERMS)
        };
        let kept = smoothing.over(time, &beside).1;
        let found: Vec<f64> = kept.iter().zip(&path).map(|(d, s)| d + s).collect();
        // The path has an error as well.
        let some = apart(&found, displacement) || faint(&less(displacement, &found), displacement);
        let noise = if some && everywhere(&found, displacement) {
            smoothing.noise(&found, displacement).0
        } else {
            0.0
        };
        let size = |series: &[f64]| series.iter().map(|x| x * x).sum::<f64>();
        let wander = beside_the_motion(time, smoothing.continued(&kept), [displacement, velocity]);
        let middle = mean(displacement);
        let motion: Vec<f64> = displacement.iter().map(|x| x - middle).collect();
        // A line has the calmest slope, also at the ends.
        let slow =
            || Window { half: smoothing.half().clamp(SLOW, WIDEST).min((time.len() - 1) / 2), terms: 2 };
        let wanders = size(&wander) >= WANDER.powi(2) * size(&motion);
        let slow = wanders.then(slow);
        let together = Self { noise, smoothing, slow };
        let both = together.joined([time, &path, &kept], [displacement, velocity], || wander);
        (together, both)
    }

    /// Both, of parts of a motion that have this path.
    pub(super) fn along(
        &self,
        [time, path]: [&[f64]; 2],
        parts: [&[f64]; 2],
        motion: [&[f64]; 2],
    ) -> [Vec<f64>; 2] {
        let kept = self.smoothing.over(time, &less(parts[0], path)).1;
        let wander = || beside_the_motion(time, self.smoothing.continued(&kept), motion);
        self.joined([time, path, &kept], parts, wander)
    }

    /// Both, of what is kept beside the path, and how that wanders.
    fn joined(
        &self,
        [time, path, kept]: [&[f64]; 3],
        [displacement, velocity]: [&[f64]; 2],
        wander: impl FnOnce() -> Vec<f64>,
    ) -> [Vec<f64>; 2] {
        let found = kept.iter().zip(path).map(|(d, s)| d + s);
        let x = if self.noise > 0.0 { found.collect() } else { displacement.to_vec() };
        let Some(slow) = self.slow else { return [x, velocity.to_vec()] };
        let strays = slow.over(time, &wander()).0;
        [x, velocity.iter().zip(strays).map(|(v, strays)| v + strays).collect()]
    }
}

/// A series less what goes with a motion.
fn beside_the_motion(time: &[f64], series: Vec<f64>, [displacement, velocity]: [&[f64]; 2]) -> Vec<f64> {
    let rates = differences(time, velocity);
    without(series, [vec![1.0; time.len()], displacement.to_vec(), velocity.to_vec(), rates])
}

/// Slopes over the neighbours.
fn differences(time: &[f64], values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let slope = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(last));
        (values[b] - values[a]) / (time[b] - time[a])
    };
    (0..=last).map(slope).collect()
}

/// A series less what goes with some columns (Gram and Schmidt).
fn without<const N: usize>(mut series: Vec<f64>, mut columns: [Vec<f64>; N]) -> Vec<f64> {
    let less = |from: &mut [f64], column: &[f64]| {
        let square = dot(column, column);
        let share = if square > 0.0 { dot(from, column) / square } else { 0.0 };
        from.iter_mut().zip(column).for_each(|(value, c)| *value -= share * c);
    };
    for k in 0..N {
        let (before, rest) = columns.split_at_mut(k + 1);
        for column in rest {
            less(column, &before[k]);
        }
        less(&mut series, &before[k]);
    }
    series
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// True where what was taken off a series is noise worth the change.
pub(super) fn apart(found: &[f64], series: &[f64]) -> bool {
    squares(found, series) > NEGLIGIBLE.powi(2) * series.iter().map(|x| x * x).sum::<f64>()
}

/// True where what was taken off a series is little, but white noise.
fn faint(taken: &[f64], series: &[f64]) -> bool {
    let square = dot(taken, taken);
    let along = |lag: usize| dot(&taken[lag..], &taken[..taken.len() - lag]).abs();
    square > FAINT.powi(2) * dot(series, series)
        && taken.len() > LAGS
        && (1..=LAGS).all(|lag| along(lag) < WHITE * square)
}

/// Sum of squared differences.
pub(super) fn squares(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::smoothed;
    use super::*;

    /// 5 mm at 1 Hz on 200 Hz, with noise of this size in mm that repeats after 101 samples.
    pub(crate) fn shaken(size: f64) -> [Vec<f64>; 4] {
        let turn = std::f64::consts::TAU;
        let time: Vec<f64> = (0..2000).map(|i| f64::from(i) / 200.0).collect();
        let truth: Vec<f64> = time.iter().map(|t| 5.0 * (turn * t).sin()).collect();
        let velocity = time.iter().map(|t| 5.0 * turn * (turn * t).cos()).collect();
        let noise = |i: usize| size * (f64::from((i * 37 % 101) as u32) / 50.0 - 1.0);
        let shown = truth.iter().enumerate().map(|(i, x)| x + noise(i)).collect();
        [time, shown, velocity, truth]
    }

    pub(crate) fn rms(a: &[f64], b: &[f64]) -> f64 {
        (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
    }

    fn together(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Vec<f64> {
        let (_, [x, _]) = Together::of(time, displacement, &smoothed(time, displacement, velocity));
        x
    }

    #[test]
    fn noise_that_the_velocity_does_not_share_is_taken_off() {
        let [time, shown, velocity, truth] = shaken(0.01);
        let found = together(&time, &shown, &velocity);
        assert!(rms(&found, &truth) < 0.2 * rms(&shown, &truth));
    }

    #[test]
    fn noise_is_taken_off_however_little_and_the_error_of_a_path_is_none() {
        let noise = |i: usize| {
            let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
            x - x.floor() - 0.5
        };
        for size in [1e-3, 1e-4, 3e-5] {
            let [time, _, velocity, truth] = shaken(0.0);
            let shown: Vec<f64> = truth.iter().enumerate().map(|(i, x)| x + size * noise(i)).collect();
            let left = rms(&together(&time, &shown, &velocity), &truth) / rms(&shown, &truth);
            assert!(left < 0.2, "{left} of {size} mm");
        }
        // 12 samples a cycle.
        let turn = std::f64::consts::TAU;
        let time: Vec<f64> = (0..2000).map(|i| f64::from(i) / 200.0).collect();
        let motion = |of: fn(f64) -> f64| time.iter().map(|t| of(16.67 * turn * t)).collect::<Vec<f64>>();
        let (x, v) = (motion(f64::sin), motion(|phase| 16.67 * std::f64::consts::TAU * phase.cos()));
        assert_eq!(together(&time, &x, &v), x);
    }

    #[test]
    fn an_offset_and_a_motion_that_the_velocity_misses_stay() {
        let [time, shown, velocity, truth] = shaken(0.01);
        // A velocity sensor of 3 % too much, and a zero that is elsewhere.
        let much: Vec<f64> = velocity.iter().map(|v| 1.03 * v).collect();
        let apart: Vec<f64> = shown.iter().map(|x| x + 2.0).collect();
        let wanted: Vec<f64> = truth.iter().map(|x| x + 2.0).collect();
        assert!(rms(&together(&time, &apart, &much), &wanted) < 0.5 * rms(&shown, &truth));
    }

    #[test]
    fn a_motion_without_noise_stays_to_the_bit() {
        let [time, shown, velocity, _] = shaken(0.0);
        assert_eq!(together(&time, &shown, &velocity), shown);
        assert_eq!(smoothed(&time, &shown, &velocity).velocity, velocity);
    }
}
