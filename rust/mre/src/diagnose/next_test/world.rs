//! The recordings with one more that has not been made yet.

use std::sync::Arc;

use rayon::prelude::*;

use super::excitation::Signal;
use crate::assembly::{Assembly, Base, Campaign, Doubts, OnAnother};
use crate::diagnose::candidates::Candidate;
use crate::kernel::state_change::StateChange;
use crate::recording::{Condition, Recording, Series, mean};

/// Models that are simulated side by side: more would take much memory.
pub(super) const TOGETHER: usize = 16;

/// A campaign with a recording of an imagined test at its end, and the base on it.
pub(super) struct World {
    campaign: Campaign,
    base: Base,
}

impl World {
    /// The test with a velocity in mm/s where one would be recorded, and a force in N. `None` where the base cannot be
    /// simulated on the excitation.
    pub(super) fn new(
        known: &Campaign,
        base: &Base,
        signal: &Signal,
        velocity: Option<Vec<f64>>,
        force: Option<Vec<f64>>,
    ) -> Option<Self> {
        let like = &known.recordings()[0];
        let current = match (&signal.current, like.current()) {
            (Some(steps), _) => Condition::Series(steps.clone()),
            (None, Condition::Series(_)) => Condition::Constant(like.current().level().unwrap_or(0.0)),
            (None, level) => level.clone(),
        };
        let probe = Recording::new(Series {
            time: signal.time.clone(),
            displacement: signal.displacement.clone(),
            velocity,
            force: Some(force.unwrap_or_else(|| elastic(known, signal))),
            simulated: None,
            current,
            temperature: one_temperature(like),
            name: String::new(),
        })
        .ok()?
        // A long way between two samples asks for no more work so, and has no error of sub-steps.
        .with_state_changed(Some(StateChange::default()));
        let mut recordings = known.recordings().to_vec();
        // On the specimen of all others, where they are of one: the last knows what was before.
        let one_specimen = recordings.iter().all(|recording| recording.past().is_some());
        let last = recordings.last().map(AsRef::as_ref);
        let probe = if one_specimen { probe.after(last).ok()? } else { probe };
        recordings.push(Arc::new(probe));
        if matches!(base, Base::Given(_)) {
            return None;
        }
        let mut members = base.members();
        if let Some(first) = members.iter_mut().find(|m| m.contains(&0)) {
            first.push(recordings.len() - 1);
        }
        let base = base.again(&recordings, &members).ok()?;
        // Steps of the current where it was constant would ask for another law of the base.
        if signal.current.is_some() && !known.sizes().current_varies {
            return None;
        }
        // What noise of known motions does is no part of what a test shows.
        let quiet = |Doubts { left_out, noisy, cornered, .. }: &Doubts| Doubts {
            left_out: left_out.clone(),
            noisy: noisy.clone(),
            cornered: *cornered,
            left: None,
            left_of_current: None,
        };
        let doubts = known.doubts().iter().map(quiet).chain([Doubts::default()]).collect();
        let campaign = Campaign::with_sizes(recordings, known.sizes().clone()).doubting(doubts);
        Some(Self { campaign, base })
    }

    /// The imagined test.
    pub(super) fn test(&self) -> &Recording {
        &self.campaign.recordings()[self.last()]
    }

    /// Its place.
    pub(super) fn last(&self) -> usize {
        self.campaign.recordings().len() - 1
    }

    pub(super) fn campaign(&self) -> &Campaign {
        &self.campaign
    }

    /// A model of the known recordings on these.
    pub(super) fn assembly<'w>(&'w self, of: &Candidate) -> Assembly<'w> {
        self.assemblies(&[of]).remove(0)
    }

    /// Several of them, which is cheaper than one by one.
    pub(super) fn assemblies<'w>(&'w self, of: &[&Candidate]) -> Vec<Assembly<'w>> {
        self.on_these(of).into_iter().map(|(model, _)| model.assembly).collect()
    }

    /// Forces in N of models on the imagined test; `None` where one is not finite.
    pub(super) fn simulated(&self, of: &[&Candidate]) -> Option<Vec<Vec<f64>>> {
        let some = |some: &[&Candidate]| {
            let models = self.on_these(some).into_par_iter();
            models.map(|(model, coefficients)| model.measured(&coefficients)).collect::<Vec<_>>()
        };
        let forces: Vec<Vec<f64>> = of.chunks(TOGETHER).flat_map(some).collect();
        forces.iter().flatten().all(|f| f.is_finite()).then_some(forces)
    }

    fn on_these<'w>(&'w self, of: &[&Candidate]) -> Vec<(OnAnother<'w>, Vec<f64>)> {
        let widened: Vec<Vec<f64>> = of.iter().map(|of| widened(of)).collect();
        let models: Vec<(&Assembly, &[f64], &[f64])> = of
            .iter()
            .zip(&widened)
            .map(|(of, coefficients)| (&of.assembly, of.fitted.unit.as_slice(), coefficients.as_slice()))
            .collect();
        OnAnother::all(&models, (&self.campaign, &self.base)).into_iter().zip(widened).collect()
    }
}

/// A test is made at one temperature.
fn one_temperature(like: &Recording) -> Condition {
    let known = like.temperature().sampled(like.len());
    known.map_or(Condition::Missing, |series| Condition::Constant(mean(&series)))
}

/// A force of the right size, until there is a better one.
fn elastic(known: &Campaign, signal: &Signal) -> Vec<f64> {
    let sizes = known.sizes();
    signal.displacement.iter().map(|x| sizes.force / sizes.displacement * x).collect()
}

/// Where the coefficients of a model stand when the measurement of one more recording has its own, and how many there
/// are then.
pub(super) fn moved(of: &Assembly) -> (Vec<usize>, usize) {
    let recordings = of.campaign().recordings().len();
    let mut places: Vec<usize> = (0..of.base_coefficients()).collect();
    let mut next = places.len();
    for effect in of.effects() {
        let width = effect.coefficients().len();
        let (known, all) = if effect.of_the_measurement() { (recordings, recordings + 1) } else { (1, 1) };
        places.extend(next..next + known * width);
        next += all * width;
    }
    (places, next)
}

/// Coefficients with zeros for what the measurement of one more recording adds.
pub(super) fn widened(of: &Candidate) -> Vec<f64> {
    let (places, count) = moved(&of.assembly);
    let mut found = vec![0.0; count];
    for (place, value) in places.into_iter().zip(&of.fitted.coefficients) {
        found[place] = *value;
    }
    found
}
