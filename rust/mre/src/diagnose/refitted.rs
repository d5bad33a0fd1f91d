//! What a base whose parameters were kept would leave with fitted ones: wrong parameters look like missing physics.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::alternatives::APART;
use super::diagnosis::{Diagnosis, Judgement};
use super::gaps::LeftOut;
use super::monitor::{Monitor, Stage};
use super::verdict::Verdict;
use crate::assembly::{Assembly, Base, Campaign};
use crate::fit::exact;

/// With fewer samples for each parameter a fit follows the noise.
const EACH: usize = 5;
/// What a fit takes off a mismatch that is not of the parameters: less than this share of its rms is not told.
const TOLD: f64 = 0.05;

/// Rms errors over the samples that count, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refitted {
    /// With the parameters that were kept.
    pub as_given: f64,
    /// With parameters fitted to these recordings.
    pub fitted: f64,
    /// True where these, of one current, leave no more than the effects that were named.
    pub as_well: bool,
}

/// The diagnosis, once the parameters that it has kept were fitted, in `groups` of recordings that share them: where these
/// leave no more, an effect is a hint. It ends soon after `cancel` is set.
#[must_use]
pub fn beside_refitted<'a>(
    found: Diagnosis<'a>,
    groups: &[Vec<usize>],
    cancel: &AtomicBool,
    monitor: &dyn Monitor,
) -> Diagnosis<'a> {
    let refitted = refitted(&found, groups, cancel, monitor);
    let beside = |j: Judgement| Judgement { verdict: j.verdict.beside_refitted(refitted), ..j };
    Diagnosis { judgement: found.judgement.map(beside), refitted, ..found }
}

/// Fit the parameters that a diagnosis has kept by least squares.
///
/// `None` where nothing is missing, where the base is no model without effects whose parameters were kept, where
/// there are too few samples or a fit is hardly better, and where it was broken off. After `cancel` is set, as the
/// monitor's breaking off sets it, it ends soon.
fn refitted(
    found: &Diagnosis,
    groups: &[Vec<usize>],
    cancel: &AtomicBool,
    monitor: &dyn Monitor,
) -> Option<Refitted> {
    found.judgement.filter(|judgement| judgement.verdict != Verdict::Adequate)?;
    let kept = &found.base.assembly;
    let campaign = kept.campaign();
    let base = kept.base().unkept(campaign.recordings(), groups)?;
    let parameters: usize = base.groups().iter().map(|group| group.problem.parameters().len()).sum();
    if counted(campaign).len() < EACH * parameters {
        return None;
    }
    let force = monitor.stage(Stage::Refit, || fitted_force(campaign, &base, cancel))?;
    // Without the initial states that a diagnosis fits beside either: they are no parameters of the model.
    let given = rms(campaign, &kept.base_force(&[], &[]));
    let fitted = rms(campaign, &force);
    let more = (fitted / rms(campaign, &found.final_force)).powi(2) - 1.0;
    // Parameters of each current on their own are another law of the current.
    let as_well = groups.len() == 1 && more * (counted(campaign).len() as f64) < APART;
    let both = Refitted { as_given: given, fitted, as_well };
    (both.fitted < (1.0 - TOLD) * both.as_given).then_some(both)
}

/// Forces in N at the optimum of each group.
fn fitted_force(campaign: &Campaign, base: &Base, cancel: &AtomicBool) -> Vec<Vec<f64>> {
    let (mut shapes, mut coefficients) = (Vec::new(), Vec::new());
    for group in base.groups() {
        let values = exact(&group.problem, cancel).values;
        shapes.extend(group.shapes.iter().map(|i| values[*i]));
        coefficients.extend(group.coefficients.iter().map(|i| values[*i]));
    }
    let nothing = campaign.recordings().iter().map(|r| vec![0.0; r.len()]).collect();
    let assembly = Assembly::new(campaign, base, Vec::new(), Arc::new(nothing));
    assembly.base_force(&assembly.unit(&shapes), &coefficients)
}

/// Recording and place of each sample that counts.
fn counted(campaign: &Campaign) -> Vec<(usize, usize)> {
    let of = |r: usize| {
        let scored = campaign.recordings()[r].scored();
        let telling = LeftOut::of(campaign, r).telling(scored.clone(), 0);
        scored.zip(telling).filter_map(move |(i, telling)| telling.then_some((r, i)))
    };
    (0..campaign.recordings().len()).flat_map(of).collect()
}

fn rms(campaign: &Campaign, forces: &[Vec<f64>]) -> f64 {
    let counted = counted(campaign);
    let square = |(r, i): &(usize, usize)| {
        let measured = campaign.recordings()[*r].force().map_or(0.0, |force| force[*i]);
        (measured - forces[*r][*i]).powi(2)
    };
    (counted.iter().map(square).sum::<f64>() / counted.len() as f64).sqrt()
}
