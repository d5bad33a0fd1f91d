//! The catalogue of effects that a base model may have left out: one file an effect, one line in
//! [`CATALOGUE`].
//!
//! An effect has one or more laws (textbook forms of the same physics). A law acts in one place: it adds
//! columns to the force, scales the terms of the base model by a state of the history, changes what
//! the base model sees (motion, current) or the law of its hysteretic state, or changes what is measured. Everything else (simulation, joint
//! fits, diagnosis) follows from that.

mod adiabatic;
mod asymmetric;
mod backlash;
mod before;
mod bent_branch;
mod bristles;
mod catalogue;
mod clipping;
mod coulomb;
mod creep;
mod cubic;
mod current_wander;
mod degradation;
mod delay;
mod drift;
mod end_stop;
mod factors;
mod field_dependence;
mod field_lag;
mod field_yield;
mod filter_lag;
mod flexibility;
mod fractional;
mod hysteresis;
mod inertia;
mod initial_hysteresis;
mod initial_state;
mod loose_spring;
mod mains;
mod maxwell;
mod mullins;
mod on_part;
mod operators;
mod own_share;
mod parameter_off;
mod payne;
mod pinched;
mod pinching;
mod quadratic_damping;
mod quantisation;
mod recorded_temperature;
mod remanence;
mod rig;
mod scene;
mod slipping;
mod smooth_lag;
mod spread_yields;
mod stiffness_jump;
mod stribeck;
#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
mod tests;
mod thermal;
mod wearing;
mod with_current;
mod work;

pub use crate::kernel::state_change::{Pace, Slip, StateChange, Wear};
pub use catalogue::{CATALOGUE, named};
pub use current_wander::{CurrentWander, current_wanders};
pub(crate) use drift::{DRIFT, MEAN};
pub use factors::{Factors, Stored};
pub use flexibility::Flexibility;
pub use initial_hysteresis::InitialHysteresis;
pub(crate) use initial_hysteresis::STARTS;
pub use initial_state::{InitialState, starts_in_motion};
pub(crate) use mains::{sampled, told};
pub use parameter_off::ParameterOff;
pub use quantisation::Quantisation;
pub use scene::{Acceleration, Scene, Sizes};

use std::ops::RangeInclusive;

use crate::parameter::{Ideal, Parameter, Scale};

/// What is known about a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// Id of the effect, as in `diagnosis.json`.
    pub effect: &'static str,
    /// Name of the law among those of the effect.
    pub law: &'static str,
    /// What was left out, as the start of a sentence.
    pub plain: &'static str,
    /// Equation.
    pub equation: &'static str,
    /// Where the equation is from.
    pub reference: &'static str,
    /// When it cannot be told from the base model or from other effects.
    pub limit: &'static str,
}

/// Displacement in mm and velocity in mm/s that the base model sees.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// mm.
    pub displacement: Vec<f64>,
    /// mm/s.
    pub velocity: Vec<f64>,
}

/// One law of an effect.
///
/// Every hook has a default that leaves things as they are; a law overrides one.
pub trait Effect: Send + Sync {
    /// Names, equation, reference.
    fn about(&self) -> About;

    /// False where recordings of these sizes cannot hold the effect at all (no current, say).
    fn applies(&self, sizes: &Sizes) -> bool {
        let _ = sizes;
        true
    }

    /// True where it cannot be simulated without a recorded temperature.
    fn feels_temperature(&self) -> bool {
        false
    }

    /// Linear coefficients, one for each of [`Effect::columns`]; only `smallest` and `largest` are used of
    /// their boxes.
    fn coefficients(&self) -> Vec<Parameter> {
        Vec::new()
    }

    /// Nonlinear parameters with their boxes.
    fn shape(&self, sizes: &Sizes) -> Vec<Parameter>;

    /// Values of the nonlinear parameters from which a fit starts: enough of them that a real effect is
    /// nearly as visible at one of them as at its best.
    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>>;

