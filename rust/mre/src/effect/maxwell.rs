//! Maxwell relaxation: a spring and a dashpot in series, beside the base model.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_m` | stiffness of the branch | N/mm | >= 0 |
//! | tau | relaxation time | s | two samples to a third of the longest recording |
//!
//! Integrated exactly for a velocity that is linear between samples.

use super::{About, Effect, Scene, Sizes, order_within, orders, positive};
use crate::parameter::Parameter;

/// One Maxwell branch.
#[derive(Debug, Clone, Copy)]
pub struct Maxwell;

/// `z' = v - z / tau` from rest.
pub(crate) fn branch(scene: &Scene, tau: f64) -> Vec<f64> {
    let (time, v) = (scene.time, scene.velocity);
    scene.trace(0.0, |z, i| {
        let h = (time[i] - time[i - 1]) / tau;
        let decay = (-h).exp();
        // Weights of the velocities at both ends of the step.
        let whole = -(-h).exp_m1();
        let late = tau * (1.0 - whole / h);
        let early = tau * whole - late;
        decay * z + early * v[i - 1] + late * v[i]
    })
}

impl Effect for Maxwell {
    fn about(&self) -> About {
        About {
            effect: "maxwell_relaxation",
            law: "one branch",
            plain: "part of the stiffness relaxes with time (a spring and a dashpot in series)",
            equation: "dF_m/dt = k_m v - F_m/tau",
            reference: "Maxwell 1867; Ferry, Viscoelastic Properties of Polymers, 1980",
            limit: "at one steady frequency it is part of k0 and c0, at any number of amplitudes",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_m", "N/mm")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![order_within("tau", "s", 2.0 * sizes.step, sizes.duration / 3.0)]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        orders(2.0 * sizes.step, sizes.duration / 3.0, 9).into_iter().map(|tau| vec![tau]).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![branch(scene, shape[0])]
    }
}
