//! Fractional viscoelasticity: a springpot, alone or in series with a spring, beside the base model.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `c_a` | coefficient of the springpot | N s^a/mm | >= 0 |
//! | `k_a` | stiffness of the spring in series | N/mm | >= 0 |
//! | a | order of the derivative; the loss angle is a pi/2 | - | 0.05 to 0.95 (0.85 in series) |
//! | tau | time at which the springpot takes over from the spring | s | two samples to the longest recording |
//!
//! The relaxation kernel is a sum of exponentials, by the trapezoidal rule for its spectrum in the logarithm
//! of the rate. Rates beyond the sum act as a dashpot (fast) or a spring (slow), in closed form. A recording that is cut from a
//! steady motion starts with its memory, any other from rest.
//! Reference: Koeller, J. Appl. Mech. 51 (1984) 299; Mainardi, Fractional Calculus and Waves in Linear
//! Viscoelasticity, 2010; Beylkin and Monzon, Appl. Comput. Harmon. Anal. 28 (2010) 131.
//! Known limit: over less than about 1.5 decades of frequency it looks like one Maxwell branch.

use std::f64::consts::PI;

use super::before::Before;
use super::maxwell::branches;
use super::{About, Effect, Scene, Sizes, ideal_below, order_within, orders, positive, within};
use crate::parameter::Parameter;

/// Spacing of the rates, in their natural logarithm, for a springpot: the rule is then exact to 2e-4.
const SPACING: f64 = 1.15;
/// The same for the narrower spectrum of a springpot and a spring: exact to 4e-3 up to the largest order.
const CLOSE_SPACING: f64 = 0.6;

/// Where the springpot stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fractional {
    /// Alone.
    Springpot,
    /// In series with a spring.
    Maxwell,
}

/// Relaxation, from rest or steady motion, with the spectrum `weight(rate)` over the logarithm of the rate; `beyond(low, high)`
/// are its integral below a rate and the integral of `weight(rate) / rate` above one.
fn relaxation(
    scene: &Scene,
    spacing: f64,
    weight: impl Fn(f64) -> f64,
    beyond: impl Fn(f64, f64) -> (f64, f64),
) -> Vec<f64> {
    let (lowest, highest) = (0.1 / scene.duration(), 10.0 / scene.step());
    let count = ((highest / lowest).ln() / spacing).ceil() as usize + 1;
    let rate = |j: f64| lowest * (spacing * j).exp();
    let (spring, dashpot) = beyond(rate(-0.5), rate(count as f64 - 0.5));
    // A spring that relaxes more slowly than the recording has relaxed to where the motion was before.
    let before = Before::of(scene);
    let relaxed_at = before.map_or(scene.displacement[0], |before| before.middle);
    let rates = (0..count).map(|j| rate(j as f64));
    let relaxed = branches(scene, before, rates.map(|rate| (1.0 / rate, spacing * weight(rate))));
    let motion = scene.displacement.iter().zip(scene.velocity);
    motion.zip(relaxed).map(|((x, v), z)| spring * (x - relaxed_at) + dashpot * v + z).collect()
}

/// Caputo derivative of order `a` of the displacement.
fn derivative(scene: &Scene, a: f64) -> Vec<f64> {
    let scale = (PI * a).sin() / PI;
    relaxation(
        scene,
        SPACING,
        |rate| scale * rate.powf(a),
        |low, high| (scale * low.powf(a) / a, scale * high.powf(a - 1.0) / (1.0 - a)),
    )
}

/// Spring of stiffness one in series with a springpot.
fn series(scene: &Scene, a: f64, tau: f64) -> Vec<f64> {
    let (sin, cos) = (PI * a).sin_cos();
    let weight = |rate: f64| {
        let r = (rate * tau).powf(a);
        sin / PI * r / (r * r + 2.0 * r * cos + 1.0)
    };
    relaxation(scene, CLOSE_SPACING, weight, |low, high| {
        let slow = (((low * tau).powf(a) + cos) / sin).atan() - (cos / sin).atan();
        // Above all rates of interest the spectrum falls about as the inverse of the rate does.
        (slow / (PI * a), weight(high) / high)
    })
}

impl Effect for Fractional {
    fn about(&self) -> About {
        let springpot = About {
            effect: "fractional_viscoelasticity",
            law: "springpot",
            plain: "stiffness and damping both grow as a power of the frequency (a springpot)",
            equation: "F_a = c_a D^a x",
            reference: "Koeller 1984; Mainardi, Fractional Calculus and Waves in Linear Viscoelasticity, 2010",
            limit: "over less than about 1.5 decades of frequency it looks like a Maxwell branch",
        };
        match self {
            Self::Springpot => springpot,
            Self::Maxwell => About {
                law: "springpot and spring in series",
                equation: "F_a + tau^a D^a F_a = k_a tau^a D^a x",
                ..springpot
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Springpot => vec![positive("c_a", "N s^a/mm")],
            Self::Maxwell => vec![positive("k_a", "N/mm")],
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Springpot => vec![within("a", "", 0.05, 0.95)],
            Self::Maxwell => {
                vec![
                    within("a", "", 0.05, 0.85),
                    ideal_below(order_within("tau", "s", 2.0 * sizes.step, sizes.duration)),
                ]
            }
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Springpot => [0.1, 0.25, 0.45, 0.65, 0.85].iter().map(|a| vec![*a]).collect(),
            Self::Maxwell => {
                let taus = orders(2.0 * sizes.step, 0.3 * sizes.duration, 5);
                taus[1..].iter().flat_map(|tau| [vec![0.4, *tau], vec![0.7, *tau]]).collect()
            }
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        match self {
            Self::Springpot => vec![derivative(scene, shape[0])],
            Self::Maxwell => vec![series(scene, shape[0], shape[1])],
        }
    }
}
