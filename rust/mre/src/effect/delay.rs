//! Time delay: the force is measured a little later (or earlier) than the motion.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | d | delay of the force against the motion; negative: the motion lags | s | up to 50 ms |
//! | g | what it grows by over the longest recording, where the clocks of two loggers run apart | s | up to 50 ms |
//!
//! Between samples the force is a spline, or the motion is, of which the force then follows: where the device turns
//! sharply, a spline through its force swings.

use super::{About, Effect, Motion, Scene, Sizes, within};
use crate::kernel::spline::second_differences;
use crate::parameter::Parameter;

/// Longest delay, s.
const LONGEST: f64 = 0.05;

/// What is shifted, and what is measured of a force that is from before a recording began, or from after it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TimeDelay {
    /// The force goes on as it begins: the recording is a part of a longer one.
    Continued,
    /// The force stays as it begins: the device is held there.
    Held,
    /// The device sees the motion of another time.
    Motion,
    /// The same, of a time that runs faster or slower, from the start of each recording.
    Drifting,
}

/// The series at a place between its samples, as by a natural cubic spline with these second differences; along its end
/// slopes beyond its ends.
fn between(series: &[f64], bend: &[f64], at: f64) -> f64 {
    let last = series.len() - 1;
    let k = (at.max(0.0) as usize).min(last - 1);
    let b = (at - k as f64).clamp(0.0, 1.0);
    let a = 1.0 - b;
    let curved = ((a.powi(3) - a) * bend[k] + (b.powi(3) - b) * bend[k + 1]) / 6.0;
    let slope = series[k + 1] - series[k];
    let beyond = if at < 0.0 {
        at * (slope - bend[1] / 6.0)
    } else {
        (at - last as f64).max(0.0) * (slope + bend[last - 1] / 6.0)
    };
    a * series[k] + b * series[k + 1] + curved + beyond
}

/// The series at `time - delay`, by a natural cubic spline; along its end slopes beyond its ends.
pub(super) fn delayed(step: f64, series: &[f64], delay: f64) -> Vec<f64> {
    let last = series.len() - 1;
    let bend = second_differences(series);
    let first_slope = series[1] - series[0] - bend[1] / 6.0;
    let last_slope = series[last] - series[last - 1] + bend[last - 1] / 6.0;
    let shift = delay / step;
    // Even spacing: every sample lies at the same share of its interval.
    let b = shift.ceil() - shift;
    let a = 1.0 - b;
    let (curved_a, curved_b) = ((a.powi(3) - a) / 6.0, (b.powi(3) - b) / 6.0);
    (0..series.len())
        .map(|i| {
            let at = i as f64 - shift;
            if at < 0.0 {
                return series[0] + at * first_slope;
            }
            if at >= last as f64 {
                return series[last] + (at - last as f64) * last_slope;
            }
            let k = (i as f64 - shift.ceil()) as usize;
            a * series[k] + b * series[k + 1] + curved_a * bend[k] + curved_b * bend[k + 1]
        })
        .collect()
}

/// The series at an ever earlier time.
fn apart(scene: &Scene, series: &[f64], shape: &[f64]) -> Vec<f64> {
    let (bend, step, start) = (second_differences(series), scene.step(), scene.time[0]);
    let late = |t: f64| shape[0] + shape[1] * (t - start) / scene.sizes.duration;
    let at = |(i, t): (usize, &f64)| between(series, &bend, i as f64 - late(*t) / step);
    scene.time.iter().enumerate().map(at).collect()
}

impl Effect for TimeDelay {
    fn about(&self) -> About {
        About {
            effect: "time_delay",
            law: match self {
                Self::Continued => "pure delay",
                Self::Held => "pure delay, held before",
                Self::Motion => "pure delay of the motion",
                Self::Drifting => "clocks that run apart",
            },
            plain: match self {
                Self::Drifting => "one channel lags the other by a time that grows or shrinks",
                _ => "one channel lags the other by a fixed time",
            },
            equation: match self {
                Self::Continued | Self::Held => "F_measured(t) = F(t - d)",
                Self::Motion => "the device sees x(t - d)",
                Self::Drifting => "the device sees x(t - d - g t/T), T the longest recording",
            },
            reference: "general",
            limit: "at one steady frequency it is part of k0 and c0",
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        let time = |name| within(name, "s", -LONGEST, LONGEST);
        if *self == Self::Drifting { vec![time("d"), time("g")] } else { vec![time("d")] }
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        if *self == Self::Drifting {
            return [-0.01, 0.01].iter().flat_map(|g| [-0.003, 0.003].map(|d| vec![d, *g])).collect();
        }
        vec![vec![-0.02], vec![-0.002], vec![0.002], vec![0.02]]
    }

    fn moves_the_device(&self) -> bool {
        matches!(self, Self::Motion | Self::Drifting)
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let shifted = |series: &[f64]| match self {
            Self::Drifting => apart(scene, series, shape),
            _ => delayed(scene.step(), series, shape[0]),
        };
        self.moves_the_device()
            .then(|| Motion { displacement: shifted(scene.displacement), velocity: shifted(scene.velocity) })
    }

    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        if matches!(self, Self::Motion | Self::Drifting) {
            return None;
        }
        let mut found = delayed(scene.step(), force, shape[0]);
        if *self == Self::Held {
            let (last, shift) = (force.len() - 1, shape[0] / scene.step());
            let early = (shift.ceil().max(0.0) as usize).min(force.len());
            found[..early].fill(force[0]);
            let late = ((-shift).ceil().max(0.0) as usize).min(force.len());
            found[force.len() - late..].fill(force[last]);
        }
        Some(found)
    }
}
