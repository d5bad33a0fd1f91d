//! Pinching of a hysteretic element: its state slips where cracks close, so that the loop narrows in the middle.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_w` | force at yield | N | >= 0 |
//! | rho | inverse of the yield displacement | 1/mm | yield from 5 % to 300 % of the largest stroke |
//! | `zeta_1` | depth of the slip | - | 0.1 to 0.97 |
//! | `zeta_2` | width of the slip, share of the yield force | - | 0.1 to 0.8 |
//! | q | force at which it slips most, share of the yield force, against the motion before it is reversed | - | 0 to 0.3 |
//! | s | share of the force that is lost in the middle position | - | 0.1 to 0.97 |
//! | `w_x` | half width of the middle | mm | 5 % to 60 % of the largest stroke |
//!
//! The exponent of the yield is 1.5; the state moves along straight lines between samples. Cracks that close at a force
//! make the state slip (Baber and Noori); a clearance that is crossed at a place takes force away there.
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411.
//! Known limit: without a slip it is hysteresis.

use super::hysteresis::bouc_wen;
use super::{
    About, Effect, Scene, Sizes, Slip, ideal_above, ideal_below, order_within, orders, positive, within,
};
use crate::kernel::climb::Climb;
use crate::parameter::Parameter;

/// Exponent of the yield.
const SHARPNESS: f64 = 1.5;
/// Share of the dissipative term where the loop is narrow by place: it unloads along a line.
const EVEN: f64 = 0.5;

/// A hysteretic element whose loop is narrow in the middle.
#[derive(Debug, Clone, Copy)]
pub(super) enum Pinched {
    /// Where its own force is small.
    ByForce,
    /// About the middle position.
    ByPlace,
}

/// State over its yield value along the displacement.
fn slipping(scene: &Scene, shape: &[f64]) -> Vec<f64> {
    let (rho, depth, width, place) = (shape[0], shape[1], shape[2], shape[3]);
    let slip = Slip::ByForce { depth, width, place };
    let climb = Climb::new(|u| (1.0 - u * u.abs().powf(SHARPNESS - 1.0)) * slip.at(u));
    climb.states(rho, scene.displacement)
}

/// State over its yield value, less what is lost about the middle position.
fn narrowed(scene: &Scene, shape: &[f64]) -> Vec<f64> {
    let (lost, width) = (shape[1], shape[2]);
    let state = bouc_wen(scene, &[shape[0], EVEN, SHARPNESS]);
    let near = |x: &f64| 1.0 - lost * (-(x / width).powi(2)).exp();
    state.iter().zip(scene.displacement).map(|(w, x)| w * near(x)).collect()
}

impl Effect for Pinched {
    fn about(&self) -> About {
        let by_force = About {
            effect: "pinching",
            law: "Baber-Noori element",
            plain: "the loop is pinched near the middle position",
            equation: "F_h = k_w w, dw/dx = rho (1 - |w|^1.5 sgn(w v)) (1 - zeta_1 exp(-((w sgn v - q)/zeta_2)^2))",
            reference: "Baber and Noori 1986",
            limit: "without a slip it is hysteresis",
        };
        match self {
            Self::ByForce => by_force,
            Self::ByPlace => About {
                law: "element, narrow in the middle",
                equation: "F_h = k_w w (1 - s exp(-(x/w_x)^2)), dw/dt = rho (v - (|v| |w|^0.5 w + v |w|^1.5)/2)",
                ..by_force
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_w", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let rho = order_within("rho", "1/mm", 1.0 / (3.0 * x), 20.0 / x);
        match self {
            Self::ByForce => {
                vec![
                    rho,
                    ideal_above(within("zeta_1", "", 0.1, 0.97)),
                    within("zeta_2", "", 0.1, 0.8),
                    ideal_below(within("q", "", 0.0, 0.3)),
                ]
            }
            Self::ByPlace => {
                vec![
                    rho,
                    ideal_above(within("s", "", 0.1, 0.97)),
                    order_within("w_x", "mm", 0.05 * x, 0.6 * x),
                ]
            }
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        let yields = orders(0.08, 0.6, 3).into_iter().map(|share| 1.0 / (share * x));
        let widths = |rho: f64| match self {
            Self::ByForce => [0.2, 0.4].map(|width| vec![rho, 0.7, width, 0.1]),
            Self::ByPlace => [0.12, 0.3].map(|width| vec![rho, 0.6, width * x]),
        };
        yields.flat_map(widths).collect()
    }

    fn own(&self) -> Option<&'static str> {
        Some(match self {
            Self::ByForce => "zeta_1",
            Self::ByPlace => "s",
        })
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![match self {
            Self::ByForce => slipping(scene, shape),
            Self::ByPlace => narrowed(scene, shape),
        }]
    }
}
