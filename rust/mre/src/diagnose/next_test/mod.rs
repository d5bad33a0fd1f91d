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
use hidden::shown;

pub(super) use doubt::{Doubt, Rival};
pub use excitation::{KINDS, Kind, Signal};
pub use limits::{GivenLimits, Limits};

/// A test that is harder to make has to tell so much more, in chances.
const WORTH: f64 = 0.1;
/// Chance of telling an effect in doubt that is enough.
const ENOUGH: f64 = 0.95;
/// Difference in the criterion beyond which more is no better.
const PLENTY: f64 = 100.0;
/// What that is worth beside a chance: it decides where chances are even.
const SURER: f64 = 0.05;
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
}

impl Prospect {
    fn new(kind: Kind, signal: &Signal, limits: &Limits, chances: Vec<(&'static str, f64)>) -> Self {
        let Signal { frequency, amplitude, .. } = *signal;
        Self { kind, frequency, amplitude, duration: limits.duration, chances }
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
    let shown = |signal: &Signal| shown(named, base, &doubt.hidden, rows, settings, signal, monitor);
    if doubt.rivals.is_empty() {
        return to_show(&limits, &doubt.hidden, shown, monitor);
    }
    let bench = Bench::new(named, base, doubt, rows, monitor);
    let mut found = to_tell(&bench, &limits.wider(&settings.limits))?;
    // What it shows besides.
    let first = &mut found.prospects[0];
    if let Some(besides) = first.kind.signal(&found.limits).and_then(|signal| shown(&signal)) {
        first.chances.extend(besides);
    }
    Some(found)
}

/// The excitation that shows most of what is hidden; of those that show as much, the plainest.
fn to_show(
    limits: &Limits,
    hidden: &[&'static str],
    shown: impl Fn(&Signal) -> Option<Vec<(&'static str, f64)>>,
    monitor: &dyn Monitor,
) -> Option<NextTest> {
    if hidden.is_empty() {
        return None;
    }
    let prospect = |kind: &Kind| {
        let signal = monitor.whole(kind.signal(limits)?)?;
        Some(Prospect::new(*kind, &signal, limits, shown(&signal)?))
    };
    let mut prospects: Vec<Prospect> = KINDS.iter().filter_map(prospect).collect();
    prospects.sort_by(|a, b| b.worth().total_cmp(&a.worth()));
    (!prospects.is_empty()).then(|| NextTest { limits: limits.clone(), prospects })
}

/// A test that tells what is in doubt.
struct Telling {
    kind: Kind,
    test: Imagined,
    told: Vec<Told>,
}

impl Telling {
    fn worth(&self) -> f64 {
        let of = |t: &Told| t.chance + SURER * (t.evidence / PLENTY).clamp(0.0, 1.0);
        self.told.iter().map(of).sum()
    }

    fn enough(&self) -> bool {
        self.told.iter().all(|t| t.chance >= ENOUGH)
    }
}

/// The easiest test that tells enough, or the one that tells most.
fn to_tell(bench: &Bench, wider: &[Limits]) -> Option<NextTest> {
    let mut best: Option<(&Limits, Vec<Telling>)> = None;
    for limits in wider {
        let glance = |kind: &Kind| {
            let test = bench.imagine(*kind, limits)?;
            Some(Telling { kind: *kind, told: bench.glance(&test)?, test })
        };
        let mut all: Vec<Telling> = KINDS.par_iter().filter_map(glance).collect();
        all.sort_by(|a, b| b.worth().total_cmp(&a.worth()));
        let least = best.as_ref().map_or(f64::NEG_INFINITY, |(_, known)| known[0].worth() + WORTH);
        for telling in all.iter_mut().take(CLOSELY).filter(|t| t.worth() > least) {
            telling.told = bench.look(&telling.test)?;
        }
        all.sort_by(|a, b| b.worth().total_cmp(&a.worth()));
        if all.first().is_some_and(|first| first.worth() > least) {
            best = Some((limits, all));
        }
        if best.as_ref().is_some_and(|(_, known)| known[0].enough()) {
            break;
        }
    }
    let (limits, all) = best?;
    let chances = |t: &Telling| t.told.iter().map(|t| (t.effect, t.chance)).collect();
    let prospect = |t: &Telling| Prospect::new(t.kind, t.test.signal(), limits, chances(t));
    Some(NextTest { limits: limits.clone(), prospects: all.iter().map(prospect).collect() })
}
