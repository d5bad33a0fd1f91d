//! Pinching of a hysteretic base model itself: its state slips where cracks close, or a clearance is crossed.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `zeta_1` | depth of the slip | - | 0 to 0.97 |
//! | `zeta_2` | width of the slip, share of the yield force | - | 0.05 to 0.8 |
//! | q | force at which it slips most, share of the yield force, in the direction of motion | - | -0.3 to 0.3 |
//! | `w_x` | half width of a clearance | mm | 3 % to 60 % of the largest stroke |
//!
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411.
//! Known limit: only for a hysteretic base model; below the yield force a wide slip is another stiffness.

use super::{About, Effect, Sizes, Slip, StateChange, ideal_above, order_within, within};
use crate::parameter::Parameter;

/// Where the state of the base slips.
#[derive(Debug, Clone, Copy)]
pub(super) enum Slipping {
    /// Where its own force is small.
    ByForce,
    /// About the middle position.
    ByPlace,
}

impl Effect for Slipping {
    fn about(&self) -> About {
        let by_force = About {
            effect: "pinching",
            law: "Baber-Noori, state of the base",
            plain: "the loop is pinched near the middle position",
            equation: "dw/dt -> dw/dt (1 - zeta_1 exp(-((w sgn v - q)/zeta_2)^2))",
            reference: "Baber and Noori 1986",
            limit: "only for a hysteretic base model; below the yield force a wide slip is another stiffness",
        };
        match self {
            Self::ByForce => by_force,
            Self::ByPlace => About {
                law: "slip near the middle, state of the base",
                equation: "dw/dt -> dw/dt (1 - zeta_1 exp(-(x/w_x)^2))",
                ..by_force
            },
        }
    }

    fn on_a_part(&self) -> bool {
        true
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let depth = ideal_above(within("zeta_1", "", 0.0, 0.97));
        let x = sizes.displacement;
        match self {
            Self::ByForce => vec![depth, within("zeta_2", "", 0.05, 0.8), within("q", "", -0.3, 0.3)],
            Self::ByPlace => vec![depth, order_within("w_x", "mm", 0.03 * x, 0.6 * x)],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        match self {
            Self::ByForce => [(0.15, 0.0), (0.15, 0.15), (0.35, 0.0), (0.35, 0.2), (0.7, 0.0)]
                .map(|(width, place)| vec![0.5, width, place])
                .to_vec(),
            Self::ByPlace => [0.06, 0.15, 0.35].map(|width| vec![0.5, width * x]).to_vec(),
        }
    }

    fn state_change(&self, _: &Sizes, shape: &[f64]) -> Option<StateChange> {
        let slip = match self {
            Self::ByForce => Slip::ByForce { depth: shape[0], width: shape[1], place: shape[2] },
            Self::ByPlace => Slip::ByPlace { depth: shape[0], width: shape[1] },
        };
        Some(StateChange { slip: Some(slip), ..StateChange::default() })
    }
}