    /// The parameter without which the law is that of another effect: a coefficient at zero, or a shape at its lower
    /// bound.
    fn own(&self) -> Option<&'static str> {
        None
    }

    /// Columns added to the force, each times its coefficient.
    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let _ = (scene, shape);
        Vec::new()
    }

    /// True where the columns belong to the measurement and not to the device, and have their own
    /// coefficients in every recording.
    fn of_the_measurement(&self) -> bool {
        false
    }

    /// Inverse of the variance that the coefficients are known to have, where their columns may have left no trace
    /// in the samples that count; zero: nothing is known.
    fn known_of_coefficients(&self, sizes: &Sizes) -> f64 {
        let _ = sizes;
        0.0
    }

    /// Half-cosines over a recording, the mean as the 0th, of an effect so slow that slow noise looks like it: in
    /// these it also has to exceed what the noise's spectrum extends to.
    fn slow(&self) -> Option<RangeInclusive<usize>> {
        None
    }

    /// False of what goes on whatever moves: it cannot stand for what is wrong in the form of another effect.
    fn follows_the_motion(&self) -> bool {
        true
    }

    /// True where the law scales only the springs of a hysteretic base model, or only its hysteretic force: beside
    /// another base it is the plain law.
    fn on_a_part(&self) -> bool {
        false
    }

    /// True where the law is what its effect comes to in a steady motion: it has no memory that a run-in would show.
    fn is_of_steady_motion(&self) -> bool {
        false
    }

    /// True where the effect happens at one moment of one recording.
    fn in_one_recording(&self) -> bool {
        false
    }

    /// Where its parameters tell when it happens: from and to, s from the start of the campaign.
    fn moment(&self, shape: &[f64]) -> Option<(f64, f64)> {
        let _ = shape;
        None
    }

    /// What the force of the device with all its effects takes from the motion. A fit is then repeated until that force
    /// agrees with what the effect saw.
    fn flexibility(&self, shape: &[f64]) -> Option<Flexibility> {
        let _ = shape;
        None
    }

    /// Factors on the terms of the base model.
    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let _ = (scene, shape);
        None
    }

    /// True where what the base model sees is the motion of the whole device: other effects add forces in it too.
    fn moves_the_device(&self) -> bool {
        false
    }

    /// Motion that the base model sees.
    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let _ = (scene, shape);
        None
    }

    /// What is changed of the law of the hysteretic state of the base model.
    fn state_change(&self, sizes: &Sizes, shape: &[f64]) -> Option<StateChange> {
        let _ = (sizes, shape);
        None
    }

    /// Current that the base model sees, A.
    fn current(&self, scene: &Scene, shape: &[f64]) -> Option<Vec<f64>> {
        let _ = (scene, shape);
        None
    }

    /// A linear channel through which the force of the device is measured.
    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        let _ = (scene, shape, force);
        None
    }

    /// The same of a force that is also known halfway between the samples, where [`Effect::between_samples`] asks for it.
    fn through_halves(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        let _ = (scene, shape, force);
        None
    }

    /// True where it matters to a channel what a sharply turning force does between the samples.
    fn between_samples(&self) -> bool {
        false
    }

    /// Share of the force of the device that is measured at every sample.
    fn shown(&self, scene: &Scene, shape: &[f64]) -> Option<Vec<f64>> {
        let _ = (scene, shape);
        None
    }

    /// Lowest and highest force that is measured, N.
    fn clip(&self, shape: &[f64]) -> Option<(f64, f64)> {
        let _ = shape;
        None
    }
}

/// A coefficient that may not be negative.
pub(crate) fn positive(name: &str, unit: &'static str) -> Parameter {
    Parameter { smallest: 0.0, ..signed(name, unit) }
}

/// A coefficient of either sign.
pub(crate) fn signed(name: &str, unit: &'static str) -> Parameter {
    Parameter {
        name: name.into(),
        unit,
        smallest: f64::NEG_INFINITY,
        largest: f64::INFINITY,
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
        scale: Scale::Linear,
        ideal: Ideal::default(),
    }
}

/// A shape within a box, spread evenly.
pub(crate) fn within(name: &str, unit: &'static str, lower: f64, upper: f64) -> Parameter {
    let (smallest, largest) = (f64::NEG_INFINITY, f64::INFINITY);
    let (scale, ideal) = (Scale::Linear, Ideal::default());
    Parameter { name: name.into(), unit, smallest, largest, lower, upper, scale, ideal }
}

/// The same, the law being an ideal of its own at the lower bound.
pub(crate) fn ideal_below(p: Parameter) -> Parameter {
    Parameter { ideal: Ideal { lower: true, ..p.ideal }, ..p }
}

/// The same, the law being an ideal of its own at the upper bound.
pub(crate) fn ideal_above(p: Parameter) -> Parameter {
    Parameter { ideal: Ideal { upper: true, ..p.ideal }, ..p }
}

/// A positive shape of unknown order of magnitude within a box.
pub(crate) fn order_within(name: &str, unit: &'static str, lower: f64, upper: f64) -> Parameter {
    Parameter { smallest: 0.0, scale: Scale::Log, ..within(name, unit, lower, upper) }
}

/// `count` values from `low` to `high`, evenly in the logarithm.
pub(crate) fn orders(low: f64, high: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(|i| low * (high / low).powf(i as f64 / last)).collect()
}
