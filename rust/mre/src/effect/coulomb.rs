//! Coulomb friction: a force of constant size against the motion.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `F_c` | friction force | N | >= 0 |
//! | `z_y` | pre-sliding displacement (Dahl, slider) | mm | 0.01 % to 5 % of the largest stroke |
//! | gamma | how slowly the friction comes to its size (Dahl) | - | 0.3 to 3 |
//! | `v_s` | velocity over which the sign is smoothed | mm/s | 0.001 % to 5 % of the largest speed |
//! | n | how sharply the sign is rounded | - | 1 to 4 |
//!
//! Dahl's element and the slider are integrated exactly in the displacement. At the lower end of `v_s` a smoothed or
//! rounded sign is the sign itself, as it is of a velocity that only its rounding keeps from zero.
//! Reference: Dahl, Aerospace Corporation TOR-0158(3107-18)-1, 1968; Jenkins 1962, for the slider.
//! Known limit: where all strokes are long against `z_y`, its value is not determined.

use super::operators::{dahl, dahl_of, each, sign, slider};
use super::{About, Effect, Scene, Sizes, ideal_below, order_within, positive, within};
use crate::parameter::Parameter;

/// A share by which numbers differ that went through a logarithm.
const ROUNDING: f64 = 1e-9;

/// Shares of the stroke, and exponents, from which a fit starts.
const SHARES: [f64; 4] = [0.001, 0.004, 0.012, 0.035];
const EXPONENTS: [f64; 2] = [0.5, 2.0];

/// Velocity in mm/s below which the sign is sharp.
fn sharp(sizes: &Sizes) -> f64 {
    1e-5 * sizes.velocity
}

/// The velocity over which the sign is smoothed.
fn over(sizes: &Sizes) -> Parameter {
    ideal_below(order_within("v_s", "mm/s", sharp(sizes), 0.05 * sizes.velocity))
}

/// How the sign of the velocity is smoothed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Coulomb {
    /// Over a displacement.
    Dahl,
    /// The same with any exponent.
    DahlOf,
    /// Not at all before it slips: elastic up to there.
    Slider,
    /// Over a velocity.
    Smoothed,
    /// Over a velocity, of any roundness.
    Rounded,
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
            Self::DahlOf => About {
                law: "Dahl, any exponent",
                equation: "F_f = F_c z, dz/dt = v (1 - z sgn v)^gamma/z_y",
                ..dahl
            },
            Self::Slider => About {
                law: "elastic slider",
                equation: "F_f = F_c z, dz/dt = v/z_y, |z| <= 1",
                reference: "Coulomb 1785; Jenkins 1962",
                ..dahl
            },
            Self::Rounded => {
                About { law: "rounded sign", equation: "F_f = F_c v/(|v|^n + v_s^n)^(1/n)", ..dahl }
            }
            Self::Smoothed => About { law: "smoothed sign", equation: "F_f = F_c tanh(v/v_s)", ..dahl },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("F_c", "N")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let before_it_slides = ideal_below(order_within("z_y", "mm", 1e-4 * x, 0.05 * x));
        match self {
            Self::Dahl | Self::Slider => vec![before_it_slides],
            Self::DahlOf => vec![before_it_slides, order_within("gamma", "", 0.3, 3.0)],
            Self::Smoothed => vec![over(sizes)],
            Self::Rounded => vec![over(sizes), within("n", "", 1.0, 4.0)],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let (x, v) = (sizes.displacement, sizes.velocity);
        match self {
            Self::Dahl | Self::Slider => SHARES.map(|share| vec![share * x]).to_vec(),
            Self::DahlOf => {
                EXPONENTS.iter().flat_map(|gamma| SHARES.map(|share| vec![share * x, *gamma])).collect()
            }
            Self::Smoothed => [1e-4, 0.003, 0.01, 0.035].map(|share| vec![share * v]).to_vec(),
            Self::Rounded => [1.2, 2.0]
                .iter()
                .flat_map(|n| [0.003, 0.01, 0.035].map(|share| vec![share * v, *n]))
                .collect(),
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![match self {
            Self::Dahl => dahl(scene, shape[0]),
            Self::DahlOf => dahl_of(scene, shape[0], shape[1]),
            Self::Slider => slider(scene, shape[0]),
            Self::Smoothed | Self::Rounded if shape[0] <= (1.0 + ROUNDING) * sharp(scene.sizes) => {
                each(scene.velocity, sign)
            }
            Self::Smoothed => each(scene.velocity, |v| (v / shape[0]).tanh()),
            Self::Rounded => each(scene.velocity, |v| {
                let u = (v.abs() / shape[0]).powf(shape[1]);
                (u / (1.0 + u)).powf(1.0 / shape[1]).copysign(v)
            }),
        }]
    }
}
