//! Stiffness jump: a sudden change at one moment, as by a crack or a debonding.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost (negative: won) | - | -0.9 to 0.95 |
//! | `t_0` | moment, from the start of the campaign | s | its duration |
//! | `t_r` | time that the change takes | s | a sample to a twelfth of the campaign |
//!
//! It lasts to the end of the recording in which it falls, where the next one is another specimen or a repaired
//! one, or through all later recordings in the order in which they are given.
//! The time that the change takes lets a fit find the moment.
//! Known limit: near the end of a recording only a large jump can be seen; wear that goes on from one recording to the
//! next looks like it.

use super::{About, Effect, Factors, Scene, Sizes, ideal_below, order_within, within};
use crate::parameter::Parameter;

/// Moments from which a fit starts.
const PLACES: usize = 24;

/// A jump of the stiffness or of the whole force.
#[derive(Debug, Clone, Copy)]
pub(super) struct StiffnessJump {
    /// True where damping jumps like stiffness.
    pub(super) whole: bool,
    /// True where later recordings stay changed.
    pub(super) lasting: bool,
}

/// Longest time that a change takes, s.
fn longest(sizes: &Sizes) -> f64 {
    (2.0 / PLACES as f64 * sizes.total).max(4.0 * sizes.step)
}

impl Effect for StiffnessJump {
    fn about(&self) -> About {
        About {
            effect: "stiffness_jump",
            law: match (self.whole, self.lasting) {
                (false, false) => "stiffness",
                (true, false) => "whole force",
                (false, true) => "stiffness, lasting",
                (true, true) => "whole force, lasting",
            },
            plain: "the stiffness changes suddenly at one moment (crack, debonding)",
            equation: "k -> k (1 - s) from t_0 on",
            reference: "general",
            limit: "near the end of a recording only a large jump can be seen; wear that goes on from one recording \
                    to the next looks like it",
        }
    }

    fn in_one_recording(&self) -> bool {
        true
    }

    fn moment(&self, shape: &[f64]) -> Option<(f64, f64)> {
        Some((shape[1], shape[1] + shape[2]))
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![
            within("s", "", -0.9, 0.95),
            within("t_0", "s", 0.0, sizes.total),
            ideal_below(order_within("t_r", "s", sizes.step, longest(sizes))),
        ]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let start = |s: f64, places: usize| {
            let apart = sizes.total / places as f64;
            (0..places).map(move |i| vec![s, (i as f64 + 0.3) * apart, 0.5 * longest(sizes)])
        };
        let places = if self.lasting { PLACES / 2 } else { PLACES };
        start(0.2, places).chain(start(-0.2, PLACES / 2)).collect()
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let since = shape[1] - scene.before;
        if self.lasting && since < 0.0 {
            return Some(Factors::kept(vec![1.0 - shape[0]; scene.len()], self.whole));
        }
        if !(0.0..scene.duration()).contains(&since) {
            return None;
        }
        let start = scene.time[0] + since;
        let kept =
            scene.time.iter().map(|t| 1.0 - shape[0] * ((t - start) / shape[2]).clamp(0.0, 1.0)).collect();
        Some(Factors::kept(kept, self.whole))
    }
}
