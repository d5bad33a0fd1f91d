//! Rig compliance: the fixture gives way in series with the device.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `f_r` | flexibility of the rig, 1/`k_r` | mm/N | 0 to half the flexibility of the device |
//! | `t_r` | retardation time of a rig that gives way slowly | s | two samples to half the longest recording |
//!
//! The force that bends the rig is that of the device, as far as it is known.
//! Reference: a spring, or a Kelvin-Voigt element, in series.
//! Known limit: for a linear device it is part of k0 and c0.

use super::operators::{lag, slope};
use super::{About, Effect, Motion, Scene, Sizes, order_within, within};
use crate::parameter::Parameter;

/// How the rig gives way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rig {
    /// At once.
    Spring,
    /// Slowly.
    Viscoelastic,
}

impl Effect for Rig {
    fn about(&self) -> About {
        let spring = About {
            effect: "rig_compliance",
            law: "spring in series",
            plain: "the fixture gives way, so that the device moves less than was measured",
            equation: "the device sees x - f_r F",
            reference: "general",
            limit: "for a linear device it is part of k0 and c0",
        };
        match self {
            Self::Spring => spring,
            Self::Viscoelastic => About {
                law: "spring and dashpot in series",
                equation: "the device sees x - u, t_r du/dt + u = f_r F",
                ..spring
            },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let mut shape = vec![within("f_r", "mm/N", 0.0, 0.5 * sizes.displacement / sizes.force)];
        if *self == Self::Viscoelastic {
            shape.push(order_within("t_r", "s", 2.0 * sizes.step, 0.5 * sizes.duration));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let flexible = 0.03 * sizes.displacement / sizes.force;
        match self {
            Self::Spring => vec![vec![flexible]],
            Self::Viscoelastic => [0.003, 0.03, 0.2]
                .iter()
                .map(|share| vec![flexible, (share * sizes.duration).max(2.0 * sizes.step)])
                .collect(),
        }
    }

    fn flexibility(&self, shape: &[f64]) -> Option<f64> {
        Some(shape[0])
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let slow = match self {
            Self::Spring => None,
            Self::Viscoelastic => Some(lag(scene.time, scene.whole, shape[1], scene.whole[0])),
        };
        let force = slow.as_deref().unwrap_or(scene.whole);
        let less =
            |series: &[f64], by: &[f64]| series.iter().zip(by).map(|(a, b)| a - shape[0] * b).collect();
        Some(Motion {
            displacement: less(scene.displacement, force),
            velocity: less(scene.velocity, &slope(scene.time, force)),
        })
    }
}
