//! Asymmetric stiffness: the elastic force differs between the two directions.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_2`, `k_4` | even stiffness | N/mm^2, N/mm^4 | any |
//! | `k_u` | half the difference of the stiffness between the directions | N/mm | any |
//!
//! Known limit: a hardening spring at an offset shows it too.

use super::operators::each;
use super::{About, Effect, Scene, Sizes, signed};
use crate::parameter::Parameter;

/// Form of the even elastic law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asymmetric {
    /// `x^2`.
    Square,
    /// `|x|`: one stiffness in tension, one in compression.
    OneSided,
    /// `x^2` and `x^4`.
    Fourth,
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
            Self::Fourth => {
                About { law: "square and fourth power", equation: "F_2 = k_2 x^2 + k_4 x^4", ..square }
            }
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Square => vec![signed("k_2", "N/mm^2")],
            Self::OneSided => vec![signed("k_u", "N/mm")],
            Self::Fourth => vec![signed("k_2", "N/mm^2"), signed("k_4", "N/mm^4")],
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        let x = scene.displacement;
        match self {
            Self::Square => vec![each(x, |x| x * x)],
            Self::OneSided => vec![each(x, f64::abs)],
            Self::Fourth => vec![each(x, |x| x * x), each(x, |x| x.powi(4))],
        }
    }
}
