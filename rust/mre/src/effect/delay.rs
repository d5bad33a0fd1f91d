//! Time delay: the force is measured a little later (or earlier) than the motion.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | d | delay of the force against the motion; negative: the motion lags | s | up to 50 ms |

use super::{About, Effect, Scene, Sizes, within};
use crate::parameter::Parameter;

/// A pure delay between the channels.
#[derive(Debug, Clone, Copy)]
pub(super) struct TimeDelay;

/// The series at `time - delay`, by a natural cubic spline; along its end slopes beyond its ends.
pub(super) fn delayed(step: f64, series: &[f64], delay: f64) -> Vec<f64> {
    let last = series.len() - 1;
    let bend = second_differences(series);
    let first_slope = series[1] - series[0] - bend[1] / 6.0;
    let last_slope = series[last] - series[last - 1] + bend[last - 1] / 6.0;
    (0..series.len())
        .map(|i| {
            let at = i as f64 - delay / step;
            if at < 0.0 {
                return series[0] + at * first_slope;
            }
            if at > last as f64 {
                return series[last] + (at - last as f64) * last_slope;
            }
            let k = (at as usize).min(last - 1);
            let (b, a) = (at - k as f64, 1.0 - (at - k as f64));
            let curved = (a.powi(3) - a) * bend[k] + (b.powi(3) - b) * bend[k + 1];
            a * series[k] + b * series[k + 1] + curved / 6.0
        })
        .collect()
}

/// Second derivatives, per step squared, of the natural cubic spline through evenly spaced values.
pub(super) fn second_differences(y: &[f64]) -> Vec<f64> {
    let n = y.len();
    let (mut bend, mut share) = (vec![0.0; n], vec![0.0; n]);
    // Tridiagonal: m[i-1] + 4 m[i] + m[i+1] = 6 (y[i-1] - 2 y[i] + y[i+1]).
    for i in 1..n - 1 {
        let pivot = 4.0 - share[i - 1];
        share[i] = 1.0 / pivot;
        bend[i] = (6.0 * (y[i - 1] - 2.0 * y[i] + y[i + 1]) - bend[i - 1]) / pivot;
    }
    for i in (1..n - 1).rev() {
        bend[i] -= share[i] * bend[i + 1];
    }
    bend
}

impl Effect for TimeDelay {
    fn about(&self) -> About {
        About {
            effect: "time_delay",
            law: "pure delay",
            plain: "one channel lags the other by a fixed time",
            equation: "F_measured(t) = F(t - d)",
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

    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        Some(delayed(scene.step(), force, shape[0]))
    }
}
