//! Thermal softening in recordings too short for the heat to leave: a law of degradation by energy under the other
//! name, because recordings of a minute cannot tell which it is, and heat takes minutes to hours to leave.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the most energy | - | 0 to 0.95 |
//!
//! Reference: Kalpakidis and Constantinou, J. Struct. Eng. 135 (2009) 1394.
//! Known limit: it is cyclic degradation by energy; a rest, or a longer test, would tell.

use super::degradation::{Degradation, Progress};
use super::{About, Effect, Factors, Scene, Sizes};
use crate::parameter::Parameter;

/// Softening in proportion to the heat of a recording.
#[derive(Debug, Clone, Copy)]
pub(super) struct Adiabatic {
    /// True where the heat is that of a dashpot, not of the whole force.
    pub(super) viscous: bool,
    /// True where damping softens like stiffness.
    pub(super) whole: bool,
}

impl Adiabatic {
    /// Degradation by the same energy.
    fn law(self) -> Degradation {
        let by = if self.viscous { Progress::Heat } else { Progress::Work };
        Degradation { by, saturates: false, whole: self.whole }
    }
}

impl Effect for Adiabatic {
    fn about(&self) -> About {
        About {
            effect: "thermal_softening",
            law: match (self.viscous, self.whole) {
                (false, false) => "no cooling, stiffness",
                (false, true) => "no cooling, whole force",
                (true, false) => "viscous heat, no cooling, stiffness",
                (true, true) => "viscous heat, no cooling, whole force",
            },
            plain: "the device warms up as it dissipates, softens, and has no time to cool",
            equation: if self.viscous {
                "k -> k (1 - s T/T_max), dT/dt = v^2"
            } else {
                "k -> k (1 - s T/T_max), dT/dt = |F v|"
            },
            reference: "Kalpakidis and Constantinou 2009",
            limit: "it is cyclic degradation by energy; a rest or a longer test would tell",
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        self.law().shape(sizes)
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law().starts(sizes)
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        self.law().factors(scene, shape)
    }
}
