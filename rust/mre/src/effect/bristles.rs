//! Stribeck friction of bristles: the friction that falls with the speed is reached over a pre-sliding displacement.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `F_c` | friction force at speed | N | >= 0 |
//! | `v_s` | Stribeck velocity | mm/s | 0.5 % to 60 % of the largest speed |
//! | `z_y` | pre-sliding displacement at speed | mm | 0.01 % to 5 % of the largest stroke |
//! | r | excess of the break-away force as a share of `F_c` | - | 0.02 to 3 |
//!
//! `F_c / z_y` is the stiffness of the bristles, `sigma_0`; the viscous term belongs to the base model, and that of the bristles,
//! which a derived velocity imitates where it swings beside a hold, is left out.
//! Reference: Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Autom. Control 40 (1995) 419.
//! Known limit: at speeds above three times `v_s` it is Coulomb friction.

use super::operators::{at_speed, sign};
use super::stribeck::{Fall, Stribeck};
use super::{About, Effect, Scene, Sizes, order_within, positive};
use crate::parameter::Parameter;

/// Values from which a fit starts, as shares of the largest speed and stroke, and of the excess.
const FALLS: [f64; 4] = [0.01, 0.04, 0.12, 0.4];
const SHARP: [f64; 2] = [2e-3, 1.5e-2];
const EXCESS: f64 = 0.5;

/// The law whose excess falls as soon as the speed rises.
const ON_THE_SPOT: Stribeck = Stribeck { fall: Fall::Gaussian, rests: false };

/// The `LuGre` law with a Gaussian excess.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bristles;

/// Steady deflection at a speed, as a multiple of that at high speed.
fn steady(v: f64, shape: &[f64]) -> f64 {
    1.0 + shape[2] * Fall::Gaussian.excess(v / shape[0])
}

impl Effect for Bristles {
    fn about(&self) -> About {
        About {
            law: "LuGre",
            plain: "dry friction acts against the motion, is larger at low speed and follows it over a displacement",
            equation: "F_f = F_c z, dz/dt = (v - |v| z/g)/z_y, g = 1 + r exp(-(v/v_s)^2)",
            reference: "Canudas de Wit, Olsson, Astrom and Lischinsky 1995",
            ..ON_THE_SPOT.about()
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("F_c", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let excess = order_within("r", "", 0.02, 3.0);
        ON_THE_SPOT.shape(sizes).into_iter().chain([excess]).collect()
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let (x, v) = (sizes.displacement, sizes.velocity);
        FALLS.iter().flat_map(|fall| SHARP.map(|share| vec![fall * v, share * x, EXCESS])).collect()
    }

    fn own(&self) -> Option<&'static str> {
        Some("r")
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let z_y = shape[1];
        vec![at_speed(scene, |z, dx, v| {
            let g = steady(v, shape);
            let end = sign(dx) * g;
            end + (z - end) * (-dx.abs() / (z_y * g)).exp()
        })]
    }
}
