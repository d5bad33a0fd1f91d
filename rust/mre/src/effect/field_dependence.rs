//! Field dependence: stiffness and damping follow the current in a way that is not affine.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost in the middle of the span of the current, or by saturation (negative: gained) | - | -6 to 0.95 |
//! | `k_i`, `c_i`, `k_i3` | change of stiffness, damping and cubic stiffness | N/mm, N s/mm, N/mm^3 | any |
//! | `F_i`, `F_q` | force at rest that goes with the current: along a straight line, and bent | N | any |
//! | `I_s` | current of saturation | A | 10 % to 200 % of the span of the current |
//!
//! q vanishes at the lowest and at the highest current: what is affine belongs to the base model.
//! Reference: Jolly, Carlson and Munoz, Smart Mater. Struct. 5 (1996) 607 (saturation).
//! Known limit: without at least three levels of the current it cannot be seen.

use super::remanence::following;
use super::{About, Effect, Factors, Scene, Sizes, ideal_above, order_within, signed, within};
use crate::parameter::Parameter;

/// How the parameters leave the affine law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FieldDependence {
    /// As the square of the current.
    Square,
    /// By saturation.
    Saturating,
    /// A force at rest, of which the base has one for all currents.
    Force,
    /// A part of the force by one factor.
    Scaled(Of),
    /// The same by a factor that saturates.
    ScaledSaturating(Of),
}

/// What is scaled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    /// All that stores energy and all hysteresis.
    Stiffness,
    /// What is viscous.
    Damping,
    /// The whole force.
    Whole,
}

/// A function of the current from 0 at its lowest to 1 at its highest.
fn departure(scene: &Scene, bent: impl Fn(f64) -> f64) -> Vec<f64> {
    let (span, low) = (scene.sizes.current_span(), scene.sizes.current.map_or(0.0, |(low, _)| low));
    let still = vec![low; scene.len()];
    scene.current.unwrap_or(&still).iter().map(|i| bent((i - low) / span)).collect()
}

impl Effect for FieldDependence {
    fn about(&self) -> About {
        let square = About {
            effect: "field_dependence",
            law: "square",
            plain: "stiffness and damping do not follow the current along a straight line",
            equation: "F_q = (k_i x + c_i v + k_i3 x^3) q, q = (I - I_low)(I - I_high)/(I_high - I_low)^2",
            reference: "Jolly, Carlson and Munoz 1996",
            limit: "without at least three levels of the current it cannot be seen",
        };
        match self {
            Self::Square => square,
            Self::Saturating => About {
                law: "saturating",
                equation: "F_q = (k_i x + c_i v + k_i3 x^3) q, q = tanh((I - I_low)/I_s) less its chord",
                ..square
            },
            Self::Force => About {
                law: "force at rest",
                plain: "the force at rest follows the current",
                equation: "F_q = F_i u + F_q u (u - 1), u = (I - I_low)/(I_high - I_low)",
                reference: "general",
                limit: "where all recordings have constant currents it belongs to the base",
                ..square
            },
            Self::Scaled(of) => About {
                law: match of {
                    Of::Stiffness => "stiffness scaled",
                    Of::Damping => "damping scaled",
                    Of::Whole => "whole force scaled",
                },
                equation: match of {
                    Of::Stiffness => "k -> k (1 - s q), q = 4 (I - I_low)(I_high - I)/(I_high - I_low)^2",
                    Of::Damping => "c -> c (1 - s q), q = 4 (I - I_low)(I_high - I)/(I_high - I_low)^2",
                    Of::Whole => "F -> F (1 - s q), q = 4 (I - I_low)(I_high - I)/(I_high - I_low)^2",
                },
                ..square
            },
            Self::ScaledSaturating(of) => About {
                law: match of {
                    Of::Stiffness => "stiffness scaled, saturating",
                    Of::Damping => "damping scaled, saturating",
                    Of::Whole => "whole force scaled, saturating",
                },
                equation: match of {
                    Of::Stiffness => "k -> k (1 - s tanh((I - I_low)/I_s))",
                    Of::Damping => "c -> c (1 - s tanh((I - I_low)/I_s))",
                    Of::Whole => "F -> F (1 - s tanh((I - I_low)/I_s))",
                },
                ..square
            },
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.current_varies
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Square | Self::Saturating => {
                vec![signed("k_i", "N/mm"), signed("c_i", "N s/mm"), signed("k_i3", "N/mm^3")]
            }
            Self::Force => vec![signed("F_i", "N"), signed("F_q", "N")],
            Self::Scaled(_) | Self::ScaledSaturating(_) => Vec::new(),
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let span = sizes.current_span();
        let saturation = ideal_above(order_within("I_s", "A", 0.1 * span, 2.0 * span));
        let share = within("s", "", -6.0, 0.95);
        match self {
            Self::Square | Self::Force => Vec::new(),
            Self::Saturating => vec![saturation],
            Self::Scaled(_) => vec![share],
            Self::ScaledSaturating(_) => vec![share, saturation],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Square | Self::Force => vec![Vec::new()],
            Self::Saturating => {
                [0.2, 0.5, 1.2].iter().map(|share| vec![share * sizes.current_span()]).collect()
            }
            Self::Scaled(_) => vec![vec![-0.2], vec![0.2]],
            Self::ScaledSaturating(_) => {
                [0.2, 0.5, 1.2].iter().map(|share| vec![-0.2, share * sizes.current_span()]).collect()
            }
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let span = scene.sizes.current_span();
        let q = match self {
            Self::Square => departure(scene, |u| u * (u - 1.0)),
            Self::Saturating => {
                let ratio = span / shape[0];
                departure(scene, |u| (u * ratio).tanh() - u * ratio.tanh())
            }
            Self::Force => return vec![departure(scene, |u| u), departure(scene, |u| u * (u - 1.0))],
            Self::Scaled(_) | Self::ScaledSaturating(_) => return Vec::new(),
        };
        let mut columns = following(scene, &q);
        columns.push(q.iter().zip(scene.displacement).map(|(q, x)| q * x * x * x).collect());
        columns
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let ratio = |saturation: f64| scene.sizes.current_span() / saturation;
        let (q, of) = match self {
            Self::Scaled(of) => (departure(scene, |u| 4.0 * u * (1.0 - u)), of),
            Self::ScaledSaturating(of) => (departure(scene, |u| (u * ratio(shape[1])).tanh()), of),
            Self::Square | Self::Saturating | Self::Force => return None,
        };
        let factors = Factors::losing(shape[0], &q, *of == Of::Whole);
        Some(if *of == Of::Damping { factors.of_damping() } else { factors })
    }
}
