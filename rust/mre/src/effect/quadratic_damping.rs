//! Quadratic damping: viscous damping whose power of the velocity is not one.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `c_p`, p | coefficient and power | N (s/mm)^p, - | >= 0, 0.2 to 3 |
//! | `c_2` | coefficient of the square | N s^2/mm^2 | >= 0 |
//! | `c_d`, p | coefficient of what is more one way, and its power | N (s/mm)^p, - | any, 0.5 to 3 |
//! | `c_up`, `c_down`, p | coefficients up and down, and their power | N (s/mm)^p, - | >= 0, 1.3 to 3 |
//! | `c_n`, `v_n`, p | damping at rest, velocity above which it thins, power of the force there | N s/mm, mm/s, - | >= 0, 1 % to 100 % of the largest speed, 0.02 to 0.95 |
//! | `F_e`, `v_e` | force and velocity of Eyring's flow | N, mm/s | >= 0, 3 % to 100 % of the largest speed |
//!
//! Reference: Crandall, J. Sound Vib. 11 (1970) 3 (damping laws); Eyring, J. Chem. Phys. 4 (1936) 283; Carreau, Trans. Soc.
//! Rheol. 16 (1972) 99.
//! Known limit: at one steady sine it cannot be told from friction or hysteresis.

use super::operators::{each, sign};
use super::{About, Effect, Scene, Sizes, ideal_above, order_within, positive, signed, within};
use crate::parameter::Parameter;

/// Form of the damping law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum QuadraticDamping {
    /// `|v| v`.
    Square,
    /// Any power.
    Power,
    /// `asinh(v/v_e)`.
    Eyring,
    /// Linear at low speed, a power below one at high.
    Carreau,
    /// `|v|^p`: more one way than the other, as bump and rebound of a shock absorber.
    OneWay,
    /// Any power above one, of another size each way.
    EachWay,
}

impl Effect for QuadraticDamping {
    fn about(&self) -> About {
        let square = About {
            effect: "quadratic_damping",
            law: "square",
            plain: "the damping force is not proportional to the velocity",
            equation: "F_d = c_2 |v| v",
            reference: "Crandall 1970",
            limit: "at one steady sine it cannot be told from friction or hysteresis",
        };
        match self {
            Self::Square => square,
            Self::Power => About { law: "power", equation: "F_d = c_p |v|^p sgn v", ..square },
            Self::Eyring => About {
                law: "Eyring",
                equation: "F_d = F_e asinh(v/v_e)",
                reference: "Eyring 1936",
                ..square
            },
            Self::Carreau => About {
                law: "Carreau",
                equation: "F_d = c_n v (1 + (v/v_n)^2)^((p - 1)/2)",
                reference: "Carreau 1972",
                ..square
            },
            Self::OneWay => About {
                law: "by direction",
                equation: "F_d = c_d |v|^p",
                limit: "at one steady sine it cannot be told from an asymmetric stiffness",
                ..square
            },
            Self::EachWay => About {
                law: "power, by direction",
                equation: "F_d = c_up v^p where v > 0, -c_down (-v)^p where v < 0",
                ..square
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        match self {
            Self::Square => vec![positive("c_2", "N s^2/mm^2")],
            Self::Power => vec![positive("c_p", "N (s/mm)^p")],
            Self::Eyring => vec![positive("F_e", "N")],
            Self::Carreau => vec![positive("c_n", "N s/mm")],
            Self::OneWay => vec![signed("c_d", "N (s/mm)^p")],
            Self::EachWay => vec![positive("c_up", "N (s/mm)^p"), positive("c_down", "N (s/mm)^p")],
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        match self {
            Self::Square => Vec::new(),
            Self::Power => vec![ideal_above(within("p", "", 0.2, 3.0))],
            Self::Eyring => {
                vec![ideal_above(order_within("v_e", "mm/s", 0.03 * sizes.velocity, sizes.velocity))]
            }
            Self::Carreau => {
                let thins = order_within("v_n", "mm/s", 0.01 * sizes.velocity, sizes.velocity);
                vec![thins, within("p", "", 0.02, 0.95)]
            }
            Self::OneWay => vec![within("p", "", 0.5, 3.0)],
            Self::EachWay => vec![within("p", "", 1.3, 3.0)],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Square => vec![Vec::new()],
            Self::Power => [0.3, 0.5, 0.7, 1.5, 2.0, 2.5, 3.0].iter().map(|p| vec![*p]).collect(),
            Self::Eyring => [0.05, 0.15, 0.5].iter().map(|share| vec![share * sizes.velocity]).collect(),
            Self::Carreau => {
                [0.03, 0.2].iter().flat_map(|n| [0.2, 0.6].map(|p| vec![n * sizes.velocity, p])).collect()
            }
            Self::OneWay => [0.6, 1.0, 2.0].iter().map(|p| vec![*p]).collect(),
            Self::EachWay => [1.5, 2.0, 2.7].iter().map(|p| vec![*p]).collect(),
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let of = |force: &dyn Fn(f64) -> f64| each(scene.velocity, force);
        match self {
            Self::Square => vec![of(&|v| v.abs() * v)],
            Self::Power => vec![of(&|v| v.abs().powf(shape[0]) * sign(v))],
            Self::Eyring => vec![of(&|v| (v / shape[0]).asinh())],
            Self::Carreau => {
                let power = 0.5 * (shape[1] - 1.0);
                vec![of(&|v| v * (1.0 + (v / shape[0]).powi(2)).powf(power))]
            }
            Self::OneWay => vec![of(&|v| v.abs().powf(shape[0]))],
            Self::EachWay => {
                vec![of(&|v| v.max(0.0).powf(shape[0])), of(&|v| -(-v).max(0.0).powf(shape[0]))]
            }
        }
    }
}
