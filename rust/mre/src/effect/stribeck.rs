//! Stribeck friction: friction that is largest at rest and falls as the motion gets faster.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `F_c` | friction force at speed | N | >= 0 |
//! | `F_b` | excess of the break-away force over it | N | >= 0 |
//! | `v_s` | Stribeck velocity | mm/s | 0.5 % to 60 % of the largest speed |
//! | `z_y` | pre-sliding displacement | mm | 0.01 % to 5 % of the largest stroke |
//! | `v_0` | velocity over which the sign is smoothed | mm/s | 0.001 % to 5 % of the largest speed |
//!
//! The sign of the velocity is that of Coulomb friction: Dahl's element, which holds its force at rest, or a
//! smoothed sign, which does not.
//! Reference: Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30 (1994) 1083.
//! Known limit: at speeds above three times `v_s` it is Coulomb friction.

use super::coulomb::Coulomb;
use super::{About, Effect, Scene, Sizes, ideal_below, order_within, positive};
use crate::parameter::Parameter;

/// Sharpness of the sign from which a fit starts, as shares of the largest stroke or speed.
const SHARP: [f64; 2] = [1e-3, 1e-2];

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
    pub(super) fn excess(self, u: f64) -> f64 {
        match self {
            Self::Gaussian => (-u * u).exp(),
            Self::Exponential => (-u).exp(),
            Self::Hyperbolic => 1.0 / (1.0 + u),
        }
    }
}

impl Stribeck {
    /// Coulomb friction with the same sign of the velocity.
    fn plain(self) -> Coulomb {
        if self.rests { Coulomb::Smoothed } else { Coulomb::Dahl }
    }

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
        let fall = ideal_below(order_within("v_s", "mm/s", 0.005 * sizes.velocity, 0.6 * sizes.velocity));
        let sign = self.plain().shape(sizes).into_iter();
        let sign = sign.map(|p| if self.rests { Parameter { name: "v_0".into(), ..p } } else { p });
        std::iter::once(fall).chain(sign).collect()
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let falls = [0.01, 0.03, 0.08, 0.2, 0.45].map(|share| share * sizes.velocity);
        let size = if self.rests { sizes.velocity } else { sizes.displacement };
        falls.iter().flat_map(|fall| SHARP.map(|share| vec![*fall, share * size])).collect()
    }

    fn own(&self) -> Option<&'static str> {
        Some("F_b")
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let side = self.plain().columns(scene, &shape[1..]).swap_remove(0);
        let excess =
            side.iter().zip(scene.velocity).map(|(z, v)| z * self.fall.excess(v.abs() / shape[0])).collect();
        vec![side, excess]
    }
}
