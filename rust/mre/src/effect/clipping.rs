//! Force clipping: the channel of the force does not show more than a level.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | L | level | N | 30 % to 100 % of the largest measured force; approached gradually: 60 % to 400 % |
//! | p | sharpness of the knee | 1 | 1 to 30 |
//!
//! Of the measurement, not of the device: a simulation leaves it out.
//! Reference of the gradual one: the saturation of an amplifier (Rapp, 2nd European Conference on Satellite
//! Communications, 1991, 179).
//! Known limit: at one amplitude it is close to a softening spring.

use super::{About, Effect, Flexibility, Scene, Sizes, ideal_above, order_within, within};
use crate::parameter::Parameter;

/// A level on one side only is this many times as far on the other: beyond every measured force.
const FAR: f64 = 4.0;

/// On which side the force is clipped, or how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Clipping {
    /// On both, at the same level.
    Both,
    /// From above.
    Upper,
    /// From below.
    Lower,
    /// On both, by an amplifier that is driven into saturation.
    Gradual,
}

impl Effect for Clipping {
    fn about(&self) -> About {
        let both = About {
            effect: "force_clipping",
            law: "both sides",
            plain: "the measured force is cut off at a level",
            equation: "F_measured = min(max(F, -L), L)",
            reference: "general",
            limit: "at one amplitude it is close to a softening spring",
        };
        match self {
            Self::Both => both,
            Self::Upper => About { law: "from above", equation: "F_measured = min(F, L)", ..both },
            Self::Lower => About { law: "from below", equation: "F_measured = max(F, -L)", ..both },
            Self::Gradual => About {
                law: "gradual",
                plain: "the measured force is bent over towards a level",
                equation: "F_measured = F / (1 + |F/L|^p)^(1/p)",
                reference: "Rapp 1991",
                ..both
            },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Gradual => vec![
                order_within("L", "N", 0.6 * sizes.force, 4.0 * sizes.force),
                ideal_above(order_within("p", "1", 1.0, 30.0)),
            ],
            _ => vec![within("L", "N", 0.3 * sizes.force, sizes.force)],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let levels = [0.5, 0.6, 0.7, 0.8, 0.88, 0.94, 0.98];
        match self {
            Self::Gradual => {
                [[0.9, 12.0], [1.05, 5.0], [1.5, 2.5]].map(|[l, p]| vec![l * sizes.force, p]).to_vec()
            }
            _ => levels.map(|share| vec![share * sizes.force]).to_vec(),
        }
    }

    fn clip(&self, shape: &[f64]) -> Option<(f64, f64)> {
        let level = shape[0];
        match self {
            Self::Both => Some((-level, level)),
            Self::Upper => Some((-FAR * level, level)),
            Self::Lower => Some((-level, FAR * level)),
            Self::Gradual => None,
        }
    }

    fn shown(&self, scene: &Scene, shape: &[f64]) -> Option<Vec<f64>> {
        let [level, sharpness] = *shape else { return None };
        let share = |force: &f64| (1.0 + (force / level).abs().powf(sharpness)).powf(-1.0 / sharpness);
        Some(scene.whole.iter().map(share).collect())
    }

    // Takes nothing from the motion, but follows from the force.
    fn flexibility(&self, _: &[f64]) -> Option<Flexibility> {
        (*self == Self::Gradual).then(Flexibility::default)
    }
}
