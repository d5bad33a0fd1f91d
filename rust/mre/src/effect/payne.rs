//! Payne softening: the stiffness falls with the current strain amplitude and comes back with it.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | largest share of the stiffness that is lost | - | 0 to 0.95 |
//! | `x_c` | amplitude at which half of it is lost | mm | 1 % to 200 % of the largest stroke |
//! | `t_a` | time over which a past amplitude is forgotten | s | 0.05 s to half the longest recording |
//!
//! The amplitude is the largest displacement so far, forgotten exponentially.

use super::{About, Effect, Factors, Scene, Sizes, order_within, within};
use crate::parameter::Parameter;

/// Kraus' law of the amplitude, on the stiffness or on the whole force.
#[derive(Debug, Clone, Copy)]
pub struct Payne {
    /// True where damping softens like stiffness.
    pub whole: bool,
}

/// Largest displacement so far, forgotten over a time: the current amplitude.
pub(crate) fn amplitude(scene: &Scene, forget: f64) -> Vec<f64> {
    let (time, x) = (scene.time, scene.displacement);
    scene.trace(x[0].abs(), |a, i| (a * (-(time[i] - time[i - 1]) / forget).exp()).max(x[i].abs()))
}

impl Effect for Payne {
    fn about(&self) -> About {
        About {
            effect: "payne_softening",
            law: if self.whole { "Kraus, whole force" } else { "Kraus, stiffness" },
            plain: "the stiffness falls with the current strain amplitude and recovers with it",
            equation: "k -> k (1 - s a/(1 + a)), a = A(t)/x_c, A the current amplitude",
            reference: "Kraus 1984; Payne 1962",
            limit: "at one amplitude it is part of k0; where the amplitude only rises it is Mullins",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![
            within("s", "", 0.0, 0.95),
            order_within("x_c", "mm", 0.01 * sizes.displacement, 2.0 * sizes.displacement),
            order_within("t_a", "s", 0.05, (0.5 * sizes.duration).max(0.1)),
        ]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        let mut starts = Vec::new();
        for forget in [0.3, 1.0, 3.0] {
            for scale in [0.1 * x, 0.7 * x] {
                starts.push(vec![0.2, scale, forget]);
            }
        }
        starts
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let stiffness: Vec<f64> = amplitude(scene, shape[2])
            .into_iter()
            .map(|a| a / shape[1])
            .map(|a| 1.0 - shape[0] * a / (1.0 + a))
            .collect();
        let damping = self.whole.then(|| stiffness.clone());
        Some(Factors { stiffness, damping })
    }
}
