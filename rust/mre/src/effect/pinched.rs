//! Pinching of a hysteretic element: its state slips where cracks close, so that the loop narrows in the middle.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_w` | force at yield | N | >= 0 |
//! | rho | inverse of the yield displacement | 1/mm | yield from 5 % to 300 % of the largest stroke |
//! | `zeta_1` | depth of the slip | - | 0.1 to 0.97 |
//! | `zeta_2` | width of the slip, share of the yield force | - | 0.1 to 0.8 |
//! | q | force at which it slips most, share of the yield force, against the motion before it is reversed | - | 0 to 0.5 |
//! | s | share of the force that is lost in the middle position | - | 0.1 to 0.97 |
//! | `w_x` | half width of the middle | mm | 5 % to 60 % of the largest stroke |
//!
//! The exponent of the yield is 1.5; the state moves along straight lines between samples. Cracks that close at a force
//! make the state slip (Baber and Noori); a clearance that is crossed at a place takes force away there.
//! Reference: Baber and Noori, J. Vib. Acoust. Stress Reliab. Des. 108 (1986) 411.
//! Known limit: without a slip it is hysteresis.

use super::hysteresis::bouc_wen;
use super::{About, Effect, Scene, Sizes, ideal_above, ideal_below, order_within, orders, positive, within};
use crate::parameter::Parameter;

/// Exponent of the yield.
const SHARPNESS: f64 = 1.5;
/// Distance between the nodes of a climb, in yield displacements.
const STEP: f64 = 0.02;
/// A state so near the yield is the yield.
const NEAR: f64 = 1e-6;
/// Most nodes: where it hardly moves any more.
const MOST: usize = 20_000;
/// Newton steps, with the slope of the nodes, from a line to the state on a climb: as exact as its nodes.
const NEWTON: usize = 3;

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

/// The state during a motion in one direction, from one yield to the other: all motions follow parts of it, as
/// the law has no other memory.
struct Climb {
    /// Share of the yield force and its slope over the path, at equal steps of the path.
    nodes: Vec<(f64, f64)>,
    slip: [f64; 3],
}

impl Climb {
    fn new(slip: [f64; 3]) -> Self {
        let mut climb = Self { nodes: Vec::new(), slip };
        let mut u = -1.0;
        while u < 1.0 - NEAR && climb.nodes.len() < MOST {
            let a = climb.slope(u);
            climb.nodes.push((u, a));
            let b = climb.slope(u + 0.5 * STEP * a);
            let c = climb.slope(u + 0.5 * STEP * b);
            let d = climb.slope(u + STEP * c);
            u += STEP * (a + 2.0 * b + 2.0 * c + d) / 6.0;
        }
        climb.nodes.push((u.min(1.0), 0.0));
        climb
    }

    fn slope(&self, u: f64) -> f64 {
        let [depth, width, place] = self.slip;
        let bare = 1.0 - u * u.abs().powf(SHARPNESS - 1.0);
        bare * (1.0 - depth * (-((u - place) / width).powi(2)).exp())
    }

    /// State after a path from the yield behind.
    fn state(&self, path: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let far = path / STEP;
        if far >= last as f64 {
            return self.nodes[last].0;
        }
        let i = far as usize;
        let ((a, p), (b, q)) = (self.nodes[i], self.nodes[i + 1]);
        let (t, rise) = (far - i as f64, b - a);
        let (p, q) = (STEP * p, STEP * q);
        a + t * (p + t * (3.0 * rise - 2.0 * p - q + t * (p + q - 2.0 * rise)))
    }

    /// Path from the yield behind to a state.
    fn path(&self, state: f64) -> f64 {
        let i = self.nodes.partition_point(|(u, _)| *u <= state).clamp(1, self.nodes.len() - 1) - 1;
        let ((a, p), (b, q)) = (self.nodes[i], self.nodes[i + 1]);
        let (from, to) = (i as f64 * STEP, (i + 1) as f64 * STEP);
        let mut path = from + STEP * (state - a) / (b - a);
        for _ in 0..NEWTON {
            let slope = p + (q - p) * (path - from) / STEP;
            path = (path + (state - self.state(path)) / slope.max(NEAR)).clamp(from, to);
        }
        path
    }
}

/// State over its yield value along the displacement.
fn slipping(scene: &Scene, shape: &[f64]) -> Vec<f64> {
    let climb = Climb::new([shape[1], shape[2], shape[3]]);
    let (x, rho) = (scene.displacement, shape[0]);
    let (mut side, mut path) = (1.0, climb.path(0.0));
    scene.trace(0.0, |w, i| {
        let far = x[i] - x[i - 1];
        if far * side < 0.0 {
            (side, path) = (-side, climb.path(-w * side));
        }
        path += rho * far.abs();
        side * climb.state(path)
    })
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
                    ideal_below(within("q", "", 0.0, 0.5)),
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
