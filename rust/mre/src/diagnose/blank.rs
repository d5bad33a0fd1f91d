//! How often something is named where nothing is missing: the fitted base model with its fitted noise,
//! simulated on the recordings' own motion and diagnosed like them.

use std::sync::{Arc, Mutex};

use rand_chacha::ChaCha8Rng;
use rand_core::SeedableRng;
use rayon::prelude::*;

use super::begin::{Given, begin};
use super::diagnosis::Diagnosis;
use super::judge::judge;
use super::monitor::{Monitor, Stage};
use super::normal::Rows;
use super::search::Search;
use super::settings::Settings;
use super::splits::Splits;
use super::verdict::Verdict;
use crate::assembly::{Base, Campaign};
use crate::effect::{Effect, InitialState, Sizes};
use crate::error::Result;

/// What was named in campaigns from which nothing is missing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Blank {
    /// Campaigns that were diagnosed to the end.
    pub count: usize,
    /// Those in which an effect was named.
    pub named: usize,
    /// Those in which nothing was named, but a mismatch was found.
    pub unexplained: usize,
    /// How often each effect was named, in the order of the alphabet.
    pub by_effect: Vec<(&'static str, usize)>,
}

/// Diagnose `count` simulations of the base model of a diagnosis.
///
/// The noise is what the final model leaves, so that an effect that is missing from the recordings is missing
/// from neither side here. Drift and interference are not simulated. Where the monitor breaks off, those
/// that were diagnosed by then count.
///
/// # Errors
/// The base model cannot be fitted to a simulation of itself.
pub fn blank(
    found: &Diagnosis,
    base: &Base,
    given: &[Given],
    settings: &Settings,
    count: usize,
    monitor: &dyn Monitor,
) -> Result<Blank> {
    let started = forces(found);
    let (done, quiet) = (Mutex::new(0), Quiet(monitor));
    let numbers: Vec<usize> = (0..count).collect();
    let mut outcomes = Vec::with_capacity(count);
    // As many at a time as there are threads: a thread that waits for one takes no further one on.
    for some in numbers.chunks(rayon::current_num_threads()) {
        let diagnosed = some.par_iter().map(|number| {
            let outcome = one(found, &started, base, given, settings, *number, &quiet)?;
            if let (Some(_), Ok(mut done)) = (&outcome, done.lock()) {
                *done += 1;
                monitor.begins(Stage::Blank(*done, count));
            }
            Ok(outcome)
        });
        outcomes.extend(diagnosed.collect::<Result<Vec<_>>>()?.into_iter().flatten());
    }
    Ok(Blank::of(&outcomes))
}

/// Verdict on one campaign, and the effects named; `None` where it was broken off.
type Outcome = (Verdict, Vec<&'static str>);

impl Blank {
    fn of(outcomes: &[Outcome]) -> Self {
        let mut by_effect: Vec<(&'static str, usize)> = Vec::new();
        for id in outcomes.iter().flat_map(|(_, named)| named) {
            match by_effect.iter_mut().find(|(known, _)| known == id) {
                Some((_, times)) => *times += 1,
                None => by_effect.push((id, 1)),
            }
        }
        by_effect.sort_unstable();
        let how_many = |wanted: fn(&Outcome) -> bool| outcomes.iter().filter(|o| wanted(o)).count();
        Self {
            count: outcomes.len(),
            named: how_many(|(_, named)| !named.is_empty()),
            unexplained: how_many(|(verdict, _)| *verdict == Verdict::Unexplained),
            by_effect,
        }
    }
}

/// Force in N of the base model, with what its unknown initial states add, by recording.
fn forces(found: &Diagnosis) -> Vec<Vec<f64>> {
    let assembly = &found.base.assembly;
    let recordings = assembly.campaign().recordings().len();
    let mut kept = vec![true; assembly.base_coefficients()];
    for (place, effect) in assembly.effects().iter().enumerate() {
        let simulated = !effect.of_the_measurement() || effect.about().effect == InitialState.about().effect;
        kept.extend(vec![simulated; assembly.of_effect(place).0.len()]);
    }
    let fitted = &found.base.fitted;
    let pairs = fitted.coefficients.iter().zip(&kept);
    let coefficients: Vec<f64> = pairs.map(|(c, kept)| if *kept { *c } else { 0.0 }).collect();
    let shapes = assembly.physical(&fitted.unit);
    (0..recordings).map(|r| assembly.columns(r, &shapes).force(&coefficients)).collect()
}

fn one(
    found: &Diagnosis,
    force: &[Vec<f64>],
    base: &Base,
    given: &[Given],
    settings: &Settings,
    number: usize,
    monitor: &dyn Monitor,
) -> Result<Option<Outcome>> {
    if monitor.broken_off() {
        return Ok(None);
    }
    let campaign = simulated(found, force, settings.seed, number);
    let base = base.again(campaign.recordings(), &base.members())?;
    let settings = Settings { seed: settings.seed.wrapping_add(1 + number as u64), ..settings.clone() };
    let rows: Vec<Rows> = campaign.recordings().iter().map(|r| vec![r.scored()]).collect();
    let begun = begin(&campaign, &base, given, &rows, monitor);
    let splits = Splits::of(&campaign, &base);
    let search = Search { begun: &begun, rows: &rows, splits: &splits, settings: &settings, monitor };
    let Some(found) = monitor.whole(search.run()) else { return Ok(None) };
    let judged = judge(&begun, found, &rows, settings.false_alarm, monitor);
    let named = match judged.verdict {
        Verdict::Unexplained => Vec::new(),
        _ => judged.named.added(&begun).iter().map(|e| e.about().effect).collect(),
    };
    Ok(monitor.whole((judged.verdict, named)))
}

/// The recordings' motion with the force of the base model and one realisation of the noise, in the steps
/// in which the recordings' force is measured.
fn simulated(found: &Diagnosis, force: &[Vec<f64>], seed: u64, number: usize) -> Campaign {
    let known = found.base.assembly.campaign();
    let count = known.recordings().len();
    let quantum = known.sizes().quantum;
    let recordings = known.recordings().iter().zip(force).enumerate().map(|(r, (recording, force))| {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        stream.set_stream((1 + number * count + r) as u64);
        let noise = found.named.noise.realisation(r, force.len(), &mut stream);
        let measured = force.iter().zip(noise).map(|(f, e)| match quantum {
            Some(step) => ((f + e) / step).round() * step,
            None => f + e,
        });
        Arc::new(recording.with_force(measured.collect()))
    });
    let recordings: Vec<_> = recordings.collect();
    let sizes = Sizes { noise: known.sizes().noise, ..Sizes::of(recordings.iter().map(AsRef::as_ref)) };
    Campaign::with_sizes(recordings, sizes).doubting(known.doubts().to_vec())
}

/// Tells nothing of the stages inside one campaign.
struct Quiet<'m>(&'m dyn Monitor);

impl Monitor for Quiet<'_> {
    fn broken_off(&self) -> bool {
        self.0.broken_off()
    }

    fn begins(&self, _: Stage) {}
}
