//! Mullins softening: the stiffness falls with the largest strain that was ever reached and does not come back; on one
//! specimen it is also that of earlier recordings.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | largest share that is lost | - | 0 to 0.95 |
//! | `x_m` | displacement whose energy `x_m^2` is the constant of the pseudo-elastic law | mm | 3 % to 150 % of the stroke |
//! | b | growth of that constant with the largest energy | - | 0 to 1 |
//! | `x_c` | largest displacement at which 63 % is lost | mm | 3 % to 200 % of the stroke |
//! | p | power of the largest displacement, or of the share of the distance from it | - | 0.3 to 4 |
//! | a | power of the largest displacement beside that of the distance | - | 0 to 2 |
//!
//! The energy is taken as that of a linear spring, proportional to `x^2`. M is the largest displacement so far.
//! Reference: Ogden and Roxburgh, Proc. R. Soc. A 455 (1999) 2861; Simo, Comput. Methods Appl. Mech. Eng. 60
//! (1987) 153 (damage by the largest strain); Zuniga and Beatty, Int. J. Eng. Sci. 40 (2002) 2265 (by the distance
//! from it).
//! Known limit: after the first cycle at a constant amplitude it is part of k0.

use super::{About, Effect, Factors, Scene, Sizes, ideal_above, ideal_below, order_within, within};
use crate::kernel::elementary::erf;
use crate::parameter::Parameter;

/// What the softening follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Softening {
    /// The distance of the present energy from the largest.
    PseudoElastic,
    /// The largest displacement, exponentially.
    Largest,
    /// The largest displacement, as a power.
    Power,
    /// The distance from the largest displacement, as a power of its share.
    Distance,
}

/// A law of softening, on the stiffness or on the whole force.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mullins {
    /// The law.
    pub(super) by: Softening,
    /// True where damping softens like stiffness.
    pub(super) whole: bool,
}

/// Largest absolute displacement so far.
pub(super) fn largest_past(scene: &Scene) -> Vec<f64> {
    let x = scene.displacement;
    scene.trace(scene.past.displacement.max(x[0].abs()), |largest, i| largest.max(x[i].abs()))
}

impl Effect for Mullins {
    fn about(&self) -> About {
        let law = |stiffness, whole| if self.whole { whole } else { stiffness };
        let pseudo_elastic = About {
            effect: "mullins_softening",
            law: law("Ogden-Roxburgh, stiffness", "Ogden-Roxburgh, whole force"),
            plain: "the device is softer below the largest strain that it has seen",
            equation: "k -> k (1 - s erf((W_m - W)/(m + b W_m))), W = x^2, m = x_m^2, W_m the largest W so far",
            reference: "Mullins 1948; Ogden and Roxburgh 1999",
            limit: "after the first cycle at a constant amplitude it is part of k0",
        };
        match self.by {
            Softening::PseudoElastic => pseudo_elastic,
            Softening::Largest => About {
                law: law("largest strain, stiffness", "largest strain, whole force"),
                equation: "k -> k (1 - s (1 - exp(-M/x_c))), M the largest |x| so far",
                reference: "Simo 1987",
                ..pseudo_elastic
            },
            Softening::Power => About {
                law: law(
                    "power of the largest strain, stiffness",
                    "power of the largest strain, whole force",
                ),
                equation: "k -> k (1 - s (M/X)^p), M the largest |x| so far, X the largest of all",
                reference: "Simo 1987",
                ..pseudo_elastic
            },
            Softening::Distance => About {
                law: law("reloading, stiffness", "reloading, whole force"),
                equation: "k -> k (1 - s (M/X)^a (1 - |x|/M)^p), M the largest |x| so far, X the largest of all",
                reference: "Zuniga and Beatty 2002",
                ..pseudo_elastic
            },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let mut shape = vec![within("s", "", 0.0, 0.95)];
        shape.extend(match self.by {
            Softening::PseudoElastic => {
                vec![
                    ideal_above(order_within("x_m", "mm", 0.03 * x, 1.5 * x)),
                    ideal_below(within("b", "", 0.0, 1.0)),
                ]
            }
            Softening::Largest => vec![ideal_above(order_within("x_c", "mm", 0.03 * x, 2.0 * x))],
            Softening::Power => vec![order_within("p", "", 0.3, 4.0)],
            Softening::Distance => {
                vec![ideal_below(within("a", "", 0.0, 2.0)), order_within("p", "", 0.3, 4.0)]
            }
        });
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        match self.by {
            Softening::PseudoElastic => {
                [0.1, 0.3, 0.8].iter().map(|share| vec![0.2, share * x, 0.1]).collect()
            }
            Softening::Largest => [0.08, 0.25, 0.8].iter().map(|share| vec![0.2, share * x]).collect(),
            Softening::Power => vec![vec![0.2, 0.5], vec![0.2, 1.0], vec![0.2, 2.5]],
            Softening::Distance => {
                vec![vec![0.2, 0.1, 1.0], vec![0.2, 0.1, 2.0], vec![0.2, 1.0, 1.0], vec![0.2, 0.5, 0.5]]
            }
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let x = scene.displacement;
        let lost = |(x, m): (&f64, f64)| match self.by {
            Softening::PseudoElastic => {
                let most = m * m;
                erf((most - x * x) / (shape[1] * shape[1] + shape[2] * most))
            }
            Softening::Largest => -(-m / shape[1]).exp_m1(),
            Softening::Power => (m / scene.sizes.displacement).powf(shape[1]),
            Softening::Distance if m > 0.0 => {
                (m / scene.sizes.displacement).powf(shape[1]) * (1.0 - x.abs() / m).powf(shape[2])
            }
            Softening::Distance => 0.0,
        };
        let lost: Vec<f64> = x.iter().zip(largest_past(scene)).map(lost).collect();
        Some(Factors::losing(shape[0], &lost, self.whole))
    }
}
