//! Thermal softening: the device is softer the warmer its own dissipation makes it, and recovers as it cools.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | share that is lost at the reference temperature | - | 0 to 3 |
//! | tau | time over which the device cools | s | 1 to 3000 |
//!
//! The reference is the temperature at the end of the longest recording under a constant power with the most
//! energy of a recording. The heat is `|F v|` or `F v` of the base model alone, or proportional to `v^2`.
//! A factor never falls below 0.05.
//! Reference: Kalpakidis and Constantinou, J. Struct. Eng. 135 (2009) 1394.
//! Known limit: where the recordings are short against tau it is cyclic degradation by energy.

use super::operators::lag;
use super::work::Work;
use super::{About, Effect, Factors, Scene, Sizes, ideal_above, order_within, orders, within};
use crate::parameter::Parameter;

/// Range of the time over which a device cools, s.
const COOLING: (f64, f64) = (1.0, 3000.0);

/// A law of thermal softening.
#[derive(Debug, Clone, Copy)]
pub(super) struct Thermal {
    /// What heats.
    pub(super) by: Work,
    /// True for an exponential law, false for a linear one.
    pub(super) exponential: bool,
    /// True where damping softens like stiffness.
    pub(super) whole: bool,
}

impl Thermal {
    /// Excess temperature over its reference.
    fn temperature(self, scene: &Scene, tau: f64) -> Vec<f64> {
        let sizes = scene.sizes;
        let (power, most) = (self.by.power(scene), self.by.most(sizes));
        // The lag is T / tau; a constant power makes it grow to the share below.
        let share = -(-sizes.duration / tau).exp_m1();
        let reference = most / sizes.duration * share;
        let mut state = lag(scene.time, &power, tau, 0.0);
        for t in &mut state {
            *t = (*t / reference).max(0.0);
        }
        state
    }
}

impl Effect for Thermal {
    fn about(&self) -> About {
        let law = match (self.by, self.exponential) {
            (Work::Passed, false) => ["linear, stiffness", "linear, whole force"],
            (Work::Passed, true) => ["exponential, stiffness", "exponential, whole force"],
            (Work::Net, false) => ["dissipated power, stiffness", "dissipated power, whole force"],
            (Work::Net, true) => {
                ["dissipated power, exponential, stiffness", "dissipated power, exponential, whole force"]
            }
            (Work::Viscous, false) => ["viscous heat, stiffness", "viscous heat, whole force"],
            (Work::Viscous, true) => {
                ["viscous heat, exponential, stiffness", "viscous heat, exponential, whole force"]
            }
        };
        About {
            effect: "thermal_softening",
            law: law[usize::from(self.whole)],
            plain: "the device warms up as it dissipates, softens, and recovers as it cools",
            equation: match (self.by, self.exponential) {
                (Work::Passed, false) => "k -> k (1 - s T/T_r), dT/dt = |F v| - T/tau",
                (Work::Passed, true) => "k -> k exp(-s T/T_r), dT/dt = |F v| - T/tau",
                (Work::Net, false) => "k -> k (1 - s T/T_r), dT/dt = F v - T/tau",
                (Work::Net, true) => "k -> k exp(-s T/T_r), dT/dt = F v - T/tau",
                (Work::Viscous, false) => "k -> k (1 - s T/T_r), dT/dt = v^2 - T/tau",
                (Work::Viscous, true) => "k -> k exp(-s T/T_r), dT/dt = v^2 - T/tau",
            },
            reference: "Kalpakidis and Constantinou 2009",
            limit: "where recordings are short against tau it is cyclic degradation by energy",
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        vec![within("s", "", 0.0, 3.0), ideal_above(order_within("tau", "s", COOLING.0, COOLING.1))]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let shortest = (0.1 * sizes.duration).clamp(COOLING.0, 0.1 * COOLING.1);
        let longest = (3.0 * sizes.duration).clamp(3.0 * shortest, COOLING.1);
        orders(shortest, longest, 4).into_iter().map(|tau| vec![0.2, tau]).collect()
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let temperature = self.temperature(scene, shape[1]);
        Some(if self.exponential {
            let kept = temperature.iter().map(|t| (-shape[0] * t).exp()).collect();
            Factors::kept(kept, self.whole)
        } else {
            Factors::losing(shape[0], &temperature, self.whole)
        })
    }
}
