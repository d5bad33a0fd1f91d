//! Is a recorded velocity something else than the slope of the displacement: a difference quotient, or smoothed? Such a one
//! biases the damping, and what it does to the force looks like an effect that the device has not.

use nalgebra::{Matrix3, Vector3};

use super::stencil::grid;

/// A difference quotient is so many times as near to what was recorded as to the slope.
const NEARER: f64 = 10.0;
/// Share of the velocity, rms, that a smoothed one lacks at least.
const LACKS: f64 = 1e-3;
/// It is late by no more than such a share of what it lacks.
const IN_STEP: f64 = 0.3;
/// The variance of what it lacks is no more times that which it would have if there were neither gain nor lag: in a single
/// sine they are the same.
const TOLD: f64 = 100.0;

/// A recorded motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Recorded<'a> {
    /// s.
    pub(crate) time: &'a [f64],
    /// mm.
    pub(crate) displacement: &'a [f64],
    /// mm/s.
    pub(crate) velocity: &'a [f64],
    /// Of the displacement, mm/s.
    pub(crate) slope: &'a [f64],
}

/// Which of recorded velocities, of one instrument, are something else than slopes for a reason that is no lag of a channel.
pub(crate) fn are_others(motions: &[Recorded]) -> Vec<bool> {
    let smoothed = are_smoothed(motions);
    motions.iter().map(|motion| smoothed || is_quotient(motion)).collect()
}

/// True where it is the backward, forward or central difference of the displacement, which its slope is not.
fn is_quotient(&Recorded { time, displacement, velocity, slope }: &Recorded) -> bool {
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slopes: Vec<f64> =
        displacement.windows(2).zip(&steps).map(|(pair, step)| (pair[1] - pair[0]) / step).collect();
    let central = |i: usize| {
        let (before, after) = (steps[i - 1], steps[i]);
        (before * slopes[i] + after * slopes[i - 1]) / (before + after)
    };
    let is = |quotient: &dyn Fn(usize) -> f64| {
        let apart = |series: &[f64]| {
            (1..series.len() - 1).map(|i| (series[i] - quotient(i)).powi(2)).sum::<f64>().sqrt()
        };
        NEARER * apart(velocity) < apart(slope)
    };
    is(&central) || is(&|i| slopes[i - 1]) || is(&|i| slopes[i])
}

