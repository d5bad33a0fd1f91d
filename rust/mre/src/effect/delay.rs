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

/// The series at `time - delay`, by local cubics (Catmull-Rom); held constant beyond its ends.
pub(super) fn delayed(step: f64, series: &[f64], delay: f64) -> Vec<f64> {
    let n = series.len() as isize;
    let shift = delay / step;
    let at = |i: isize| series[i.clamp(0, n - 1) as usize];
    let whole = shift.floor();
    let s = 1.0 - (shift - whole);
    let back = whole as isize + 1;
    (0..n)
        .map(|i| {
            let (a, b, c, d) = (at(i - back - 1), at(i - back), at(i - back + 1), at(i - back + 2));
            let cubic = 3.0 * (b - c) + d - a;
            let square = 2.0 * a - 5.0 * b + 4.0 * c - d;
            b + 0.5 * s * (c - a + s * (square + s * cubic))
        })
        .collect()
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
