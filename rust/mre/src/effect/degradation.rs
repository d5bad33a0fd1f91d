//! Cyclic degradation: the stiffness falls with the path travelled or the energy put in and does not come back.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the longest path or the most energy (linear), or in the end (saturating, hyperbolic) | - | 0 to 0.95 |
//! | `P_c` | path at which 63 % of it is lost (hyperbolic: half) | mm | 1 % to 200 % of the longest path |
//! | `E_c` | energy at which 63 % of it is lost (hyperbolic: half) | N mm (heat: mm^2/s, strokes: mm^2) | 1 % to 200 % of the most energy |
//!
//! The energy is the integral of `|F v|` with the force of the base model alone, or what stays of it in the device,
//! or the heat of a dashpot, in proportion to the integral of `v^2`, or the strokes, each by its square.
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
    /// The strokes, each by its square.
    Strokes,
    /// The energy put in.
    Energy(Work),
}

/// How the share that is lost follows the progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// In proportion.
    Steady,
    /// Exponentially to an end.
    Saturating,
    /// As a stiffness over `1 + E/E_c` falls.
    Hyperbolic,
}

/// A law of degradation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Degradation {
    /// What it follows.
    pub(super) by: Progress,
    /// How.
    pub(super) form: Form,
    /// True where damping degrades like stiffness.
    pub(super) whole: bool,
}

impl Degradation {
    /// Progress since the first sample.
    fn progress(self, scene: &Scene) -> Vec<f64> {
        match self.by {
            Progress::Path => integral(scene, |i| scene.velocity[i].abs()),
            Progress::Strokes => integral(scene, |i| (scene.displacement[i] * scene.velocity[i]).abs()),
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
            // Of strokes that are all as large as the largest.
            Progress::Strokes => 0.5 * sizes.path * sizes.displacement,
            Progress::Energy(work) => work.most(sizes),
        }
    }

    /// Name and equation on the stiffness and on the whole force.
    fn words(self) -> [(&'static str, &'static str); 2] {
        match (self.by, self.form) {
            (Progress::Path, Form::Steady) => {
                both!("path, stiffness", "path, whole force", "1 - s P/P_max", "P the path travelled")
            }
            (Progress::Path, Form::Saturating) => both!(
                "path, saturating, stiffness",
                "path, saturating, whole force",
                "1 - s (1 - exp(-P/P_c))",
                "P the path travelled"
            ),
            (Progress::Energy(Work::Passed), Form::Steady) => {
                both!("energy, stiffness", "energy, whole force", "1 - s E/E_max", "E the integral of |F v|")
            }
            (Progress::Energy(Work::Passed), Form::Saturating) => both!(
                "energy, saturating, stiffness",
                "energy, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the integral of |F v|"
            ),
            (Progress::Energy(Work::Net), Form::Steady) => both!(
                "dissipated energy, stiffness",
                "dissipated energy, whole force",
                "1 - s E/E_max",
                "E the largest integral of F v so far"
            ),
            (Progress::Energy(Work::Net), Form::Saturating) => both!(
                "dissipated energy, saturating, stiffness",
                "dissipated energy, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the largest integral of F v so far"
            ),
            (Progress::Energy(Work::Viscous), Form::Steady) => both!(
                "viscous heat, stiffness",
                "viscous heat, whole force",
                "1 - s E/E_max",
                "E the integral of v^2"
            ),
            (Progress::Energy(Work::Viscous), Form::Saturating) => both!(
                "viscous heat, saturating, stiffness",
                "viscous heat, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the integral of v^2"
            ),
            (Progress::Strokes, Form::Steady) => both!(
                "strokes, stiffness",
                "strokes, whole force",
                "1 - s E/E_max",
                "E the integral of |x v|"
            ),
            (Progress::Strokes, Form::Saturating) => both!(
                "strokes, saturating, stiffness",
                "strokes, saturating, whole force",
                "1 - s (1 - exp(-E/E_c))",
                "E the integral of |x v|"
            ),
            (Progress::Strokes, Form::Hyperbolic) => both!(
                "strokes, hyperbolic, stiffness",
                "strokes, hyperbolic, whole force",
                "1 - s E/(E_c + E)",
                "E the integral of |x v|"
            ),
            (Progress::Path, Form::Hyperbolic) => both!(
                "path, hyperbolic, stiffness",
                "path, hyperbolic, whole force",
                "1 - s P/(P_c + P)",
                "P the path travelled"
            ),
            (Progress::Energy(Work::Passed), Form::Hyperbolic) => both!(
                "energy, hyperbolic, stiffness",
                "energy, hyperbolic, whole force",
                "1 - s E/(E_c + E)",
                "E the integral of |F v|"
            ),
            (Progress::Energy(Work::Net), Form::Hyperbolic) => both!(
                "dissipated energy, hyperbolic, stiffness",
                "dissipated energy, hyperbolic, whole force",
                "1 - s E/(E_c + E)",
                "E the largest integral of F v so far"
            ),
            (Progress::Energy(Work::Viscous), Form::Hyperbolic) => both!(
                "viscous heat, hyperbolic, stiffness",
                "viscous heat, hyperbolic, whole force",
                "1 - s E/(E_c + E)",
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
        if self.form != Form::Steady {
            let (name, unit) = match self.by {
                Progress::Path => ("P_c", "mm"),
                Progress::Energy(Work::Viscous) => ("E_c", "mm^2/s"),
                Progress::Strokes => ("E_c", "mm^2"),
                Progress::Energy(_) => ("E_c", "N mm"),
            };
            let most = self.most(sizes);
            shape.push(order_within(name, unit, 0.01 * most, 2.0 * most));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self.form {
            Form::Steady => vec![vec![0.2]],
            Form::Saturating | Form::Hyperbolic => {
                [0.03, 0.12, 0.5].iter().map(|share| vec![0.2, share * self.most(sizes)]).collect()
            }
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let mut progress = self.progress(scene);
        let most = self.most(scene.sizes);
        for p in &mut progress {
            *p = match self.form {
                Form::Steady => *p / most,
                Form::Saturating => -(-*p / shape[1]).exp_m1(),
                Form::Hyperbolic => *p / (shape[1] + *p),
            };
        }
        Some(Factors::losing(shape[0], &progress, self.whole))
    }
}
