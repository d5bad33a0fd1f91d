//! Creep: logarithmic or very slow relaxation.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_c` | stiffness that relaxes, a decade or in all | N/mm | >= 0 |
//! | `t_0` | time after which it begins | s | two samples to the longest recording |
//! | `tau_c` | relaxation time | s | 1/3 to 30 times the longest recording |
//! | s | share of the stiffness lost a decade, or (to an end) in the end | - | 0 to 0.4, or 0.95 |
//! | p | power | - | 0 to 1 |
//! | `tau_a` | time after which 63 % of it is lost | s | 1 % to a hundred times the longest recording |
//!
//! The logarithmic kernel falls with `log10(1 + t/t_0)`: a spectrum of relaxation times that is flat above `t_0` and fades
//! below it as `exp(-t_0/tau)`, here up to a hundred times the longest recording: the same for all, so that none is
//! stiffer.
//! Its spectrum may also begin at once (a box spectrum). What ages goes on ageing from one recording of a specimen to the
//! next, without the rests between them. A recording that is cut from a steady motion has moved so before.
//! Reference: Findley, Lai and Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials, 1976; Fung,
//! Biomechanics: Mechanical Properties of Living Tissues, 1981.
//! Known limit: with a mean displacement and in one recording it cannot be told from drift.

use super::before::Before;
use super::maxwell::branches;
use super::{
    About, Effect, Factors, Scene, Sizes, ideal_above, ideal_below, order_within, orders, positive, within,
};
use crate::parameter::Parameter;

/// Relaxation times a decade in the spectrum.
const A_DECADE: f64 = 2.0;

/// Form of the creep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Creep {
    /// The memory of every motion fades with the logarithm of its age.
    Logarithmic,
    /// A spectrum that begins at once.
    Box,
    /// One very slow branch.
    Slow,
    /// The stiffness falls with the logarithm of the time since the start.
    Ageing,
    /// The whole force falls so.
    AgeingWhole,
    /// The stiffness falls with a power of the time since the start.
    AgeingPower,
    /// The stiffness falls exponentially to an end.
    AgeingToAnEnd,
}

/// The shortest relaxation time in shares of `t_0`: less than 1 % of the spectrum is left there.
const SHORTEST: f64 = 0.2;
/// The longest in durations of the longest recording: beyond, a branch is a spring.
const LONGEST: f64 = 100.0;

/// Relaxation of one unit of stiffness a decade, from the shortest time on, with a spectrum.
fn fading(scene: &Scene, shortest: f64, spectrum: impl Fn(f64) -> f64) -> Vec<f64> {
    let decades = (LONGEST * scene.sizes.duration / shortest).log10().max(1.0);
    let count = (A_DECADE * decades).ceil() as usize + 1;
    let weight = decades / (count - 1) as f64;
    let taus = orders(shortest, shortest * 10.0_f64.powf(decades), count);
    // From rest or a steady motion: a slow spectrum with another past, unknown, would be slow noise.
    branches(scene, Before::of(scene), taus.into_iter().map(|tau| (tau, weight * spectrum(tau))))
}

impl Creep {
    /// True where the device ages as a whole, and no memory fades.
    fn ages(self) -> bool {
        !matches!(self, Self::Logarithmic | Self::Box | Self::Slow)
    }
}

