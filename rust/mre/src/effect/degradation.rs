//! Cyclic degradation: the stiffness falls with the path travelled or the energy put in and does not come back.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the longest path or the most energy (linear), or in the end (saturating) | - | 0 to 0.95 |
//! | `P_c` | path at which 63 % of it is lost | mm | 1 % to 200 % of the longest path |
//! | `E_c` | energy at which 63 % of it is lost | N mm | 1 % to 200 % of the most energy |
//!
//! The energy is the integral of `|F v|` with the force of the base model alone.
//! Reference: Baber and Wen, J. Eng. Mech. Div. 107 (1981) 1069.
//! Known limit: over a few equal cycles it cannot be told from thermal softening.

use super::operators::integral;
use super::{About, Effect, Factors, Scene, Sizes, order_within, within};
use crate::parameter::Parameter;

/// A law of degradation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Degradation {
    /// True where it follows the energy, not the path.
    pub(super) by_energy: bool,
    /// True where it saturates.
    pub(super) saturates: bool,
    /// True where damping degrades like stiffness.
    pub(super) whole: bool,
}

/// Path travelled since the first sample, mm.
fn travelled(scene: &Scene) -> Vec<f64> {
    integral(scene, |i| scene.velocity[i].abs())
}

/// Energy moved since the first sample, N mm.
fn worked(scene: &Scene) -> Vec<f64> {
    integral(scene, |i| (scene.force[i] * scene.velocity[i]).abs())
}

impl Degradation {
    /// Largest progress over the campaign.
    fn most(self, sizes: &Sizes) -> f64 {
        if self.by_energy { sizes.energy } else { sizes.path }
    }
}

impl Effect for Degradation {
    fn about(&self) -> About {
        let (law, equation) = match (self.by_energy, self.saturates, self.whole) {
            (false, false, false) => ("path, stiffness", "k -> k (1 - s P/P_max), P the path travelled"),
            (false, false, true) => ("path, whole force", "F -> F (1 - s P/P_max), P the path travelled"),
            (false, true, false) => {
                ("path, saturating, stiffness", "k -> k (1 - s (1 - exp(-P/P_c))), P the path travelled")
            }
            (false, true, true) => {
                ("path, saturating, whole force", "F -> F (1 - s (1 - exp(-P/P_c))), P the path travelled")
            }
            (true, false, false) => ("energy, stiffness", "k -> k (1 - s E/E_max), E the integral of |F v|"),
            (true, false, true) => ("energy, whole force", "F -> F (1 - s E/E_max), E the integral of |F v|"),
            (true, true, false) => {
                ("energy, saturating, stiffness", "k -> k (1 - s (1 - exp(-E/E_c))), E the integral of |F v|")
            }
            (true, true, true) => (
                "energy, saturating, whole force",
                "F -> F (1 - s (1 - exp(-E/E_c))), E the integral of |F v|",
            ),
        };
        About {
            effect: "cyclic_degradation",
            law,
            plain: "the device gets softer with every cycle and does not recover",
            equation,
            reference: "Baber and Wen 1981",
            limit: "over a few equal cycles it cannot be told from thermal softening",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let mut shape = vec![within("s", "", 0.0, 0.95)];
        if self.saturates {
            let (name, unit) = if self.by_energy { ("E_c", "N mm") } else { ("P_c", "mm") };
            let most = self.most(sizes);
            shape.push(order_within(name, unit, 0.01 * most, 2.0 * most));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        if self.saturates {
            [0.03, 0.12, 0.5].iter().map(|share| vec![0.2, share * self.most(sizes)]).collect()
        } else {
            vec![vec![0.2]]
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let mut progress = if self.by_energy { worked(scene) } else { travelled(scene) };
        let most = self.most(scene.sizes);
        for p in &mut progress {
            *p = if self.saturates { -(-*p / shape[1]).exp_m1() } else { *p / most };
        }
        Some(Factors::losing(shape[0], &progress, self.whole))
    }
}
