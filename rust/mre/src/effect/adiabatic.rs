//! Thermal softening in recordings too short for the heat to leave: a law of degradation by energy under the other
//! name, because recordings of a minute cannot tell which it is, and heat takes minutes to hours to leave.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the most energy | - | 0 to 0.95 |
//!
//! Reference: Kalpakidis and Constantinou, J. Struct. Eng. 135 (2009) 1394.
//! Known limit: it is cyclic degradation by energy; a rest, or a longer test, would tell.

use super::degradation::{Degradation, Form, Progress};
use super::work::Work;
use super::{About, Effect, Factors, Scene, Sizes};
use crate::parameter::Parameter;
use crate::recording::Past;

/// Softening in proportion to the heat of a recording.
#[derive(Debug, Clone, Copy)]
pub(super) struct Adiabatic {
    /// What heats.
    pub(super) by: Work,
    /// True where damping softens like stiffness.
    pub(super) whole: bool,
}

impl Adiabatic {
    /// Degradation by the same energy.
    fn law(self) -> Degradation {
        Degradation { by: Progress::Energy(self.by), form: Form::Steady, whole: self.whole }
    }
}

/// A device cools between its recordings.
fn of_one_recording(sizes: &Sizes) -> Sizes {
    Sizes { life: 1.0, ..sizes.clone() }
}

impl Effect for Adiabatic {
    fn about(&self) -> About {
        About {
            effect: "thermal_softening",
            law: match (self.by, self.whole) {
                (Work::Passed, false) => "no cooling, stiffness",
                (Work::Passed, true) => "no cooling, whole force",
                (Work::Net, false) => "dissipated power, no cooling, stiffness",
                (Work::Net, true) => "dissipated power, no cooling, whole force",
                (Work::Viscous, false) => "viscous heat, no cooling, stiffness",
                (Work::Viscous, true) => "viscous heat, no cooling, whole force",
            },
            plain: "the device warms up as it dissipates, softens, and has no time to cool",
            equation: match self.by {
                Work::Passed => "k -> k (1 - s T/T_max), dT/dt = |F v|",
                Work::Net => "k -> k (1 - s T/T_max), T the largest integral of F v so far",
                Work::Viscous => "k -> k (1 - s T/T_max), dT/dt = v^2",
            },
            reference: "Kalpakidis and Constantinou 2009",
            limit: "it is cyclic degradation by energy; a rest or a longer test would tell",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        self.law().shape(&of_one_recording(sizes))
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law().starts(&of_one_recording(sizes))
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let sizes = of_one_recording(scene.sizes);
        self.law().factors(&Scene { past: Past::default(), sizes: &sizes, ..*scene }, shape)
    }
}
