//! What a diagnosis tells while it runs, and how it is broken off.
//!
//! Long loops look at the monitor and end early with what they have; whoever asked for their result looks
//! again before believing it ([`Monitor::whole`]).

use std::fmt;

/// What a diagnosis is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// First fit of the base model.
    Base,
    /// Score tests of the catalogue beside the base model and so many effects.
    Catalogue(usize),
    /// Joint fits of the strongest candidates.
    Candidates,
    /// Other laws of the effects named.
    Laws,
    /// Pairs from other firsts.
    Pairs,
    /// Effects that the others make unnecessary.
    Needless,
    /// The test of what is left.
    Verdict,
    /// Where the base model misses.
    Location,
    /// What an unexplained mismatch depends on.
    Unknown,
    /// What the recordings would hide.
    Identifiability,
    /// Rms errors on samples that took no part.
    Proof,
    /// Effects that the recordings cannot tell from those named.
    Alternatives,
    /// The excitation that resolves most of what is in doubt.
    NextTest,
    /// Fit of the parameters that were kept.
    Refit,
    /// Simulated campaigns from which nothing is missing: how many are done, and how many there are.
    Blank(usize, usize),
    /// Nothing is left to do.
    Done,
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match self {
            Self::Base => "fitting the base model",
            Self::Catalogue(0) => "scoring the catalogue beside the base model",
            Self::Catalogue(1) => "scoring the catalogue beside 1 effect",
            Self::Catalogue(count) => return write!(f, "scoring the catalogue beside {count} effects"),
            Self::Candidates => "refitting the strongest candidates",
            Self::Laws => "trying other laws of the effects named",
            Self::Pairs => "looking for a better pair",
            Self::Needless => "leaving out what is not needed",
            Self::Verdict => "testing what is left",
            Self::Location => "locating the mismatch",
            Self::Unknown => "describing what is unexplained",
            Self::Identifiability => "asking what the recordings would hide",
            Self::Proof => "proving on held-out data",
            Self::Alternatives => "looking for alternatives",
            Self::NextTest => "looking for the next test",
            Self::Refit => "fitting the parameters that were kept",
            Self::Done => "done",
            Self::Blank(done, count) => return write!(f, "blank campaigns: {done} of {count}"),
        };
        f.write_str(words)
    }
}

/// Told of stages, asked whether to go on: from any thread.
pub trait Monitor: Sync {
    /// True where the diagnosis should end soon; once true, it stays so.
    fn broken_off(&self) -> bool;

    /// A stage begins.
    fn begins(&self, stage: Stage);
}

/// Watches nothing.
impl Monitor for () {
    fn broken_off(&self) -> bool {
        false
    }

    fn begins(&self, _: Stage) {}
}

impl dyn Monitor + '_ {
    /// A result, unless the work was broken off: it is then not to be believed.
    pub(super) fn whole<T>(&self, result: T) -> Option<T> {
        (!self.broken_off()).then_some(result)
    }

    /// Work on a stage; nothing where it was broken off before its end.
    pub(super) fn stage<T>(&self, stage: Stage, work: impl FnOnce() -> T) -> Option<T> {
        if self.broken_off() {
            return None;
        }
        self.begins(stage);
        self.whole(work())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicBool, Ordering};

    use super::*;

    #[derive(Default)]
    struct Noted(AtomicBool, Mutex<Vec<Stage>>);

    impl Monitor for Noted {
        fn broken_off(&self) -> bool {
            self.0.load(Ordering::Relaxed)
        }

        fn begins(&self, stage: Stage) {
            self.1.lock().into_iter().for_each(|mut all| all.push(stage));
        }
    }

    #[test]
    fn what_was_broken_off_is_not_believed() {
        let noted = Noted::default();
        let monitor: &dyn Monitor = &noted;
        assert_eq!(monitor.stage(Stage::Base, || 1), Some(1));
        let broken_off_inside = monitor.stage(Stage::Laws, || noted.0.store(true, Ordering::Relaxed));
        assert_eq!(broken_off_inside, None);
        assert_eq!(monitor.stage(Stage::Proof, || 1), None);
        assert_eq!(noted.1.lock().map(|all| all.clone()).ok(), Some(vec![Stage::Base, Stage::Laws]));
    }
}
