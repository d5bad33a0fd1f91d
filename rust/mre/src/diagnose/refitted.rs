//! What a base whose parameters were kept would leave with fitted ones: wrong parameters look like missing physics.

use super::begin::begin;
use super::diagnosis::Diagnosis;
use super::least_squares::Data;
use super::monitor::{Monitor, Stage};
use super::normal::Rows;
use super::point::forces;
use super::starts::with_initial_states;
use super::verdict::Verdict;
use crate::assembly::Campaign;

/// With fewer samples for each parameter a fit follows the noise.
const EACH: usize = 5;

/// Rms errors over the samples that count, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refitted {
    /// With the parameters that were kept.
    pub as_given: f64,
    /// With parameters fitted to these recordings.
    pub fitted: f64,
}

/// Fit the parameters that a diagnosis has kept, in `groups` of recordings that share them.
///
/// `None` where nothing is missing, where the base is no model without effects whose parameters were kept, where
/// there are too few samples or no fit is better, and where it was broken off.
pub fn refitted(found: &Diagnosis, groups: &[Vec<usize>], monitor: &dyn Monitor) -> Option<Refitted> {
    found.judgement.filter(|judgement| judgement.verdict != Verdict::Adequate)?;
    let campaign = found.base.assembly.campaign();
    let base = found.base.assembly.base().unkept(campaign.recordings(), groups)?;
    let parameters: usize = base.groups().iter().map(|group| group.problem.parameters().len()).sum();
    let rows: Vec<Rows> = campaign.recordings().iter().map(|r| vec![r.scored()]).collect();
    if counted(campaign).len() < EACH * parameters {
        return None;
    }
    let begun = monitor.stage(Stage::Refit, || begin(campaign, &base, &[], &rows, monitor))?;
    let data = Data { noise: &begun.noise, rows: &rows, monitor };
    let force = with_initial_states(&begun.assembly, forces(&begun.assembly, data, &begun.fitted));
    let both = Refitted { as_given: rms(campaign, &found.base_force), fitted: rms(campaign, &force) };
    (both.fitted < both.as_given).then_some(both)
}

/// Recording and place of each sample that counts.
fn counted(campaign: &Campaign) -> Vec<(usize, usize)> {
    let places = campaign.recordings().iter().zip(campaign.left_out()).enumerate();
    places
        .flat_map(|(r, (recording, left_out))| {
            let counts = |i: &usize| !left_out.iter().any(|part| part.contains(i));
            recording.scored().filter(counts).map(move |i| (r, i)).collect::<Vec<_>>()
        })
        .collect()
}

fn rms(campaign: &Campaign, forces: &[Vec<f64>]) -> f64 {
    let counted = counted(campaign);
    let square = |(r, i): &(usize, usize)| {
        let measured = campaign.recordings()[*r].force().map_or(0.0, |force| force[*i]);
        (measured - forces[*r][*i]).powi(2)
    };
    (counted.iter().map(square).sum::<f64>() / counted.len() as f64).sqrt()
}
