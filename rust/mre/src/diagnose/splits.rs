//! Which data take no part in training: recordings, or blocks where there are too few recordings.

use std::ops::Range;

use super::normal::Rows;
use crate::assembly::{Assembly, Base, Campaign};
use crate::recording::{Condition, Recording};

/// Folds of recordings.
const FOLDS: usize = 3;
/// Blocks that a recording is cut into where blocks are held out.
const BLOCKS: usize = 12;
/// Longest guard between held-out and training samples, as a share of a block.
const LONGEST_GUARD: f64 = 0.3;
/// Guard where the blocks are long enough, s.
const GUARD: f64 = 1.0;

/// Training and held-out samples.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Split {
    /// Samples that models are trained on, by recording.
    pub(super) train: Vec<Rows>,
    /// Samples that they are judged on.
    pub(super) held_out: Vec<Rows>,
}

/// Ways to split a campaign.
pub(super) struct Splits {
    /// Recordings are held out, where there are enough of them.
    whole: Vec<Split>,
    /// Blocks of every recording are held out.
    blocks: Vec<Split>,
}

impl Splits {
    /// Those of a campaign beside a base.
    pub(super) fn of(campaign: &Campaign, base: &Base) -> Self {
        Self { whole: splits(campaign, base, false), blocks: splits(campaign, base, true) }
    }

    /// Those in which a model can be proved: what happened in one recording is not to be learnt from others.
    pub(super) fn fit_for(&self, assembly: &Assembly) -> &[Split] {
        if assembly.effects().iter().any(|e| e.in_one_recording()) { &self.blocks } else { &self.whole }
    }
}

/// Splits in each of which other samples are held out.
///
/// Whole recordings are held out where every group that shares parameters has enough of them; otherwise,
/// or where `by_blocks` asks for it, contiguous blocks of every recording, separated by a guard.
fn splits(campaign: &Campaign, base: &Base, by_blocks: bool) -> Vec<Split> {
    let recordings: Vec<&Recording> = campaign.recordings().iter().map(AsRef::as_ref).collect();
    let (groups, least) = match base {
        Base::Fitted(_) => (base.members(), FOLDS),
        // What follows the current is not to be had from other currents.
        Base::Held(_) | Base::Given(_) => (of_one_current(&recordings), 2),
    };
    if by_blocks || recordings.len() < FOLDS || groups.iter().any(|g| g.len() < least) {
        return (0..FOLDS).map(|fold| blocks(&recordings, fold)).collect();
    }
    let mut fold_of = vec![None; recordings.len()];
    for group in &groups {
        // What is farthest and what is fastest always trains: a model is judged inside the tested range.
        let extreme = |series: fn(&Recording) -> &[f64]| {
            let size = |r: &usize| series(recordings[*r]).iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            group.iter().copied().max_by(|a, b| size(a).total_cmp(&size(b)))
        };
        let kept = [extreme(Recording::displacement), extreme(Recording::velocity)];
        let spare = group.len() > FOLDS + 1;
        let judged = group.iter().filter(|r| !spare || !kept.contains(&Some(**r)));
        for (place, r) in judged.enumerate() {
            fold_of[*r] = Some(fold_of_place(place));
        }
    }
    (0..FOLDS)
        .map(|fold| {
            let mut split = Split { train: Vec::new(), held_out: Vec::new() };
            for (r, recording) in recordings.iter().enumerate() {
                let (out, whole) = (fold_of[r] == Some(fold), vec![recording.scored()]);
                split.train.push(if out { Vec::new() } else { whole.clone() });
                split.held_out.push(if out { whole } else { Vec::new() });
            }
            split
        })
        .collect()
}

/// Fold of a recording by its place: each row of as many as there are folds begins one later, as in a Latin square.
///
/// Campaigns are rows of as many frequencies at one amplitude after another: in turn, a fold would be all that there is of
/// one frequency, and what was held out would lie outside what was trained on. (Nine in a row still line up.)
fn fold_of_place(place: usize) -> usize {
    (place + place / FOLDS) % FOLDS
}

/// Places of recordings with the same constant current; one group where it changes within a recording.
fn of_one_current(recordings: &[&Recording]) -> Vec<Vec<usize>> {
    let mut groups: Vec<(&Condition, Vec<usize>)> = Vec::new();
    for (place, recording) in recordings.iter().enumerate() {
        let current = recording.current();
        if current.varies() {
            return vec![(0..recordings.len()).collect()];
        }
        match groups.iter_mut().find(|(known, _)| *known == current) {
            Some((_, members)) => members.push(place),
            None => groups.push((current, vec![place])),
        }
    }
    groups.into_iter().map(|(_, members)| members).collect()
}

fn blocks(recordings: &[&Recording], fold: usize) -> Split {
    let mut split = Split { train: Vec::new(), held_out: Vec::new() };
    for recording in recordings {
        let scored = recording.scored();
        let edge = |b: usize| scored.start + scored.len() * b / BLOCKS;
        let length = scored.len() as f64 / BLOCKS as f64;
        let guard = (GUARD * recording.sampling_rate()).min(LONGEST_GUARD * length) as usize;
        let (mut train, mut held_out): (Vec<Range<usize>>, Rows) = (Vec::new(), Vec::new());
        for b in 0..BLOCKS {
            let block = edge(b)..edge(b + 1);
            if b % FOLDS == fold {
                held_out.push(block);
            } else {
                let start = block.start + if b > 0 && (b - 1) % FOLDS == fold { guard } else { 0 };
                let end = block.end - if (b + 1) % FOLDS == fold && b + 1 < BLOCKS { guard } else { 0 };
                match train.last_mut() {
                    Some(last) if last.end == start => last.end = end,
                    _ => train.push(start..end),
                }
            }
        }
        split.train.push(train);
        split.held_out.push(held_out);
    }
    split
}

#[cfg(test)]
mod tests {
    use super::*;

    fn in_one_fold(places: impl IntoIterator<Item = usize>) -> bool {
        let folds: Vec<usize> = places.into_iter().map(fold_of_place).collect();
        folds.iter().all(|fold| *fold == folds[0])
    }

    #[test]
    fn no_fold_is_all_of_a_frequency_or_of_an_amplitude() {
        for (frequencies, amplitudes) in (2..=8).flat_map(|f| [(f, 4), (f, 5), (f, 6)]) {
            for f in 0..frequencies {
                assert!(!in_one_fold((0..amplitudes).map(|a| a * frequencies + f)), "{frequencies} in a row");
            }
            for a in 0..amplitudes {
                assert!(!in_one_fold(a * frequencies..(a + 1) * frequencies), "{frequencies} in a row");
            }
        }
    }

    #[test]
    fn folds_are_of_one_size() {
        for count in 3..40 {
            let of = |fold: usize| (0..count).filter(|place| fold_of_place(*place) == fold).count();
            for size in (0..FOLDS).map(of) {
                assert!((count / FOLDS..=count.div_ceil(FOLDS)).contains(&size), "{size} of {count}");
            }
        }
    }
}
