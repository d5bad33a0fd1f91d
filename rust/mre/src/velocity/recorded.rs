//! A motion whose velocity was recorded, without the noise of the two.

use super::local::{NARROWEST, TERMS};
use super::window::Window;
use super::{Calming, Derived, PART_TERMS, cut};
use crate::kernel::filter::dot;
use crate::kernel::intervals::Plan;
use crate::kernel::jumps::jumps;
use crate::recording::mean;

/// Widest half window in samples of what a displacement has beside its velocity.
const WIDEST: usize = 200;

/// Noise below this share of a series, rms, is left in it.
const NEGLIGIBLE: f64 = 1e-4;

/// A displacement and the path of its velocity come apart by this share of it where noise of the velocity moves a path; what
/// follows displacement, velocity or acceleration is another error.
const WANDER: f64 = 3e-4;

/// Half window in samples, at least, over which the two come together again.
const SLOW: usize = 20;

/// Noise has a median square above this share of its mean square; that of Gaussian noise is 0.45.
const EVERYWHERE: f64 = 0.1;

/// A recorded velocity less its noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// mm/s.
    pub velocity: Vec<f64>,
    /// Standard deviation of the noise that it had, mm/s; zero where there was none to be taken off.
    pub noise: f64,
    /// The same of what is left of it, mm/s.
    pub left: f64,
    /// True where it jumps between samples, as a slope of the displacement cannot.
    pub jumps: bool,
}

/// A recorded velocity in mm/s less its noise, where it has some everywhere; it keeps its jumps.
pub fn smoothed(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Smoothed {
    let corners = jumps(time, displacement, velocity);
    let terms: &[usize] = if corners.is_empty() { &[TERMS] } else { &PART_TERMS };
    let (mut found, mut noise, mut left) = (velocity.to_vec(), 0.0, 0.0);
    let lasts: Vec<usize> = corners.iter().map(|(i, _)| *i).collect();
    for part in cut(&lasts, velocity.len()).filter(|part| part.len() > 2 * NARROWEST) {
        let (time, v) = (&time[part.clone()], &velocity[part.clone()]);
        let window = Window::best(time, v, WIDEST, terms);
        let (slope, smooth) = window.over(time, v);
        let share = window.leverage();
        let square = squares(&smooth, v) / (1.0 - share).max(f64::MIN_POSITIVE);
        noise += square;
        left += share * square;
        let calm = if corners.is_empty() { calmed(time, v, [slope, smooth], window.half) } else { smooth };
        found[part].copy_from_slice(&calm);
    }
    let mut taken: Vec<f64> = found.iter().zip(velocity).map(|(a, b)| (a - b).powi(2)).collect();
    let count = taken.len() as f64;
    let average = mean(&taken);
    let middle = taken.len() / 2;
    let (_, median, _) = taken.select_nth_unstable_by(middle, f64::total_cmp);
    let jumps = !corners.is_empty();
    if apart(&found, velocity) && *median > EVERYWHERE * average {
        let [noise, left] = [noise, left].map(|squares| (squares / count).sqrt());
        Smoothed { velocity: found, noise, left, jumps }
    } else {
        Smoothed { velocity: velocity.to_vec(), noise: 0.0, left: 0.0, jumps }
    }
}

/// What is left of a series where it is slower than elsewhere: noise of a velocity at rest would move a path.
fn calmed(time: &[f64], series: &[f64], [velocity, displacement]: [Vec<f64>; 2], half: usize) -> Vec<f64> {
    let smooth = Derived { velocity, displacement, half, corners: Vec::new() };
    Calming::of(time, series, &smooth).over(time, series).displacement
}

/// Displacement in mm less the noise that a recorded velocity in mm/s does not share, and the velocity less that which
/// makes its path leave the displacement.
///
/// What the displacement has beside the path of the velocity is smoothed, over a window that keeps all of it
/// that is not noise: drift of the path, and any motion that the velocity misses.
pub fn together(time: &[f64], displacement: &[f64], velocity: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let path = Plan::of(time, displacement, velocity).path();
    let beside: Vec<f64> = displacement.iter().zip(&path).map(|(x, s)| x - s).collect();
    let window = Window::best(time, &beside, WIDEST, &[TERMS]);
    let kept = window.over(time, &beside).1;
    let found: Vec<f64> = kept.iter().zip(&path).map(|(d, s)| d + s).collect();
    // The path has an error as well.
    let x = if apart(&found, displacement) { found } else { displacement.to_vec() };
    let rates = differences(time, velocity);
    let of_the_motion = [vec![1.0; time.len()], displacement.to_vec(), velocity.to_vec(), rates];
    let wander = without(kept, of_the_motion);
    let size = |series: &[f64]| series.iter().map(|x| x * x).sum::<f64>();
    let middle = mean(displacement);
    let motion: Vec<f64> = displacement.iter().map(|x| x - middle).collect();
    if size(&wander) < WANDER.powi(2) * size(&motion) {
        return (x, velocity.to_vec());
    }
    // A line has the calmest slope, also at the ends.
    let slow = Window { half: SLOW.max(window.half).min((time.len() - 1) / 2), terms: 2 };
    let strays = slow.over(time, &wander).0;
    (x, velocity.iter().zip(strays).map(|(v, strays)| v + strays).collect())
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

/// True where what was taken off a series is noise worth the change.
fn apart(found: &[f64], series: &[f64]) -> bool {
    squares(found, series) > NEGLIGIBLE.powi(2) * series.iter().map(|x| x * x).sum::<f64>()
}

/// Sum of squared differences.
fn squares(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum()
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
        let found = together(&time, &shown, &velocity).0;
        assert!(rms(&found, &truth) < 0.2 * rms(&shown, &truth));
    }

    #[test]
    fn an_offset_and_a_motion_that_the_velocity_misses_stay() {
        let [time, shown, velocity, truth] = shaken(0.01);
        // A velocity sensor of 3 % too much, and a zero that is elsewhere.
        let much: Vec<f64> = velocity.iter().map(|v| 1.03 * v).collect();
        let apart: Vec<f64> = shown.iter().map(|x| x + 2.0).collect();
        let wanted: Vec<f64> = truth.iter().map(|x| x + 2.0).collect();
        assert!(rms(&together(&time, &apart, &much).0, &wanted) < 0.5 * rms(&shown, &truth));
    }

    #[test]
    fn a_motion_without_noise_stays_to_the_bit() {
        let [time, shown, velocity, _] = shaken(0.0);
        assert_eq!(together(&time, &shown, &velocity).0, shown);
        assert_eq!(smoothed(&time, &shown, &velocity).velocity, velocity);
    }

    #[test]
    fn noise_of_a_velocity_is_taken_off_and_its_jumps_stay() {
        let [time, noisy, _, truth] = shaken(0.05);
        let still = vec![0.0; time.len()];
        assert!(rms(&smoothed(&time, &still, &noisy).velocity, &truth) < 0.5 * rms(&noisy, &truth));
        let triangle: Vec<f64> = truth.iter().map(|x| x.signum()).collect();
        assert_eq!(smoothed(&time, &still, &triangle).velocity, triangle);
    }
}
