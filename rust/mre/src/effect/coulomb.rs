//! Coulomb friction: a force of constant size against the motion.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `F_c` | friction force | N | >= 0 |
//! | `z_y` | pre-sliding displacement (Dahl) | mm | 0.01 % to 5 % of the largest stroke |
//! | `v_s` | velocity over which the sign is smoothed | mm/s | 0.001 % to 5 % of the largest speed |
//!
//! Dahl's element is integrated exactly in the displacement. At the lower end of `v_s` the smoothed sign is the sign itself,
//! as it is of a velocity that only its rounding keeps from zero.
//! Reference: Dahl, Aerospace Corporation TOR-0158(3107-18)-1, 1968.
//! Known limit: where all strokes are long against `z_y`, its value is not determined.

use super::operators::{dahl, each, sign};
use super::{About, Effect, Scene, Sizes, ideal_below, order_within, positive};
use crate::parameter::Parameter;

/// A share by which numbers differ that went through a logarithm.
const ROUNDING: f64 = 1e-9;

/// Velocity in mm/s below which the sign is sharp.
fn sharp(sizes: &Sizes) -> f64 {
    1e-5 * sizes.velocity
}

/// How the sign of the velocity is smoothed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coulomb {
    /// Over a displacement.
    Dahl,
    /// Over a velocity.
    Smoothed,
}

impl Effect for Coulomb {
    fn about(&self) -> About {
        let dahl = About {
            effect: "coulomb_friction",
            law: "Dahl",
            plain: "dry friction of constant size acts against the motion",
            equation: "F_f = F_c z, dz/dt = v (1 - z sgn v)/z_y",
            reference: "Coulomb 1785; Dahl 1968",
            limit: "at one amplitude and one frequency it is close to quadratic_damping with a small power",
        };
        match self {
            Self::Dahl => dahl,
            Self::Smoothed => About { law: "smoothed sign", equation: "F_f = F_c tanh(v/v_s)", ..dahl },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("F_c", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Dahl => {
                vec![ideal_below(order_within(
                    "z_y",
                    "mm",
                    1e-4 * sizes.displacement,
                    0.05 * sizes.displacement,
                ))]
            }
            Self::Smoothed => {
                vec![ideal_below(order_within("v_s", "mm/s", sharp(sizes), 0.05 * sizes.velocity))]
            }
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let (shares, size): (&[f64], f64) = match self {
            Self::Dahl => (&[0.001, 0.004, 0.012, 0.035], sizes.displacement),
            Self::Smoothed => (&[1e-4, 0.003, 0.01, 0.035], sizes.velocity),
        };
        shares.iter().map(|share| vec![share * size]).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![match self {
            Self::Dahl => dahl(scene, shape[0]),
            Self::Smoothed if shape[0] <= (1.0 + ROUNDING) * sharp(scene.sizes) => each(scene.velocity, sign),
            Self::Smoothed => each(scene.velocity, |v| (v / shape[0]).tanh()),
        }]
    }
}
