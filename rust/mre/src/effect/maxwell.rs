//! Maxwell relaxation: springs and dashpots in series, beside the base model.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_m`, `k_1`, `k_2` | stiffness of a branch | N/mm | >= 0 |
//! | tau, `tau_1`, `tau_2` | relaxation time of a branch | s | two samples to a third of the longest recording |
//!
//! Integrated exactly for the cubic spline through a velocity that is sampled evenly.
//! Reference: Ferry, Viscoelastic Properties of Polymers, 1980.
//! Known limit: at one steady frequency a branch is part of k0 and c0.

use super::before::Before;
use super::operators::lag;
use super::{About, Effect, Scene, Sizes, order_within, orders, positive};
use crate::kernel::relaxation::{Lag, lags};
use crate::parameter::Parameter;

/// One branch or two.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Maxwell {
    /// One relaxation time.
    One,
    /// Two relaxation times.
    Two,
}

/// `z' = v - z / tau` from rest.
pub(super) fn branch(scene: &Scene, tau: f64) -> Vec<f64> {
    let mut z = lag(scene.time, scene.velocity, tau, 0.0);
    for z in &mut z {
        *z *= tau;
    }
    z
}

/// `sum w z` of `z' = v - z / tau` for pairs `(tau, w)`, from rest or from a steady motion before.
pub(super) fn branches(
    scene: &Scene,
    before: Option<Before>,
    of: impl Iterator<Item = (f64, f64)>,
) -> Vec<f64> {
    let lagged = |tau| before.map_or(0.0, |before| before.lagged(tau));
    let of: Vec<Lag> = of.map(|(tau, w)| Lag { tau, weight: w * tau, start: lagged(tau) }).collect();
    lags(scene.time, scene.velocity, &of)
}

impl Effect for Maxwell {
    fn about(&self) -> About {
        let one = About {
            effect: "maxwell_relaxation",
            law: "one branch",
            plain: "part of the stiffness relaxes with time (a spring and a dashpot in series)",
            equation: "dF_m/dt = k_m v - F_m/tau",
            reference: "Maxwell 1867; Ferry, Viscoelastic Properties of Polymers, 1980",
            limit: "at one steady frequency it is part of k0 and c0, at any number of amplitudes",
        };
        match self {
            Self::One => one,
            Self::Two => About {
                law: "two branches",
                plain: "part of the stiffness relaxes with time, with two relaxation times",
                equation: "dF_i/dt = k_i v - F_i/tau_i, i = 1, 2",
                ..one
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::One => vec![positive("k_m", "N/mm")],
            Self::Two => vec![positive("k_1", "N/mm"), positive("k_2", "N/mm")],
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let tau = |name| order_within(name, "s", 2.0 * sizes.step, sizes.duration / 3.0);
        match self {
            Self::One => vec![tau("tau")],
            Self::Two => vec![tau("tau_1"), tau("tau_2")],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let taus = |count| orders(2.0 * sizes.step, sizes.duration / 3.0, count);
        match self {
            Self::One => taus(9).into_iter().map(|tau| vec![tau]).collect(),
            Self::Two => {
                let taus = taus(5);
                let pairs = (0..taus.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
                pairs.map(|(i, j)| vec![taus[i], taus[j]]).collect()
            }
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        shape.iter().map(|tau| branch(scene, *tau)).collect()
    }
}
