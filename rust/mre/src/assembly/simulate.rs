//! Simulation with effects: the force, without drift, interference and clipping.

use std::sync::Arc;

use super::base_columns::left_by;
use super::campaign::Campaign;
use super::in_series::InSeries;
use crate::device::Device;
use crate::effect::{Effect, Factors, Flexibility, Scene, Sizes};
use crate::error::{Error, Result};
use crate::kernel::filter::dot;
use crate::physics::Part;
use crate::recording::{Condition, Recording};

/// Passes until the force agrees with what effects saw of it.
pub(super) const PASSES: usize = 40;
/// Share of a force, rms, by which two that agree differ.
const AGREED: f64 = 1e-9;
/// The same for a force that is near enough after all passes: dry friction never quite settles where it turns.
const ENOUGH: f64 = 0.02;

/// An effect with its parameters.
#[derive(Clone)]
pub struct Addition {
    /// The law.
    pub effect: &'static dyn Effect,
    /// Coefficients of its columns; empty for one of the measurement.
    pub coefficients: Vec<f64>,
    /// Nonlinear parameters.
    pub shape: Vec<f64>,
}

/// What effects act on.
#[derive(Debug, Clone, Copy)]
pub enum Source<'a> {
    /// A device with parameters.
    Device(&'a Device),
    /// The force that a recording has from a user's own simulation.
    Simulated,
}

impl Source<'_> {
    fn force(self, recording: &Recording) -> Result<Vec<f64>> {
        match self {
            Self::Device(device) => device.simulate(recording),
            Self::Simulated => recording.simulated().map(<[f64]>::to_vec).ok_or_else(|| {
                let text = "there is no simulated force, wanted a column simulated_force_N".into();
                Error::Recording(text).in_recording(recording.name())
            }),
        }
    }

    /// By part; a simulated one is all stiffness, as in a diagnosis beside it.
    fn parts(self, seen: &Recording) -> Result<Vec<(Part, Vec<f64>)>> {
        match self {
            Self::Device(device) => device.parts(seen),
            Self::Simulated => Ok(vec![(Part::Stiffness, self.force(seen)?)]),
        }
    }
}

impl std::fmt::Debug for Addition {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {:?} {:?}", self.effect.about().law, self.coefficients, self.shape)
    }
}

/// Restoring force in N of a device, or a simulated one, with effects at every sample of a recording.
///
/// `sizes` are those of the recordings that the effects were fitted to.
///
/// # Errors
/// As [`Device::simulate`]; no simulated force; a force that is not finite.
pub fn simulate(
    source: Source,
    additions: &[Addition],
    sizes: &Sizes,
    recording: &Arc<Recording>,
) -> Result<Vec<f64>> {
    let alone = source.force(recording)?;
    if additions.is_empty() {
        return Ok(alone);
    }
    temperature_known(additions.iter().map(|added| added.effect), recording)?;
    let campaign = Campaign::with_sizes(vec![recording.clone()], sizes.clone());
    let flexibility =
        additions.iter().filter_map(|a| a.effect.flexibility(&a.shape)).reduce(Flexibility::and);
    let pass = |known: &[f64]| pass(source, additions, recording, &campaign.scene(0, &alone, known));
    let mut force = pass(&alone)?;
    if let Some(flexibility) = flexibility {
        let mut known = InSeries::first(recording, &alone, flexibility);
        force = pass(&known)?;
        // A stop is far stiffer than the device is on average: whole steps would go to and fro.
        let (mut step, mut last) = (1.0, f64::INFINITY);
        for _ in 0..PASSES {
            let better = InSeries::new(recording, &known, &force, flexibility).nearer(&known, &force);
            let apart = distance(&known, &better);
            if apart <= AGREED {
                break;
            }
            step = if apart > last { 0.5 * step } else { step };
            last = apart;
            known.iter_mut().zip(better).for_each(|(known, better)| *known += step * (better - *known));
            force = pass(&known)?;
        }
        let left = distance(&known, &force);
        if left > ENOUGH {
            let text = format!(
                "the force and the motion that it leaves the device do not agree, to {left:.1e} of it"
            );
            return Err(Error::Recording(text).in_recording(recording.name()));
        }
    }
    match force.iter().position(|f| !f.is_finite()) {
        None => Ok(force),
        Some(i) => {
            let text = format!("the force with effects is not finite at {} s", recording.time()[i]);
            Err(Error::Recording(text).in_recording(recording.name()))
        }
    }
}

/// Refuse a recording without temperature where an effect follows it.
///
/// # Errors
/// There is such an effect, and no temperature.
pub fn temperature_known(
    mut effects: impl Iterator<Item = &'static dyn Effect>,
    recording: &Recording,
) -> Result<()> {
    match (effects.find(|effect| effect.feels_temperature()), recording.temperature()) {
        (Some(effect), Condition::Missing) => {
            let effect = effect.about().effect;
            let text =
                format!("{effect} follows the temperature, and there is none: set temperature=VALUE[degC]");
            Err(Error::Recording(text).in_recording(recording.name()))
        }
        _ => Ok(()),
    }
}

/// The force where the effects see a scene.
fn pass(source: Source, additions: &[Addition], recording: &Recording, scene: &Scene) -> Result<Vec<f64>> {
    let mut seen = recording.clone();
    let mut factors: Vec<Factors> = Vec::new();
    for Addition { effect, shape, .. } in additions {
        let mut own = *scene;
        (own.displacement, own.velocity) = (seen.displacement(), seen.velocity());
        let (motion, current) = (effect.motion(&own, shape), effect.current(&own, shape));
        factors.extend(effect.factors(scene, shape));
        if motion.is_some() || current.is_some() {
            let (x, v) = motion.map_or_else(
                || (own.displacement.to_vec(), own.velocity.to_vec()),
                |m| (m.displacement, m.velocity),
            );
            seen = seen.seen_with(x, v, current);
        }
        seen = seen.with_state_changed(effect.state_change(scene.sizes, shape));
    }
    let mut force = vec![0.0; recording.len()];
    for (part, column) in source.parts(&seen)? {
        for (i, value) in column.into_iter().enumerate() {
            let share: f64 = factors.iter().map(|f| factor(f, part, i)).product();
            force[i] += share * value;
        }
    }
    let moving = additions.iter().filter(|added| added.effect.moves_the_device());
    let device = left_by(scene, moving.map(|added| (added.effect, added.shape.as_slice())));
    let moved = device.as_ref().map_or(*scene, |device| scene.moved(device));
    for Addition { effect, coefficients, shape } in additions {
        if !effect.of_the_measurement() {
            for (c, column) in coefficients.iter().zip(effect.columns(&moved, shape)) {
                for (f, value) in force.iter_mut().zip(column) {
                    *f += c * value;
                }
            }
        }
    }
    for Addition { effect, shape, .. } in additions {
        force = effect.through(scene, shape, &force).unwrap_or(force);
    }
    Ok(force)
}

/// Difference of two forces as a share of the second, rms.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    let apart: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    (apart / dot(b, b).max(f64::MIN_POSITIVE)).sqrt()
}

fn factor(factors: &Factors, part: Part, i: usize) -> f64 {
    factors.on(part).map_or(1.0, |own| own[i])
}
