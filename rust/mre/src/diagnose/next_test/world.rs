//! The recordings with one more that has not been made yet.

use std::sync::Arc;

use super::excitation::Signal;
use crate::assembly::{Assembly, Base, Campaign, Doubts};
use crate::diagnose::least_squares::Fitted;
use crate::recording::{Condition, Recording, Series};

/// A campaign with a recording of an imagined test at its end, and the base on it.
pub(super) struct World {
    campaign: Campaign,
    base: Base,
}

impl World {
    /// `None` where the base cannot be simulated on the excitation.
    pub(super) fn new(
        known: &Campaign,
        base: &Base,
        signal: &Signal,
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
            velocity: None,
            force: Some(force.unwrap_or_else(|| elastic(known, signal))),
            simulated: None,
            current,
            temperature: like.temperature().clone(),
            name: String::new(),
        })
        .ok()?;
        let mut recordings = known.recordings().to_vec();
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
        let doubts = known.doubts().iter().cloned().chain([Doubts::default()]).collect();
        let campaign = Campaign::with_sizes(recordings, known.sizes().clone()).doubting(doubts);
        Some(Self { campaign, base })
    }

    pub(super) fn campaign(&self) -> &Campaign {
        &self.campaign
    }

    /// A model of the known recordings on these, and its shapes in the unit box.
    pub(super) fn assembly<'w>(&'w self, of: &Assembly, fitted: &Fitted) -> (Assembly<'w>, Vec<f64>) {
        let nothing = self.campaign.recordings().iter().map(|r| vec![0.0; r.len()]).collect();
        let bare = Assembly::new(&self.campaign, &self.base, of.effects().to_vec(), Arc::new(nothing));
        let unit = bare.unit(&of.physical(&fitted.unit));
        let coefficients = widened(of, fitted);
        let force = bare.base_force(&unit, &coefficients);
        (bare.referring_to(force).seeing_its_force(&unit, &coefficients), unit)
    }

    /// Force in N of a model on the imagined test.
    pub(super) fn simulated(&self, of: &Assembly, fitted: &Fitted, passes: usize) -> Option<Vec<f64>> {
        let (mut assembly, unit) = self.assembly(of, fitted);
        let coefficients = widened(of, fitted);
        for _ in 0..passes {
            assembly = assembly.seeing_its_force(&unit, &coefficients);
        }
        let last = self.campaign.recordings().len() - 1;
        let force = assembly.columns(last, &assembly.physical(&unit)).measured(&coefficients);
        force.iter().all(|f| f.is_finite()).then_some(force)
    }
}

/// A force of the right size, until there is a better one.
fn elastic(known: &Campaign, signal: &Signal) -> Vec<f64> {
    let sizes = known.sizes();
    signal.displacement.iter().map(|x| sizes.force / sizes.displacement * x).collect()
}

/// Coefficients with zeros for what the measurement of one more recording adds.
fn widened(of: &Assembly, fitted: &Fitted) -> Vec<f64> {
    let mut rest = fitted.coefficients.iter().copied();
    let mut found: Vec<f64> = rest.by_ref().take(of.base_coefficients()).collect();
    let recordings = of.campaign().recordings().len();
    for effect in of.effects() {
        let width = effect.coefficients().len();
        let own = effect.of_the_measurement();
        found.extend(rest.by_ref().take(if own { recordings * width } else { width }));
        if own {
            found.extend(vec![0.0; width]);
        }
    }
    found
}
