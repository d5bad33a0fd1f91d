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
mod imagined;
mod limits;
mod telling;
mod told;
mod truth;
mod view;
mod world;

use super::monitor::Monitor;
use super::normal::Rows;
use super::search::Named;
use super::settings::Settings;
use crate::assembly::Base;
use bench::Bench;
use hidden::Hidden;
use telling::to_tell;
use told::EVEN;

pub(super) use doubt::{Doubt, Rival};
pub use excitation::{KINDS, Kind, Signal};
pub use limits::{GivenLimits, Limits};

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

impl NextTest {
    /// True where the proposed one is likely to rule something out.
    fn tells(&self) -> bool {
        self.prospects.first().is_some_and(|best| best.chances.iter().any(|(_, chance)| *chance >= EVEN))
    }

    /// With what another is expected to tell of what is in doubt.
    fn telling_no_more_than(mut self, other: &Self) -> Self {
        if let (Some(first), Some(other)) = (self.prospects.first_mut(), other.prospects.first()) {
            let shown = std::mem::take(&mut first.chances);
            let of_rivals = other.chances.iter().filter(|(id, _)| shown.iter().all(|(known, _)| known != id));
            first.chances = of_rivals.copied().chain(shown.iter().copied()).collect();
            (first.leaves, first.certainty) = (other.leaves.clone(), other.certainty);
        }
        self
    }
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
    // Of a rival it is asked whether it is told, not whether it shows.
    let is_rival = |id: &&'static str| doubt.rivals.iter().any(|rival| rival.effect == *id);
    let ids: Vec<&'static str> = doubt.hidden.iter().copied().filter(|id| !is_rival(id)).collect();
    let hidden = Hidden::new(&ids, named, settings);
    if doubt.rivals.is_empty() && hidden.ids.is_empty() {
        return None;
    }
    let bench = Bench::new(named, base, doubt, rows, monitor);
    if doubt.rivals.is_empty() {
        to_show(&bench, &limits, &hidden)
    } else {
        let told = to_tell(&bench, &limits.wider(&settings.limits), &hidden)?;
        if hidden.ids.is_empty() || told.tells() {
            return Some(told);
        }
        to_show(&bench, &limits, &hidden).map(|shown| shown.telling_no_more_than(&told))
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
