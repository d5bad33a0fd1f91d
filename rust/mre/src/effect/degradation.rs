//! Cyclic degradation: the stiffness falls with the path travelled or the energy put in and does not come back; on one
//! specimen it goes on from one recording to the next.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the longest path or the most energy (linear, logarithmic, power), or in the end (saturating, hyperbolic) | - | 0 to 0.95 |
//! | `P_c` | path at which 63 % of it is lost (hyperbolic: half; logarithmic: from which it slows down) | mm | 1 % (0.1 %) to 200 % of the longest path |
//! | q | power | - | 0.2 to 3 |
//! | `E_c` | energy at which 63 % of it is lost (hyperbolic: half) | N mm (heat: mm^2/s, strokes: mm^2) | 1 % to 200 % of the most energy |
//!
//! The energy is the integral of `|F v|` with the force of the base model alone, or what stays of it in the device,
//! or the heat of a dashpot, in proportion to the integral of `v^2`, or the strokes, each by its square.
//! Reference: Baber and Wen, J. Eng. Mech. Div. 107 (1981) 1069.
//! Known limit: over a few equal cycles it cannot be told from thermal softening.

use super::operators::{each, integral};
use super::work::Work;
use super::{About, Effect, Factors, Scene, Sizes, ideal_above, order_within, within};
use crate::parameter::Parameter;
use crate::recording::Past;

/// Names and equations by [`Form`], each on the stiffness and on the whole force.
macro_rules! forms {
    ($name:literal, $p:literal, $of:literal) => {
        [
            forms!(@ $name, concat!("1 - s ", $p, "/", $p, "_max"), $p, $of),
            forms!(@ concat!($name, ", saturating"), concat!("1 - s (1 - exp(-", $p, "/", $p, "_c))"), $p, $of),
            forms!(@ concat!($name, ", logarithmic"), concat!("1 - s ln(1 + ", $p, "/", $p, "_c)/ln(1 + ", $p, "_max/", $p, "_c)"), $p, $of),
            forms!(@ concat!($name, ", power"), concat!("1 - s (", $p, "/", $p, "_max)^q"), $p, $of),
            forms!(@ concat!($name, ", hyperbolic"), concat!("1 - s ", $p, "/(", $p, "_c + ", $p, ")"), $p, $of),
        ]
    };
    (@ $law:expr, $share:expr, $p:literal, $of:literal) => {
        [
            (concat!($law, ", stiffness"), concat!("k -> k (", $share, "), ", $p, " ", $of)),
            (concat!($law, ", whole force"), concat!("F -> F (", $share, "), ", $p, " ", $of)),
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
    /// Ever more slowly, without an end.
    Logarithmic,
    /// By a power.
    Power,
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
    /// Progress in the life of the specimen.
    fn progress(self, scene: &Scene) -> Vec<f64> {
        let mut progress = match self.by {
            Progress::Path => integral(scene, |i| scene.velocity[i].abs()),
            Progress::Strokes => integral(scene, |i| (scene.displacement[i] * scene.velocity[i]).abs()),
            Progress::Energy(work) => {
                let power = work.power(scene);
                integral(scene, |i| power[i])
            }
        };
        let (before, mut most) = self.before(scene.past);
        for p in &mut progress {
            most = most.max(before + *p);
            *p = most;
        }
        progress
    }

    /// Before a recording, and the most so far.
    fn before(self, past: Past) -> (f64, f64) {
        let grown = match self.by {
            Progress::Energy(Work::Net) => return (past.stayed, past.dissipated),
            Progress::Energy(Work::Passed) => past.energy,
            Progress::Energy(Work::Viscous) => past.heat,
            Progress::Path => past.path,
            Progress::Strokes => past.strokes,
        };
        (grown, grown)
    }

    /// Largest progress in the life of a specimen.
    fn most(self, sizes: &Sizes) -> f64 {
        sizes.life
            * match self.by {
                Progress::Path => sizes.path,
                // Of strokes that are all as large as the largest.
                Progress::Strokes => 0.5 * sizes.path * sizes.displacement,
                Progress::Energy(work) => work.most(sizes),
            }
    }

    /// Name and equation.
    fn words(self) -> (&'static str, &'static str) {
        let by_form = match self.by {
            Progress::Path => forms!("path", "P", "the path travelled"),
            Progress::Strokes => forms!("strokes", "E", "the integral of |x v|"),
            Progress::Energy(Work::Passed) => forms!("energy", "E", "the integral of |F v|"),
            Progress::Energy(Work::Net) => {
                forms!("dissipated energy", "E", "the largest integral of F v so far")
            }
            Progress::Energy(Work::Viscous) => forms!("viscous heat", "E", "the integral of v^2"),
        };
        by_form[self.form as usize][usize::from(self.whole)]
    }
}

impl Effect for Degradation {
    fn about(&self) -> About {
        let (law, equation) = self.words();
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
        if self.form == Form::Power {
            shape.push(within("q", "", 0.2, 3.0));
        } else if self.form != Form::Steady {
            let (name, unit) = match self.by {
                Progress::Path => ("P_c", "mm"),
                Progress::Energy(Work::Viscous) => ("E_c", "mm^2/s"),
                Progress::Strokes => ("E_c", "mm^2"),
                Progress::Energy(_) => ("E_c", "N mm"),
            };
            let most = self.most(sizes);
            let least = if self.form == Form::Logarithmic { 0.001 } else { 0.01 };
            shape.push(ideal_above(order_within(name, unit, least * most, 2.0 * most)));
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        match self.form {
            Form::Steady => vec![vec![0.2]],
            Form::Power => vec![vec![0.2, 0.4], vec![0.2, 1.6]],
            Form::Saturating | Form::Hyperbolic | Form::Logarithmic => {
                [0.03, 0.12, 0.5].iter().map(|share| vec![0.2, share * self.most(sizes)]).collect()
            }
        }
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let (progress, most) = (self.progress(scene), self.most(scene.sizes));
        let lost = match self.form {
            Form::Steady => each(&progress, |p| p / most),
            Form::Saturating => each(&progress, |p| -(-p / shape[1]).exp_m1()),
            Form::Logarithmic => {
                let all = (most / shape[1]).ln_1p();
                each(&progress, |p| (p / shape[1]).ln_1p() / all)
            }
            Form::Power => each(&progress, |p| (p / most).powf(shape[1])),
            Form::Hyperbolic => each(&progress, |p| p / (shape[1] + p)),
        };
        Some(Factors::losing(shape[0], &lost, self.whole))
    }
}
