//! Stribeck friction: friction that is largest at rest and falls as the motion gets faster.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `F_c` | friction force at speed | N | >= 0 |
//! | `F_b` | excess of the break-away force over it | N | >= 0 |
//! | `v_s` | Stribeck velocity | mm/s | 0.5 % to 60 % of the largest speed |
//!
//! The sign of the velocity is Dahl's element with a pre-sliding of 0.1 % of the largest stroke, which holds
//! its force at rest, or a steep function of the velocity, which does not.
//! Reference: Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30 (1994) 1083.
//! Known limit: at speeds above three times `v_s` it is Coulomb friction.

use super::operators::dahl;
use super::{About, Effect, Scene, Sizes, order_within, positive};
use crate::parameter::Parameter;

/// Pre-sliding displacement, share of the largest stroke.
const PRESLIDING: f64 = 1e-3;

/// Speed at which a friction that rests without force has three quarters of it, share of the largest speed.
const REST: f64 = 1e-4;

/// A law of the excess, with or without force at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Stribeck {
    /// How the excess falls.
    pub(super) fall: Fall,
    /// True where the friction vanishes at rest instead of holding.
    pub(super) rests: bool,
}

/// How the excess falls with the speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fall {
    /// `exp(-u^2)`.
    Gaussian,
    /// `exp(-u)`.
    Exponential,
    /// `1 / (1 + u)`.
    Hyperbolic,
}

impl Fall {
    /// Share of the excess at the speed `u v_s`.
    fn excess(self, u: f64) -> f64 {
        match self {
            Self::Gaussian => (-u * u).exp(),
            Self::Exponential => (-u).exp(),
            Self::Hyperbolic => 1.0 / (1.0 + u),
        }
    }
}

impl Stribeck {
    fn named(self, holds: &'static str, rests: &'static str) -> &'static str {
        if self.rests { rests } else { holds }
    }
}

impl Effect for Stribeck {
    fn about(&self) -> About {
        let gaussian = About {
            effect: "stribeck_friction",
            law: "Gaussian",
            plain: "dry friction acts against the motion and is larger at low speed",
            equation: "F_f = [F_c + F_b exp(-(v/v_s)^2)] sgn v",
            reference: "Stribeck 1902; Armstrong-Helouvry, Dupont and Canudas de Wit 1994",
            limit: "above three times v_s it is Coulomb friction",
        };
        match self.fall {
            Fall::Gaussian => About { law: self.named("Gaussian", "Gaussian, no force at rest"), ..gaussian },
            Fall::Exponential => About {
                law: self.named("exponential", "exponential, no force at rest"),
                equation: "F_f = [F_c + F_b exp(-|v|/v_s)] sgn v",
                reference: "Tustin 1947; Bo and Pavelescu 1982",
                ..gaussian
            },
            Fall::Hyperbolic => About {
                law: self.named("hyperbolic", "hyperbolic, no force at rest"),
                equation: "F_f = [F_c + F_b/(1 + |v|/v_s)] sgn v",
                reference: "general",
                ..gaussian
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("F_c", "N"), positive("F_b", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![order_within("v_s", "mm/s", 0.005 * sizes.velocity, 0.6 * sizes.velocity)]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        [0.01, 0.03, 0.08, 0.2, 0.45].iter().map(|share| vec![share * sizes.velocity]).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let side: Vec<f64> = if self.rests {
            scene.velocity.iter().map(|v| (v / (REST * scene.sizes.velocity)).tanh()).collect()
        } else {
            dahl(scene, PRESLIDING * scene.sizes.displacement)
        };
        let excess =
            side.iter().zip(scene.velocity).map(|(z, v)| z * self.fall.excess(v.abs() / shape[0])).collect();
        vec![side, excess]
    }
}
