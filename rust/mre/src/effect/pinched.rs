//! Pinching of a hysteretic element: its state slips where cracks close, so that the loop narrows in the middle.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_w` | force at yield | N | >= 0 |
//! | rho | inverse of the yield displacement | 1/mm | yield from 5 % to 300 % of the largest stroke |
//! | `zeta_1` | depth of the slip | - | 0.1 to 0.97 |
//! | `zeta_2` | width of the slip, share of the yield force | - | 0.1 to 0.8 |
//! | q | force at which it slips most, share of the yield force, against the motion before it is reversed | - | 0 to 0.5 |
//!
//! The exponent of the yield is 1.5; the state moves along straight lines between samples.
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411.
//! Known limit: without a slip it is hysteresis.

use super::operators::sign;
use super::{About, Effect, Scene, Sizes, order_within, orders, positive, within};
use crate::parameter::Parameter;

/// Exponent of the yield.
const SHARPNESS: f64 = 1.5;
/// Longest step of the integration, in yield displacements.
const STEP: f64 = 0.1;
/// Most steps between two samples.
const MOST: usize = 200;

/// A hysteretic element that slips.
#[derive(Debug)]
pub(super) struct Pinched;

/// State over its yield value along the displacement.
fn slipping(scene: &Scene, shape: &[f64]) -> Vec<f64> {
    let [rho, depth, width, place] = [shape[0], shape[1], shape[2], shape[3]];
    let slope = |w: f64, side: f64| {
        let (toward, size) = (w * side, w.abs().powf(SHARPNESS));
        let bare = if toward > 0.0 { 1.0 - size } else { 1.0 + size };
        bare * (1.0 - depth * (-((toward - place) / width).powi(2)).exp())
    };
    let x = scene.displacement;
    scene.trace(0.0, |mut w, i| {
        let far = rho * (x[i] - x[i - 1]);
        let side = sign(far);
        let count = ((far.abs() / STEP).ceil() as usize).clamp(1, MOST);
        let h = far / count as f64;
        for _ in 0..count {
            let a = slope(w, side);
            let b = slope(w + 0.5 * h * a, side);
            let c = slope(w + 0.5 * h * b, side);
            let d = slope(w + h * c, side);
            w = (w + h * (a + 2.0 * b + 2.0 * c + d) / 6.0).clamp(-1.0, 1.0);
        }
        w
    })
}

impl Effect for Pinched {
    fn about(&self) -> About {
        About {
            effect: "pinching",
            law: "Baber-Noori element",
            plain: "the loop is pinched near the middle position",
            equation: "F_h = k_w w, dw/dx = rho (1 - |w|^1.5 sgn(w v)) (1 - zeta_1 exp(-((w sgn v - q)/zeta_2)^2))",
            reference: "Baber and Noori 1986",
            limit: "without a slip it is hysteresis",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_w", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        vec![
            order_within("rho", "1/mm", 1.0 / (3.0 * x), 20.0 / x),
            within("zeta_1", "", 0.1, 0.97),
            within("zeta_2", "", 0.1, 0.8),
            within("q", "", 0.0, 0.5),
        ]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let yields = orders(0.08, 0.6, 3).into_iter();
        let start =
            |share: f64| [0.2, 0.4].map(|width| vec![1.0 / (share * sizes.displacement), 0.7, width, 0.1]);
        yields.flat_map(start).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![slipping(scene, shape)]
    }
}
