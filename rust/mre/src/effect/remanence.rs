//! Field remanence: the field depends on past currents.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_q`, `c_q` | change of stiffness and damping with the remanent current | N/(A mm), N s/(A mm) | any |
//! | `i_r` | half width of the play of the current | A | 1 % to 50 % of its span |
//!
//! The remanent current q is the play of the current less the current, or the largest past current less the
//! current. The device starts demagnetised to the first current.
//! Reference: Jiles and Atherton, J. Magn. Magn. Mater. 61 (1986) 48; Krasnosel'skii and Pokrovskii, Systems with
//! Hysteresis, 1989 (play).
//! Known limit: on a current that only rises or only falls it is drift or field dependence.

use super::operators::play;
use super::{About, Effect, Scene, Sizes, order_within, signed};
use crate::parameter::Parameter;

/// What of the past is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Remanence {
    /// The play of the current.
    Play,
    /// The largest current.
    Largest,
}

/// Columns of stiffness and damping that follow a series.
pub(super) fn following(scene: &Scene, q: &[f64]) -> Vec<Vec<f64>> {
    [scene.displacement, scene.velocity].map(|s| q.iter().zip(s).map(|(q, s)| q * s).collect()).into()
}

impl Effect for Remanence {
    fn about(&self) -> About {
        let play = About {
            effect: "field_remanence",
            law: "play",
            plain: "the field remembers past currents: rising and falling currents differ",
            equation: "F_q = (k_q x + c_q v) q, q = play of the current with half width i_r, less the current",
            reference: "Jiles and Atherton 1986; Krasnosel'skii and Pokrovskii 1989",
            limit: "on a current that only rises or only falls it is drift or field dependence",
        };
        match self {
            Self::Play => play,
            Self::Largest => About {
                law: "largest past current",
                equation: "F_q = (k_q x + c_q v) q, q = largest past current less the current",
                ..play
            },
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.current_varies
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![signed("k_q", "N/(A mm)"), signed("c_q", "N s/(A mm)")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Play => {
                let span = sizes.current_span();
                vec![order_within("i_r", "A", 0.01 * span, 0.5 * span)]
            }
            Self::Largest => Vec::new(),
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Play => {
                [0.03, 0.1, 0.2, 0.4].iter().map(|share| vec![share * sizes.current_span()]).collect()
            }
            Self::Largest => vec![Vec::new()],
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let still = vec![0.0; scene.len()];
        let current = scene.current.unwrap_or(&still);
        let past = match self {
            Self::Play => play(current, shape[0]),
            Self::Largest => scene.trace(current[0], |largest, i| largest.max(current[i])),
        };
        let q: Vec<f64> = past.iter().zip(current).map(|(p, i)| p - i).collect();
        following(scene, &q)
    }
}
