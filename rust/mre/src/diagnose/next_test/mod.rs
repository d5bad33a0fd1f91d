//! What to test next: the excitation that, added to the recordings, best tells apart what is in doubt.
//!
//! The model named is taken as true and simulated on each excitation. A rival is refitted to the recordings
//! and that simulation together: by how much worse it fits then is the expected evidence against it. Effects
//! that the recordings hide are tested for on the same, as in the diagnosis itself.

mod excitation;
mod limits;
mod told;
mod world;

use super::absorbed::{hidden_among, ids_of};
use super::candidates::Candidate;
use super::distribution::normal_tail;
use super::least_squares::{Data, refine};
use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::Rows;
use super::null::Null;
use super::screen::Score;
use super::search::Named;
use super::settings::Settings;
use crate::assembly::Base;
use crate::effect::Effect;
use told::{Told, by_effect};
use world::World;

pub use excitation::{KINDS, Kind, Signal};
pub use limits::{GivenLimits, Limits};

/// Difference in the criterion from which two effects are told apart.
const APART: f64 = 10.0;
/// Passes until a simulation agrees with what effects see of it.
const PASSES: usize = 4;
/// Logarithm of the highest odds that are told of a rival: where it is as good as certain.
const MOST_ODDS: f64 = 50.0;
/// A plainer excitation is preferred where another resolves less than this much more.
const WORTH: f64 = 0.1;
/// Chance of telling an effect in doubt that is enough.
const ENOUGH: f64 = 0.95;
/// How many times as long the test may be where that tells more.
const LONGER: [f64; 2] = [2.0, 4.0];

/// What an excitation is expected to tell.
#[derive(Debug, Clone, PartialEq)]
pub struct Prospect {
    /// The excitation.
    pub kind: Kind,
    /// Frequency of the drive, or the highest in it, Hz.
    pub frequency: f64,
    /// Largest displacement, mm.
    pub amplitude: f64,
    /// s.
    pub duration: f64,
    /// Chance that each effect in doubt is told apart or detected.
    pub chances: Vec<(&'static str, f64)>,
}

/// The proposed excitation among all that were tried.
#[derive(Debug, Clone, PartialEq)]
pub struct NextTest {
    /// Limits of the proposed one.
    pub limits: Limits,
    /// All of them, the proposed one first.
    pub prospects: Vec<Prospect>,
}

/// What is in doubt.
pub(super) struct Doubt<'a> {
    /// Models that fit as well as the one named, by the effect that they put in place of one of its own, of
    /// which some come with several laws.
    pub(super) rivals: Vec<(&'static str, Candidate<'a>)>,
    /// Ids of effects that the recordings would hide.
    pub(super) hidden: Vec<&'static str>,
}

/// The best of the excitations within the limits given, or those of the recordings.
pub(super) fn propose(
    named: &Named,
    base: &Base,
    doubt: &Doubt,
    rows: &[Rows],
    settings: &Settings,
    monitor: &dyn Monitor,
) -> Option<NextTest> {
    if doubt.rivals.is_empty() && doubt.hidden.is_empty() {
        return None;
    }
    let mut limits = Limits::of(&settings.limits, named.assembly.campaign());
    let prospect = |kind: Kind, limits: &Limits| {
        let signal = monitor.whole(kind.signal(limits)?)?;
        let chances = chances(named, base, doubt, rows, settings, &signal, monitor)?;
        let (frequency, amplitude, duration) = (signal.frequency, signal.amplitude, limits.duration);
        Some(Prospect { kind, frequency, amplitude, duration, chances })
    };
    let mut prospects: Vec<Prospect> = KINDS.iter().filter_map(|kind| prospect(*kind, &limits)).collect();
    // What is in doubt comes first, then what is hidden; of those that tell about as much, the plainest.
    let is_rival = |id: &str| doubt.rivals.iter().any(|(known, _)| *known == id);
    let worth = |p: &Prospect, rival: bool| -> f64 {
        p.chances.iter().filter(|(id, _)| is_rival(id) == rival).map(|(_, chance)| chance).sum()
    };
    let mut best: Vec<usize> = (0..prospects.len()).collect();
    for rival in [true, false] {
        let most = best.iter().map(|i| worth(&prospects[*i], rival)).fold(0.0, f64::max);
        best.retain(|i| worth(&prospects[*i], rival) >= most - WORTH);
    }
    let mut chosen = prospects.remove(*best.first()?);
    if settings.limits.duration.is_none() {
        let usual = limits.duration;
        for times in LONGER {
            if chosen.chances.iter().all(|(id, chance)| !is_rival(id) || *chance >= ENOUGH) {
                break;
            }
            let longer = Limits { duration: times * usual, ..limits.clone() };
            let Some(other) = prospect(chosen.kind, &longer) else { break };
            if worth(&other, true) > worth(&chosen, true) + WORTH {
                (chosen, limits) = (other, longer);
            }
        }
    }
    prospects.sort_by(|a, b| {
        let by = |rival| worth(b, rival).total_cmp(&worth(a, rival));
        by(true).then_with(|| by(false))
    });
    prospects.insert(0, chosen);
    Some(NextTest { limits, prospects })
}

/// Chance for each effect in doubt that an excitation tells it.
fn chances(
    named: &Named,
    base: &Base,
    doubt: &Doubt,
    rows: &[Rows],
    settings: &Settings,
    signal: &Signal,
    monitor: &dyn Monitor,
) -> Option<Vec<(&'static str, f64)>> {
    let silent = World::new(named.assembly.campaign(), base, signal, None)?;
    let force = silent.simulated(&named.assembly, &named.fitted, PASSES)?;
    let world = World::new(named.assembly.campaign(), base, signal, Some(force))?;
    let noise: Noise = named.noise.with_another_like(0);
    let mut rows = rows.to_vec();
    rows.extend(world.campaign().recordings().last().map(|r| vec![r.scored()]));
    let data = Data { noise: &noise, rows: &rows, monitor };
    let (own, start) = world.assembly(&named.assembly, &named.fitted);
    let fitted = refine(&own, data, &start);
    let told: Vec<Told> = doubt
        .rivals
        .iter()
        .map(|(id, rival)| {
            let (assembly, start) = world.assembly(&rival.assembly, &rival.fitted);
            let other = refine(&assembly, data, &start);
            let against = other.criterion() - fitted.criterion();
            // The evidence varies with the noise like a normal variable of this variance; a model that cannot follow
            // the excitation at all is ruled out.
            let spread = 2.0 * against.max(1.0).sqrt();
            let chance =
                if against.is_finite() { 1.0 - normal_tail((against - APART) / spread) } else { 1.0 };
            let odds = (0.5 * (named.fitted.criterion() - rival.criterion())).min(MOST_ODDS).exp();
            Told { id, chance, odds }
        })
        .collect();
    let mut found = by_effect(&told);
    let null = Null::new(&own, data, &fitted.unit)?;
    let laws: Vec<&'static dyn Effect> =
        settings.laws.iter().copied().filter(|e| doubt.hidden.contains(&e.about().effect)).collect();
    let scores: Vec<Score> = laws.iter().filter_map(|law| null.score(*law, settings.seed)).collect();
    let count = ids_of(&named.scores).len();
    let still = hidden_among(&scores, count, world.campaign(), settings.false_alarm);
    found.extend(
        doubt.hidden.iter().map(|id| (*id, if still.iter().any(|h| h.effect == *id) { 0.0 } else { 1.0 })),
    );
    Some(found)
}