/// True where they lack what is fast in the slopes, and are not late. Times that are not even tell nothing.
///
/// What was recorded is the instrument: noise of the slopes alone would be lacking from it, and does not go with it.
fn are_smoothed(motions: &[Recorded]) -> bool {
    let (mut gram, mut matrix, mut right) = (Matrix3::zeros(), Matrix3::zeros(), Vector3::zeros());
    for Recorded { time, velocity, slope, .. } in motions {
        let Some(step) = grid(time) else { continue };
        let row = |series: &[f64], i: usize| {
            let [before, now, after] = [series[i - 1], series[i], series[i + 1]];
            Vector3::new(now, (after - before) / (2.0 * step), (after - 2.0 * now + before) / step.powi(2))
        };
        for i in 1..slope.len() - 1 {
            let (own, instrument) = (row(slope, i), row(velocity, i));
            gram += own * own.transpose();
            matrix += instrument * own.transpose();
            right += instrument * (velocity[i] - slope[i]);
        }
    }
    let sizes = gram.diagonal().map(f64::sqrt);
    let alone = gram.component_div(&(sizes * sizes.transpose())).try_inverse();
    let parts = matrix.try_inverse().map(|inverse| (inverse * right).component_mul(&sizes));
    alone.zip(parts).is_some_and(|(alone, parts)| {
        alone[(2, 2)] < TOLD && parts[2] > LACKS * sizes[0] && parts[1].abs() < IN_STEP * parts[2]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_smoothed_lacks_what_is_fast_and_is_not_late() {
        let time: Vec<f64> = (0..1000).map(|i| f64::from(i) * 0.005).collect();
        let slow = |t: f64| 40.0 * (6.0 * t).cos() + 30.0 * (40.0 * t).cos();
        let slope: Vec<f64> = time.iter().map(|t| slow(*t)).collect();
        let mean = |late: f64| -> Vec<f64> {
            let around = |t: f64| (-3..=3).map(|k| slow(t - late + 0.005 * f64::from(k))).sum::<f64>() / 7.0;
            time.iter().map(|t| around(*t)).collect()
        };
        let smoothed = |velocity: &[f64], slope: &[f64]| {
            are_smoothed(&[Recorded { time: &time, displacement: &[], velocity, slope }])
        };
        assert!(smoothed(&mean(0.0), &slope));
        // A channel that is late, a gain, noise, and a slope that is smoothed itself are something else.
        assert!(!smoothed(&mean(0.01), &slope));
        let late: Vec<f64> = time.iter().map(|t| slow(t - 0.004)).collect();
        assert!(!smoothed(&late, &slope));
        let noisy: Vec<f64> = slope.iter().zip(0..).map(|(v, i)| 1.03 * v + f64::from(7 * i).sin()).collect();
        assert!(!smoothed(&noisy, &slope));
        assert!(!smoothed(&slope, &mean(0.0)));
        // As a narrow window leaves it.
        let wavy: Vec<f64> = slope.iter().zip(0..).map(|(v, i)| v + f64::from(i).sin()).collect();
        assert!(!smoothed(&slope, &wavy) && smoothed(&mean(0.0), &wavy));
        // In one sine it is a gain, beside another it is told.
        let sine =
            |rate: f64, gain: f64| -> Vec<f64> { time.iter().map(|t| gain * (rate * t).cos()).collect() };
        let (slow, fast, dull) = (sine(10.0, 5.0), sine(60.0, 5.0), sine(60.0, 4.9));
        assert!(!smoothed(&dull, &fast));
        let both = [(&slow, &slow), (&dull, &fast)];
        let both = both.map(|(velocity, slope)| Recorded { time: &time, displacement: &[], velocity, slope });
        assert!(are_smoothed(&both));
    }

    #[test]
    fn differences_are_told_from_slopes_on_even_and_uneven_times() {
        let motion = |t: f64| 3.0 * (20.0 * t).sin();
        let slope = |t: f64| 60.0 * (20.0 * t).cos();
        for uneven in [0.0, 0.3] {
            let time: Vec<f64> =
                (0..500).map(|i| (f64::from(i) + uneven * f64::from(i).sin()) * 0.01).collect();
            let x: Vec<f64> = time.iter().map(|t| motion(*t)).collect();
            let v: Vec<f64> = time.iter().map(|t| slope(*t)).collect();
            let difference = |i: usize, j: usize| (x[j] - x[i]) / (time[j] - time[i]);
            let backward: Vec<f64> =
                (0..500).map(|i| if i > 0 { difference(i - 1, i) } else { 0.0 }).collect();
            let forward: Vec<f64> =
                (0..500).map(|i| if i < 499 { difference(i, i + 1) } else { 0.0 }).collect();
            let central: Vec<f64> = (0..500)
                .map(|i| match i {
                    0 | 499 => 0.0,
                    _ => {
                        let (before, after) = (time[i] - time[i - 1], time[i + 1] - time[i]);
                        (before * forward[i] + after * backward[i]) / (before + after)
                    }
                })
                .collect();
            let is = |velocity: &[f64]| {
                is_quotient(&Recorded { time: &time, displacement: &x, velocity, slope: &v })
            };
            for quotient in [&backward, &forward, &central] {
                assert!(is(quotient));
                // As a file rounds it.
                let rounded: Vec<f64> = quotient.iter().map(|v| (v * 100.0).round() / 100.0).collect();
                assert!(is(&rounded));
            }
            // The slope itself, with noise of its own or without, is none.
            assert!(!is(&v));
            let noisy: Vec<f64> = v.iter().zip(0..).map(|(v, i)| v + 0.3 * f64::from(7 * i).sin()).collect();
            assert!(!is(&noisy));
        }
    }
}
