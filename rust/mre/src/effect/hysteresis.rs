//! Hysteresis: a force that remembers the path but not the rate, beside the base model.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_w` | hysteretic force at yield | N | >= 0 |
//! | rho | inverse of the yield displacement | 1/mm | yield from 5 % to 300 % of the largest stroke |
//! | sigma | share of the dissipative term | - | 0.5 to 2 |
//! | n | sharpness of the yield | - | 1 to 5 |
//! | `k_h` | stiffness before yield | N/mm | >= 0 |
//! | `r`, `r_max` | yield displacement, and the largest of a distribution | mm | 5 % to 90 % (300 %) of the stroke |
//! | q | exponent of the distribution: yields below r have the share (`r/r_max`)^q | - | 0.2 to 4 |
//!
//! Elements yield and lag behind the force; play operators are what they leave of the displacement, and lag ahead.
//! Reference: Ikhouane and Rodellar 2005, <https://doi.org/10.1007/s11071-005-0069-3>; Iwan, J. Appl. Mech. 33
//! (1966) 893; Segalman, J. Appl. Mech. 72 (2005) 752.
//! Known limit: yields below 5 % of the stroke are friction; above the stroke, they are stiffness.

use super::operators::{play, stop};
use super::{About, Effect, Scene, Sizes, ideal_above, ideal_below, order_within, orders, positive, within};
use crate::kernel::hysteretic;
use crate::kernel::intervals::Plan;
use crate::parameter::{Parameter, Scale};

/// Elements of a distribution of yields.
const ELEMENTS: usize = 10;

/// Kind of memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Hysteresis {
    /// Smooth.
    BoucWen,
    /// One elastic-perfectly-plastic element.
    Jenkins,
    /// A uniform distribution of such elements.
    Iwan,
    /// A power distribution.
    PowerIwan,
    /// One play operator.
    Play,
    /// A uniform distribution of play operators.
    Plays,
}

/// Elements in parallel whose yields have the cumulated share `(r / largest)^q`; stiffness one in all.
fn parallel(scene: &Scene, largest: f64, q: f64) -> Vec<f64> {
    let mut sum = vec![0.0; scene.len()];
    for j in 0..ELEMENTS {
        let share = (j as f64 + 0.5) / ELEMENTS as f64;
        for (s, p) in sum.iter_mut().zip(stop(scene.displacement, largest * share.powf(1.0 / q))) {
            *s += p / ELEMENTS as f64;
        }
    }
    sum
}

fn less(series: &[f64], by: &[f64]) -> Vec<f64> {
    series.iter().zip(by).map(|(s, b)| s - b).collect()
}

/// Normalised hysteretic variable for a shape `[rho, sigma, n]`.
pub(super) fn bouc_wen(scene: &Scene, shape: &[f64]) -> Vec<f64> {
    let mut w = vec![0.0; scene.len()];
    let plan = Plan::of(scene.time, scene.displacement, scene.velocity);
    hysteretic::trace(&plan, [shape[0], shape[1], shape[2]], 0.0, &mut w);
    // Samples too far apart for these parameters show nothing of it.
    if w.iter().all(|w| w.is_finite()) { w } else { vec![0.0; scene.len()] }
}

impl Effect for Hysteresis {
    fn about(&self) -> About {
        let bouc_wen = About {
            effect: "hysteresis",
            law: "Bouc-Wen",
            plain: "a part of the force depends on the path of the motion but not on its rate",
            equation: "F_h = k_w w, dw/dt = rho (v - sigma |v| |w|^(n-1) w + (sigma - 1) v |w|^n)",
            reference: "Bouc 1967; Wen 1976; Ikhouane and Rodellar 2005",
            limit: "at one amplitude it is part of k0, and of c0 at one frequency",
        };
        match self {
            Self::BoucWen => bouc_wen,
            Self::Jenkins => About {
                law: "elastic-plastic element",
                equation: "F_h = k_h p, p = x less its play of half width r",
                reference: "Jenkins 1962; Iwan 1966",
                ..bouc_wen
            },
            Self::Iwan => About {
                law: "Iwan, uniform yields",
                equation: "F_h = k_h mean of p(r) over r from 0 to r_max",
                reference: "Iwan 1966",
                ..bouc_wen
            },
            Self::PowerIwan => About {
                law: "Iwan, power distribution of yields",
                equation: "F_h = k_h mean of p(r) over yields with the share (r/r_max)^q below r",
                reference: "Segalman 2005",
                ..bouc_wen
            },
            Self::Play => About {
                law: "play operator",
                equation: "F_h = k_h q, q = play of half width r of x",
                reference: "Prandtl 1928; Ishlinskii 1944",
                ..bouc_wen
            },
            Self::Plays => About {
                law: "Prandtl-Ishlinskii, uniform widths",
                equation: "F_h = k_h mean of q(r) over r from 0 to r_max",
                reference: "Prandtl 1928; Ishlinskii 1944",
                ..bouc_wen
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![if *self == Self::BoucWen { positive("k_w", "N") } else { positive("k_h", "N/mm") }]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        match self {
            Self::BoucWen => vec![
                order_within("rho", "1/mm", 1.0 / (3.0 * x), 20.0 / x),
                ideal_below(within("sigma", "", 0.5, 2.0)),
                ideal_above(ideal_below(Parameter { scale: Scale::Log, ..within("n", "", 1.0, 5.0) })),
            ],
            Self::Jenkins => vec![order_within("r", "mm", 0.05 * x, 0.9 * x)],
            Self::Play => vec![order_within("r", "mm", 0.005 * x, 0.9 * x)],
            Self::Iwan | Self::Plays => vec![order_within("r_max", "mm", 0.1 * x, 3.0 * x)],
            Self::PowerIwan => {
                vec![
                    order_within("r_max", "mm", 0.1 * x, 3.0 * x),
                    ideal_above(order_within("q", "", 0.2, 4.0)),
                ]
            }
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        match self {
            Self::BoucWen => orders(0.06, 1.5, 5)
                .into_iter()
                .flat_map(|share| [vec![1.0 / (share * x), 0.8, 1.0], vec![1.0 / (share * x), 0.6, 2.5]])
                .collect(),
            Self::Jenkins => orders(0.05, 0.85, 7).into_iter().map(|share| vec![share * x]).collect(),
            Self::Play => orders(0.005, 0.85, 9).into_iter().map(|share| vec![share * x]).collect(),
            Self::Iwan | Self::Plays => {
                orders(0.12, 2.5, 6).into_iter().map(|share| vec![share * x]).collect()
            }
            Self::PowerIwan => orders(0.2, 2.0, 4)
                .into_iter()
                .flat_map(|share| [vec![share * x, 0.4], vec![share * x, 2.0]])
                .collect(),
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        vec![match self {
            Self::BoucWen => bouc_wen(scene, shape),
            Self::Jenkins => stop(scene.displacement, shape[0]),
            Self::Iwan => parallel(scene, shape[0], 1.0),
            Self::PowerIwan => parallel(scene, shape[0], shape[1]),
            Self::Play => play(scene.displacement, shape[0]),
            Self::Plays => less(scene.displacement, &parallel(scene, shape[0], 1.0)),
        }]
    }
}
