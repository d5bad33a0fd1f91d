//! Whether the recordings, and their parts, agree on the size of an effect that is named.
//!
//! An effect that stands for another explains some recordings and worsens others: a delay in the place of an appended mass
//! that swings is positive below the frequency of that and negative above. An autoregression may take the most of such a
//! mismatch for noise, and what an effect does on all recordings together is beyond chance still.

use super::candidates::Candidate;
use super::least_squares::Data;
use super::missing::{MORE_CAUTION, MOST_RECORDINGS, Mismatch, Projected};
use super::needless::keeping;
use super::null::Null;
use super::point::forces;
use super::search::Named;

/// Parts of a recording in each of which an effect does as much.
const PARTS: usize = 4;

/// What is tested of each effect: recordings, and parts of them.
const SPLITS: [usize; 2] = [1, PARTS];

/// What sizes of their own in recordings, or in parts of them, add to effects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Agreed {
    /// Of that which disagrees most.
    pub(super) mismatch: Mismatch,
    /// Tests that were made.
    pub(super) tests: usize,
}

impl Agreed {
    /// No test could be made.
    pub(super) const NONE: Self = Self { mismatch: Mismatch::NONE, tests: 0 };
}

/// Test the effects of a model from one on, those of a measurement apart: each recording has its own of these. `beside`
/// is the model.
pub(super) fn agreed(beside: &Null, named: &Named, data: Data, first: usize) -> Agreed {
    let effects = named.assembly.effects();
    let recordings = named.assembly.campaign().recordings().len();
    // The changes are those on the motions as they are: what their noise does to such columns is not known.
    let shaken = beside.changes().next().is_some();
    if recordings > MOST_RECORDINGS || shaken || beside.broken_off() {
        return Agreed::NONE;
    }
    let moves = |place: &usize| effects[*place].follows_the_motion() && !effects[*place].of_the_measurement();
    let tested: Vec<usize> = (first..effects.len()).filter(moves).collect();
    if tested.is_empty() {
        return Agreed::NONE;
    }
    let whole = forces(&named.assembly, data, &named.fitted);
    let mut all: Vec<Mismatch> = Vec::new();
    for place in tested {
        let Candidate { assembly, fitted } = keeping(named, data, |other| other != place);
        let without = forces(&assembly, data, &fitted);
        let less = |(a, b): (&Vec<f64>, Vec<f64>)| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let change: Vec<Vec<f64>> = whole.iter().zip(without).map(less).collect();
        let splits = SPLITS.into_iter().filter(|parts| *parts > 1 || recordings > 1);
        all.extend(splits.map(|parts| beside.sizes_apart(&change, parts)));
    }
    let most = all.iter().copied().min_by(|a, b| a.p_value.total_cmp(&b.p_value));
    most.map_or(Agreed::NONE, |mismatch| Agreed { mismatch, tests: all.len() })
}

impl Null<'_> {
    /// What a change of the force in N, by recording, takes off that has its own size in each of so many parts.
    fn sizes_apart(&self, change: &[Vec<f64>], parts: usize) -> Mismatch {
        let count = parts * change.len();
        let projected = self.project_as_they_are(count, |_, r| {
            let cut = equal_parts(&change[r], parts);
            (0..parts)
                .map(|k| {
                    let only = |(value, part): (&f64, &usize)| if *part == k { *value } else { 0.0 };
                    (parts * r + k, change[r].iter().zip(&cut).map(only).collect())
                })
                .collect()
        });
        let all: Vec<usize> = (0..count).collect();
        let Mismatch { gain, freedom, .. } = Projected::of(&projected, &all).mismatch();
        Mismatch::new(gain / MORE_CAUTION, freedom)
    }
}

/// The part that each value belongs to, where the parts have equal sums of squares.
fn equal_parts(values: &[f64], parts: usize) -> Vec<usize> {
    let all: f64 = values.iter().map(|v| v * v).sum();
    let mut so_far = 0.0;
    let part = |value: &f64| {
        let part = (parts as f64 * so_far / all.max(f64::MIN_POSITIVE)) as usize;
        so_far += value * value;
        part.min(parts - 1)
    };
    values.iter().map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_have_equal_squares() {
        let values: Vec<f64> = (0..1000).map(|i| if i < 500 { 0.0 } else { 1.0 }).collect();
        let parts = equal_parts(&values, 4);
        let sum =
            |k: usize| values.iter().zip(&parts).filter(|(_, part)| **part == k).map(|(v, _)| v).sum::<f64>();
        assert!((0..4).all(|k| (sum(k) - 125.0).abs() < 1.5), "{parts:?}");
        assert_eq!(equal_parts(&[0.0; 3], 4), [0; 3]);
    }
}
