//! Cyclic degradation of a hysteretic base model itself: its state yields earlier, or gets softer, with the energy put
//! into it.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `d_nu` | loss of strength: growth of nu | 1/mm | 0 to twenty over the longest path |
//! | `d_eta` | loss of stiffness: growth of eta | 1/mm | 0 to twenty over the longest path |
//!
//! Both grow with e, the integral of `w v`, not below zero: the energy put into the hysteretic element over its force at
//! yield.
//! Reference: Baber and Wen, J. Eng. Mech. Div. 107 (1981) 1069.
//! Known limit: only for a hysteretic base model; over a few equal cycles it cannot be told from thermal softening.

use super::{About, Effect, Sizes, StateChange, Wear, within};
use crate::parameter::Parameter;

/// Most growth over the longest path.
const MOST: f64 = 20.0;

/// What the state loses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wearing {
    Strength,
    Stiffness,
    Both,
}

impl Effect for Wearing {
    fn about(&self) -> About {
        let both = About {
            effect: "cyclic_degradation",
            law: "strength and stiffness of the state",
            plain: "the device gets softer with every cycle and does not recover",
            equation: "dw/dt = rho (v - nu (sigma |v| |w|^(n-1) w - (sigma - 1) v |w|^n))/eta, nu = 1 + d_nu e, \
                       eta = 1 + d_eta e, de/dt = w v",
            reference: "Baber and Wen 1981",
            limit: "only for a hysteretic base model; over a few equal cycles it cannot be told from thermal softening",
        };
        match self {
            Self::Both => both,
            Self::Strength => About {
                law: "strength of the state",
                equation: "dw/dt = rho (v - nu (sigma |v| |w|^(n-1) w - (sigma - 1) v |w|^n)), nu = 1 + d_nu e, \
                           de/dt = w v",
                ..both
            },
            Self::Stiffness => About {
                law: "stiffness of the state",
                equation: "dw/dt -> (dw/dt)/eta, eta = 1 + d_eta e, de/dt = w v",
                ..both
            },
        }
    }

    fn on_a_part(&self) -> bool {
        true
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let growth = |name| within(name, "1/mm", 0.0, MOST / sizes.path);
        match self {
            Self::Strength => vec![growth("d_nu")],
            Self::Stiffness => vec![growth("d_eta")],
            Self::Both => vec![growth("d_nu"), growth("d_eta")],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let growths = [0.3, 2.0].map(|share| share / sizes.path);
        match self {
            Self::Strength | Self::Stiffness => growths.map(|growth| vec![growth]).to_vec(),
            Self::Both => growths.map(|growth| vec![growth, growth]).to_vec(),
        }
    }

    fn state_change(&self, _: &Sizes, shape: &[f64]) -> Option<StateChange> {
        let (first, last) = (shape[0], shape[shape.len() - 1]);
        let wear = match self {
            Self::Strength => Wear { strength: first, ..Wear::default() },
            Self::Stiffness => Wear { stiffness: first, ..Wear::default() },
            Self::Both => Wear { strength: first, stiffness: last },
        };
        Some(StateChange { wear, ..StateChange::default() })
    }
}
