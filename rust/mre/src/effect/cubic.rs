//! Cubic stiffness: a smooth odd elastic law that the base model does not have.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_3`, `k_5` | cubic and quintic stiffness | N/mm^3, N/mm^5 | any |
//! | alpha, b | force and inverse displacement of a hyperbolic sine | N, 1/mm | any, 0.3 to 6 over the stroke |
//! | `k_l`, L | stiffness and largest displacement of limited extension | N/mm, mm | any, 1.02 to 4 strokes |
//! | `f_p`, p | force at the largest stroke X, and power | N, - | any, 1.8 to 9 |
//! | `k_s`, `x_s` | stiffness and displacement of saturation | N/mm, mm | any, 10 % to 150 % of the stroke |
//!
//! Reference: Kovacic and Brennan, The Duffing Equation, 2011; Warner, Ind. Eng. Chem. Fundam. 11 (1972) 379
//! (limited extension).
//! Known limit: beside the sinh model it is absorbed almost wholly.

use super::operators::each;
use super::{About, Effect, Scene, Sizes, ideal_above, ideal_below, order_within, signed, within};
use crate::parameter::Parameter;

/// Largest `(x/L)^2` of limited extension; beyond it the force goes on along `x`.
const FULL: f64 = 0.98;

/// Form of the odd elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OddElastic {
    /// `x^3`.
    Cubic,
    /// `x^3` and `x^5`.
    Quintic,
    /// Hyperbolic sine.
    Sinh,
    /// Limited extension.
    Limited,
    /// Saturation.
    Saturating,
    /// Any power.
    Power,
}

impl Effect for OddElastic {
    fn about(&self) -> About {
        let cubic = About {
            effect: "cubic_stiffness",
            law: "cubic",
            plain: "the elastic force bends away from the base model's, equally in both directions",
            equation: "F_3 = k_3 x^3",
            reference: "Duffing 1918",
            limit: "beside the sinh model it is absorbed almost wholly",
        };
        match self {
            Self::Cubic => cubic,
            Self::Quintic => About { law: "cubic and quintic", equation: "F_3 = k_3 x^3 + k_5 x^5", ..cubic },
            Self::Sinh => About { law: "hyperbolic sine", equation: "F_3 = alpha sinh(b x)", ..cubic },
            Self::Limited => About {
                law: "limited extension",
                equation: "F_3 = k_l x u/(1 - u), u = (x/L)^2",
                reference: "Warner 1972",
                ..cubic
            },
            Self::Power => {
                About { law: "power", equation: "F_3 = f_p |x/X|^p sgn x, X the largest |x|", ..cubic }
            }
            Self::Saturating => About { law: "saturating", equation: "F_3 = k_s x_s tanh(x/x_s)", ..cubic },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Cubic => vec![signed("k_3", "N/mm^3")],
            Self::Quintic => vec![signed("k_3", "N/mm^3"), signed("k_5", "N/mm^5")],
            Self::Sinh => vec![signed("alpha", "N")],
            Self::Limited => vec![signed("k_l", "N/mm")],
            Self::Power => vec![signed("f_p", "N")],
            Self::Saturating => vec![signed("k_s", "N/mm")],
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        match self {
            Self::Cubic | Self::Quintic => Vec::new(),
            Self::Sinh => vec![ideal_below(order_within("b", "1/mm", 0.3 / x, 6.0 / x))],
            Self::Limited => vec![ideal_above(order_within("L", "mm", 1.02 * x, 4.0 * x))],
            Self::Power => vec![within("p", "", 1.8, 9.0)],
            Self::Saturating => vec![ideal_above(order_within("x_s", "mm", 0.1 * x, 1.5 * x))],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        match self {
            Self::Cubic | Self::Quintic => vec![Vec::new()],
            Self::Sinh => vec![vec![1.0 / x], vec![2.0 / x], vec![4.0 / x]],
            Self::Limited => vec![vec![1.05 * x], vec![1.2 * x], vec![1.6 * x]],
            Self::Power => vec![vec![2.2], vec![4.0], vec![6.5]],
            Self::Saturating => vec![vec![0.15 * x], vec![0.3 * x], vec![0.7 * x]],
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let x = scene.displacement;
        match self {
            Self::Cubic => vec![each(x, |x| x * x * x)],
            Self::Quintic => vec![each(x, |x| x * x * x), each(x, |x| x.powi(5))],
            Self::Sinh => vec![each(x, |x| (shape[0] * x).clamp(-50.0, 50.0).sinh())],
            Self::Limited => vec![each(x, |x| {
                let u = (x / shape[0]).powi(2).min(FULL);
                x * u / (1.0 - u)
            })],
            Self::Power => {
                vec![each(x, |x| (x.abs() / scene.sizes.displacement).powf(shape[0]).copysign(x))]
            }
            Self::Saturating => vec![each(x, |x| shape[0] * (x / shape[0]).tanh())],
        }
    }
}
