//! Time delay: the force is measured a little later (or earlier) than the motion.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | d | delay of the force against the motion; negative: the motion lags | s | up to 50 ms |
//!
//! Between samples the force is a spline, or the motion is, of which the force then follows: where the device turns
//! sharply, a spline through its force swings.

use super::{About, Effect, Motion, Scene, Sizes, within};
use crate::kernel::spline::second_differences;
use crate::parameter::Parameter;

/// What is shifted, and what is measured of a force that is from before a recording began, or from after it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TimeDelay {
    /// The force goes on as it begins: the recording is a part of a longer one.
    Continued,
    /// The force stays as it begins: the device is held there.
    Held,
    /// The device sees the motion of another time.
    Motion,
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

impl Effect for TimeDelay {
    fn about(&self) -> About {
        About {
            effect: "time_delay",
            law: match self {
                Self::Continued => "pure delay",
                Self::Held => "pure delay, held before",
                Self::Motion => "pure delay of the motion",
            },
            plain: "one channel lags the other by a fixed time",
            equation: if *self == Self::Motion {
                "the base model sees x(t - d)"
            } else {
                "F_measured(t) = F(t - d)"
            },
            reference: "general",
            limit: "at one steady frequency it is part of k0 and c0",
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        vec![within("d", "s", -0.05, 0.05)]
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![vec![-0.02], vec![-0.002], vec![0.002], vec![0.02]]
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let shifted = |series: &[f64]| delayed(scene.step(), series, shape[0]);
        (*self == Self::Motion)
            .then(|| Motion { displacement: shifted(scene.displacement), velocity: shifted(scene.velocity) })
    }

    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        if *self == Self::Motion {
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
