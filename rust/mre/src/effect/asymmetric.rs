//! Asymmetric stiffness: the elastic force differs between the two directions.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_2`, `k_4` | even stiffness | N/mm^2, N/mm^4 | any |
//! | `k_u` | half the difference of the stiffness between the directions | N/mm | any |
//! | e | displacement over which the stiffness changes | mm | 1 % to 100 % of the largest stroke |
//! | `k_b`, b | curvature at rest, and rate of the exponential | N/mm^2, 1/mm | any, up to 6 either way at the largest stroke |
//! | `k_p`, p | coefficient and power of what only one direction feels | N/mm^p, - | any, 1 to 6 |
//!
//! Known limit: a hardening spring at an offset shows it too.

use super::operators::each;
use super::{About, Effect, Scene, Sizes, ideal_below, order_within, signed, within};
use crate::parameter::Parameter;

/// Largest rate of an exponential to the largest stroke.
const STEEPEST: f64 = 6.0;
/// Below this a series is nearer than the exponential.
const FLAT: f64 = 1e-3;

/// `(exp(u) - 1 - u)/u^2`, a half at zero.
fn bent(u: f64) -> f64 {
    if u.abs() < FLAT { 0.5 + u / 6.0 } else { (u.exp_m1() - u) / (u * u) }
}

/// Form of the even elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asymmetric {
    /// `x^2`.
    Square,
    /// `|x|`: one stiffness in tension, one in compression.
    OneSided,
    /// The same, one stiffness going over into the other.
    Rounded,
    /// `x^2` and `x^4`.
    Fourth,
    /// An exponential, less its stiffness at rest.
    Exponential,
    /// A power that is felt where the displacement is positive.
    Up,
    /// A power that is felt where it is negative.
    Down,
}

impl Effect for Asymmetric {
    fn about(&self) -> About {
        let square = About {
            effect: "asymmetric_stiffness",
            law: "square",
            plain: "the device is stiffer in one direction than in the other",
            equation: "F_2 = k_2 x^2",
            reference: "Helmholtz 1877; Kovacic and Brennan, The Duffing Equation, 2011",
            limit: "a hardening spring at an offset shows it too",
        };
        match self {
            Self::Square => square,
            Self::OneSided => About {
                law: "two stiffnesses",
                equation: "F_2 = k_u |x|",
                reference: "bilinear spring, general",
                ..square
            },
            Self::Rounded => About {
                law: "two stiffnesses, rounded",
                equation: "F_2 = k_u (sqrt(x^2 + e^2) - e)",
                reference: "bilinear spring, general",
                ..square
            },
            Self::Fourth => {
                About { law: "square and fourth power", equation: "F_2 = k_2 x^2 + k_4 x^4", ..square }
            }
            Self::Exponential => About {
                law: "exponential",
                equation: "F_2 = k_b (exp(b x) - 1 - b x)/b^2",
                reference: "Fung, Biomechanics: Mechanical Properties of Living Tissues, 1981",
                ..square
            },
            Self::Up => About { law: "power, upwards only", equation: "F_2 = k_p x^p where x > 0", ..square },
            Self::Down => {
                About { law: "power, downwards only", equation: "F_2 = k_p (-x)^p where x < 0", ..square }
            }
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Square => vec![signed("k_2", "N/mm^2")],
            Self::OneSided | Self::Rounded => vec![signed("k_u", "N/mm")],
            Self::Exponential => vec![signed("k_b", "N/mm^2")],
            Self::Up | Self::Down => vec![signed("k_p", "N/mm^p")],
            Self::Fourth => vec![signed("k_2", "N/mm^2"), signed("k_4", "N/mm^4")],
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        match self {
            Self::Square | Self::OneSided | Self::Fourth => Vec::new(),
            Self::Rounded => vec![ideal_below(order_within("e", "mm", 0.01 * x, x))],
            Self::Exponential => vec![within("b", "1/mm", -STEEPEST / x, STEEPEST / x)],
            Self::Up | Self::Down => vec![within("p", "", 1.0, 6.0)],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        match self {
            Self::Square | Self::OneSided | Self::Fourth => vec![Vec::new()],
            Self::Rounded => vec![vec![0.1 * x], vec![0.4 * x]],
            Self::Exponential => [-3.0, -1.0, 1.0, 3.0].map(|b| vec![b / x]).to_vec(),
            Self::Up | Self::Down => [1.5, 3.0].map(|p| vec![p]).to_vec(),
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let x = scene.displacement;
        match self {
            Self::Square => vec![each(x, |x| x * x)],
            Self::OneSided => vec![each(x, f64::abs)],
            Self::Rounded => vec![each(x, |x| x.hypot(shape[0]) - shape[0])],
            Self::Fourth => vec![each(x, |x| x * x), each(x, |x| x.powi(4))],
            Self::Exponential => vec![each(x, |x| x * x * bent(shape[0] * x))],
            Self::Up => vec![each(x, |x| x.max(0.0).powf(shape[0]))],
            Self::Down => vec![each(x, |x| (-x).max(0.0).powf(shape[0]))],
        }
    }
}
