//! What to test next: the excitation that, added to the recordings, best tells apart what is in doubt.
//!
//! Each model that may be true is simulated finely on an excitation. It is told from another by how much worse that
//! one fits the recordings and the simulation together: to first order for every excitation, by a fit for the best.
//! Where no limits are given, a test may be longer than the recordings, then faster, until it tells enough. Effects
//! that the recordings hide are tested for on the same, as in the diagnosis itself.

mod bench;
mod doubt;
mod excitation;
mod hidden;
mod limits;
mod view;
mod world;

use rayon::prelude::*;

use super::monitor::Monitor;
use super::normal::Rows;
use super::search::Named;
use super::settings::Settings;
use crate::assembly::Base;
use bench::{Bench, Imagined};
use doubt::Told;
use hidden::Hidden;

pub(super) use doubt::{Doubt, Rival};
pub use excitation::{KINDS, Kind, Signal};
pub use limits::{GivenLimits, Limits};

/// A test that is harder to make has to rule out so many more effects.
const WORTH: f64 = 0.1;
/// Chance that nothing is in doubt any more that is enough.
const ENOUGH: f64 = 0.95;
/// Excitations that are looked at closely.
const CLOSELY: usize = 2;

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
    /// For each effect that may be true, what would probably be left in doubt beside it.
    pub leaves: Vec<(&'static str, Vec<&'static str>)>,
    /// Chance that nothing is in doubt after it, whatever is true of what is; `None`: nothing was.
    pub certainty: Option<f64>,
}

impl Prospect {
    fn new(kind: Kind, signal: &Signal, limits: &Limits, chances: Vec<(&'static str, f64)>) -> Self {
        let Signal { frequency, amplitude, .. } = *signal;
        Self {
            kind,
            frequency,
            amplitude,
            duration: limits.duration,
            chances,
            leaves: Vec::new(),
            certainty: None,
        }
    }

    fn worth(&self) -> f64 {
        self.chances.iter().map(|(_, chance)| chance).sum()
    }
}

/// The proposed excitation among all that were tried.
#[derive(Debug, Clone, PartialEq)]
pub struct NextTest {
    /// Limits of the proposed one.
    pub limits: Limits,
    /// All of them, the proposed one first.
    pub prospects: Vec<Prospect>,
}

/// The best of the excitations within the limits given, or near those of the recordings.
pub(super) fn propose<'a>(
    named: &Named<'a>,
    base: &Base,
    doubt: &Doubt<'a>,
    rows: &[Rows],
    settings: &Settings,
    monitor: &dyn Monitor,
) -> Option<NextTest> {
    let limits = Limits::of(&settings.limits, named.assembly.campaign());
    let hidden = Hidden::new(&doubt.hidden, named, settings);
    if doubt.rivals.is_empty() && hidden.ids.is_empty() {
        return None;
    }
    let bench = Bench::new(named, base, doubt, rows, monitor);
    if doubt.rivals.is_empty() {
        to_show(&bench, &limits, &hidden)
    } else {
        to_tell(&bench, &limits.wider(&settings.limits), &hidden)
    }
}

/// The excitation that shows most of what is hidden; of those that show as much, the plainest.
fn to_show(bench: &Bench, limits: &Limits, hidden: &Hidden) -> Option<NextTest> {
    let prospect = |kind: &Kind| {
        let test = bench.imagine(*kind, limits)?;
        Some(Prospect::new(*kind, test.signal(), limits, hidden.shown(bench, &test)?))
    };
    let mut prospects: Vec<Prospect> = KINDS.iter().filter_map(prospect).collect();
    prospects.sort_by(|a, b| b.worth().total_cmp(&a.worth()));
    (!prospects.is_empty()).then(|| NextTest { limits: limits.clone(), prospects })
}

/// A test that tells what is in doubt.
struct Telling {
    kind: Kind,
    test: Imagined,
    told: Told,
}

/// The easiest test that tells enough, or the one that tells most; with what it shows besides of what is hidden.
fn to_tell(bench: &Bench, wider: &[Limits], hidden: &Hidden) -> Option<NextTest> {
    let mut best: Option<(&Limits, Vec<Telling>)> = None;
    for limits in wider {
        let glance = |kind: &Kind| {
            let test = bench.imagine(*kind, limits)?;
            Some(Telling { kind: *kind, told: bench.glance(&test)?, test })
        };
        let mut all: Vec<Telling> = KINDS.par_iter().filter_map(glance).collect();
        best_first(&mut all);
        let least = best.as_ref().map_or(f64::NEG_INFINITY, |(_, known)| known[0].told.worth + WORTH);
        let mut closely: Vec<Telling> = Vec::new();
        for mut telling in all.drain(..CLOSELY.min(all.len())).filter(|t| t.told.worth > least) {
            telling.told = bench.look(&telling.test)?;
            closely.push(telling);
        }
        best_first(&mut closely);
        if closely.first().is_some_and(|first| first.told.worth > least) {
            closely.extend(all);
            best = Some((limits, closely));
        }
        if best.as_ref().is_some_and(|(_, known)| known[0].told.certainty >= ENOUGH) {
            break;
        }
    }
    let (limits, all) = best?;
    let prospect = |t: &Telling| {
        let prospect = Prospect::new(t.kind, t.test.signal(), limits, t.told.chances.clone());
        Prospect { certainty: Some(t.told.certainty), leaves: t.told.leaves.clone(), ..prospect }
    };
    let mut prospects: Vec<Prospect> = all.iter().map(prospect).collect();
    prospects[0].chances.extend(hidden.shown(bench, &all[0].test).unwrap_or_default());
    Some(NextTest { limits: limits.clone(), prospects })
}

fn best_first(all: &mut [Telling]) {
    all.sort_by(|a, b| b.told.worth.total_cmp(&a.told.worth));
}
