//! Cyclic degradation: the stiffness falls with the path travelled or the energy put in and does not come back.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the longest path or the most energy (linear), or in the end (saturating) | - | 0 to 0.95 |
//! | `P_c` | path at which 63 % of it is lost | mm | 1 % to 200 % of the longest path |
//! | `E_c` | energy at which 63 % of it is lost | N mm (heat: mm^2/s) | 1 % to 200 % of the most energy |
//!
//! The energy is the integral of `|F v|` with the force of the base model alone, or what stays of it in the device,
//! or the heat of a dashpot, in proportion to the integral of `v^2`.
//! Reference: Baber and Wen, J. Eng. Mech. Div. 107 (1981) 1069.
//! Known limit: over a few equal cycles it cannot be told from thermal softening.

use super::operators::integral;
use super::work::Work;
use super::{About, Effect, Factors, Scene, Sizes, order_within, within};
use crate::parameter::Parameter;

/// Name and equation of a law on the stiffness and on the whole force.
macro_rules! both {
    ($stiffness:literal, $whole:literal, $share:literal, $of:literal) => {
        [
            ($stiffness, concat!("k -> k (", $share, "), ", $of)),
            ($whole, concat!("F -> F (", $share, "), ", $of)),
        ]
    };
}

/// What degradation follows.
#[derive(Debug, Clone, Copy)]
pub(super) enum Progress {
    /// The path travelled.
    Path,
    /// The energy put in.
    Energy(Work),
}

/// A law of degradation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Degradation {
    /// What it follows.
    pub(super) by: Progress,
    /// True where it saturates.
    pub(super) saturates: bool,
    /// True where damping degrades like stiffness.
    pub(super) whole: bool,
}

impl Degradation {
    /// Progress since the first sample.
    fn progress(self, scene: &Scene) -> Vec<f64> {
        match self.by {
            Progress::Path => integral(scene, |i| scene.velocity[i].abs()),
            Progress::Energy(work) => {
                let power = work.power(scene);
                let energy = integral(scene, |i| power[i]);
                scene.trace(0.0, |most, i| energy[i].max(most))
            }
        }
    }

    /// Largest progress over the campaign.
    fn most(self, sizes: &Sizes) -> f64 {
        match self.by {
            Progress::Path => sizes.path,
            Progress::Energy(work) => work.most(sizes),
        }
    }

    /// Name and equation on the stiffness and on the whole force.
    fn words(self) -> [(&'static str, &'static str); 2] {
        match (self.by, self.saturates) {
            (Progress::Path, false) => {
                both!("path, stiffness", "path, whole force", "1 - s P/P_max", "P the path travelled")
            }
            (Progress::Path, true) => both!(
                "path, saturating, stiffness",
                "path, saturating, whole force",
                "1 - s (1 - exp(-P/P_c))",
                "P the path travelled"
            ),
            (Progress::Energy(Work::Passed), false) => {
                both!("energy, stiffness", "energy, whole force", "1 - s E/E_max", "E the integral of |F v|")
            }
            (Progress::Energy(Work::Passed), true) => both!(
                "energy, saturating, stiffness",
                "energy, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the integral of |F v|"
            ),
            (Progress::Energy(Work::Net), false) => both!(
                "dissipated energy, stiffness",
                "dissipated energy, whole force",
                "1 - s E/E_max",
                "E the largest integral of F v so far"
            ),
            (Progress::Energy(Work::Net), true) => both!(
                "dissipated energy, saturating, stiffness",
                "dissipated energy, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the largest integral of F v so far"
            ),
            (Progress::Energy(Work::Viscous), false) => both!(
                "viscous heat, stiffness",
                "viscous heat, whole force",
                "1 - s E/E_max",
                "E the integral of v^2"
            ),
            (Progress::Energy(Work::Viscous), true) => both!(
                "viscous heat, saturating, stiffness",
                "viscous heat, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the integral of v^2"
            ),
        }
    }
}

impl Effect for Degradation {
    fn about(&self) -> About {
        let (law, equation) = self.words()[usize::from(self.whole)];
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
            let (name, unit) = match self.by {
                Progress::Path => ("P_c", "mm"),
                Progress::Energy(Work::Viscous) => ("E_c", "mm^2/s"),
                Progress::Energy(_) => ("E_c", "N mm"),
            };
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
        let mut progress = self.progress(scene);
        let most = self.most(scene.sizes);
        for p in &mut progress {
            *p = if self.saturates { -(-*p / shape[1]).exp_m1() } else { *p / most };
        }
        Some(Factors::losing(shape[0], &progress, self.whole))
    }
}
