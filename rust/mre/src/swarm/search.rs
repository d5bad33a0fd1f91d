//! Searching behaviour (section 3.1.1, and its modification in 3.2.2): looks within the visual range.

use super::seen::Seen;
use super::{FishSettings, Search};

/// What a fish waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wait {
    /// The cost of the place it has moved to.
    Arrival,
    /// The costs of so many looks; so many were in vain before.
    Looks {
        /// Rows asked for.
        count: usize,
        /// Looks before these.
        before: usize,
    },
}

impl Wait {
    /// Rows that are asked for.
    pub(super) fn rows(self) -> usize {
        match self {
            Self::Arrival => 1,
            Self::Looks { count, .. } => count,
        }
    }
}

/// What a searching fish does after its looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Outcome {
    /// Stand where this look was.
    Jump(usize),
    /// A step towards this look.
    StepTowards(usize),
    /// Look again.
    LookAgain,
    /// Give up: the random behaviour.
    GiveUp,
}

/// Looks of the first round: all at once where the best is wanted, one where the first better one is.
pub(super) fn first_round(settings: &FishSettings) -> Wait {
    match settings.search {
        Search::Best => Wait::Looks { count: settings.try_number, before: 0 },
        Search::Step => Wait::Looks { count: 1, before: 0 },
    }
}

/// Judge looks, of which so many were in vain `before`, against the cost where the fish stands.
pub(super) fn judge(looks: &Seen, before: usize, count: usize, own: f64, settings: &FishSettings) -> Outcome {
    if looks.least < own {
        match settings.search {
            Search::Best => Outcome::Jump(looks.at),
            Search::Step => Outcome::StepTowards(looks.at),
        }
    } else if before + count < settings.try_number {
        Outcome::LookAgain
    } else {
        Outcome::GiveUp
    }
}