impl Effect for Creep {
    fn about(&self) -> About {
        let logarithmic = About {
            effect: "creep",
            law: "logarithmic",
            plain: "the force creeps: it relaxes with the logarithm of time or very slowly",
            equation: "F_c = sum_i exp(-t_0/tau_i) z_i, dz_i/dt = k_c v - z_i/tau_i, tau_i evenly over the decades",
            reference: "Findley, Lai and Onaran 1976",
            limit: "with a mean displacement and in one recording it cannot be told from drift",
        };
        match self {
            Self::Logarithmic => logarithmic,
            Self::Box => About {
                law: "box spectrum",
                equation: "F_c = sum_i z_i, dz_i/dt = k_c v - z_i/tau_i, tau_i evenly over the decades above t_0",
                reference: "Fung, Biomechanics, 1981",
                ..logarithmic
            },
            Self::Slow => About {
                law: "one slow branch",
                equation: "dF_c/dt = k_c v - F_c/tau_c",
                reference: "Maxwell 1867",
                ..logarithmic
            },
            Self::Ageing => About {
                law: "ageing, stiffness",
                equation: "k -> k (1 - s log10(1 + t/t_0))",
                reference: "Struik, Physical Aging in Amorphous Polymers and Other Materials, 1978",
                ..logarithmic
            },
            Self::AgeingWhole => About {
                law: "ageing, whole force",
                equation: "F -> F (1 - s log10(1 + t/t_0))",
                reference: "Struik, Physical Aging in Amorphous Polymers and Other Materials, 1978",
                ..logarithmic
            },
            Self::AgeingPower => About {
                law: "ageing by a power, stiffness",
                equation: "k -> k (1 + t/t_0)^(-p)",
                reference: "Struik, Physical Aging in Amorphous Polymers and Other Materials, 1978",
                ..logarithmic
            },
            Self::AgeingToAnEnd => About {
                law: "ageing to an end, stiffness",
                equation: "k -> k (1 - s (1 - exp(-t/tau_a)))",
                reference: "Findley, Lai and Onaran 1976",
                ..logarithmic
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        if self.ages() { Vec::new() } else { vec![positive("k_c", "N/mm")] }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let t_0 = ideal_below(order_within("t_0", "s", 2.0 * sizes.step, sizes.duration));
        match self {
            Self::Logarithmic | Self::Box => vec![t_0],
            Self::Slow => {
                vec![order_within("tau_c", "s", sizes.duration / 3.0, 30.0 * sizes.duration)]
            }
            Self::Ageing | Self::AgeingWhole => vec![within("s", "", 0.0, 0.4), t_0],
            Self::AgeingPower => vec![within("p", "", 0.0, 1.0), t_0],
            Self::AgeingToAnEnd => {
                let tau = order_within("tau_a", "s", 0.01 * sizes.duration, 100.0 * sizes.duration);
                vec![within("s", "", 0.0, 0.95), ideal_above(tau)]
            }
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let early = (10.0 * sizes.step).min(0.1 * sizes.duration).max(2.0 * sizes.step);
        let t_0 = orders(early, 0.3 * sizes.duration, 3);
        match self {
            Self::Logarithmic | Self::Box => t_0.into_iter().map(|t| vec![t]).collect(),
            Self::Slow => vec![vec![0.5 * sizes.duration], vec![2.0 * sizes.duration]],
            Self::Ageing | Self::AgeingWhole | Self::AgeingPower => {
                t_0.into_iter().map(|t| vec![0.05, t]).collect()
            }
            Self::AgeingToAnEnd => {
                [0.05, 0.2, 0.8].map(|share| vec![0.2, share * sizes.life * sizes.duration]).to_vec()
            }
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        match self {
            Self::Logarithmic => {
                vec![fading(scene, SHORTEST * shape[0], |tau| (-shape[0] / tau).exp())]
            }
            Self::Box => vec![fading(scene, shape[0], |_| 1.0)],
            Self::Slow => vec![branches(scene, Before::of(scene), [(shape[0], 1.0)].into_iter())],
            _ => Vec::new(),
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let since = |over: f64| scene.time.iter().map(move |t| (scene.past.time + t - scene.time[0]) / over);
        Some(match self {
            Self::Ageing | Self::AgeingWhole => {
                let decades: Vec<f64> = since(shape[1]).map(|t| (1.0 + t).log10()).collect();
                Factors::losing(shape[0], &decades, *self == Self::AgeingWhole)
            }
            Self::AgeingPower => {
                Factors::kept(since(shape[1]).map(|t| (1.0 + t).powf(-shape[0])).collect(), false)
            }
            Self::AgeingToAnEnd => {
                let lost: Vec<f64> = since(shape[1]).map(|t| -(-t).exp_m1()).collect();
                Factors::losing(shape[0], &lost, false)
            }
            Self::Logarithmic | Self::Box | Self::Slow => return None,
        })
    }
}
