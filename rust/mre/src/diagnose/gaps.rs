//! Samples that are left out of a recording, while the noise around them keeps its memory.

use std::ops::Range;

use super::normal::Rows;
use crate::assembly::Campaign;
use crate::kernel::filter::dot;

/// Ridge on ones on the diagonal.
const RIDGE: f64 = 1e-10;

/// Samples of a recording that tell nothing.
pub(super) struct LeftOut<'a> {
    pub(super) ranges: &'a [Range<usize>],
    /// Samples of the recording that are scored.
    pub(super) scored: Range<usize>,
    /// Samples of the recording.
    pub(super) length: usize,
}

impl<'a> LeftOut<'a> {
    pub(super) fn of(campaign: &'a Campaign, r: usize) -> Self {
        let recording = &campaign.recordings()[r];
        Self { ranges: &campaign.doubts()[r].left_out, scored: recording.scored(), length: recording.len() }
    }

    /// Rows that count less the samples that tell nothing.
    pub(super) fn spare(&self, rows: &Rows) -> Rows {
        let ends = std::iter::once(0).chain(self.ranges.iter().map(|gap| gap.end));
        let starts = self.ranges.iter().map(|gap| gap.start).chain([self.length]);
        let kept: Rows = ends.zip(starts).map(|(start, end)| start..end).collect();
        let within = |row: &Range<usize>| {
            let (start, end) = (row.start, row.end);
            let first = kept.partition_point(|part| part.end <= start);
            let own = kept[first..].iter().take_while(move |part| part.start < end);
            own.map(|part| part.start.max(start)..part.end.min(end))
                .filter(|r| r.start < r.end)
                .collect::<Rows>()
        };
        rows.iter().flat_map(within).collect()
    }

    /// A series of the scored samples with what is around the gaps in them, mirrored from both sides.
    pub(super) fn bridge(&self, series: &mut [f64]) {
        let gaps = self.of_the_scored();
        let alike = self.alike(series);
        for (k, gap) in gaps.iter().enumerate() {
            let before = k.checked_sub(1).map_or(0, |k| gaps[k].end)..gap.start;
            let after = gap.end..gaps.get(k + 1).map_or(series.len(), |next| next.start);
            for i in gap.clone() {
                let (to, from) = (i - gap.start, gap.end - 1 - i);
                let left = (!before.is_empty()).then(|| series[before.end - 1 - to % before.len()]);
                let right = (!after.is_empty()).then(|| series[after.start + from % after.len()]);
                let share = (to as f64 + 0.5) / gap.len() as f64;
                series[i] = match (left, right) {
                    (Some(left), Some(right)) if gap.len() == 1 => alike * (left + right) / 2.0,
                    (Some(left), Some(right)) => left + share * (right - left),
                    (Some(one), None) | (None, Some(one)) => one,
                    (None, None) => series[i],
                };
            }
        }
    }

    /// Which of some samples tell something, where what is left out is felt for so many more; a single one is made up for
    /// by what is around it.
    pub(super) fn telling(&self, samples: Range<usize>, memory: usize) -> Vec<bool> {
        let mut telling = vec![true; samples.len()];
        for gap in self.places_in(&samples, memory) {
            telling[gap].fill(false);
        }
        telling
    }

    /// How much of the mean of its neighbours is to be expected of a scored sample that is left out alone, by the correlation of
    /// neighbours elsewhere: nothing in white noise.
    fn alike(&self, series: &[f64]) -> f64 {
        let telling = self.telling(self.scored.clone(), 0);
        let pairs = series.windows(2).zip(telling.windows(2)).filter(|(_, both)| both[0] && both[1]);
        let (product, square) = pairs.fold((0.0, f64::MIN_POSITIVE), |(product, square), (pair, _)| {
            (product + pair[0] * pair[1], square + pair[0] * pair[0])
        });
        let next = (product / square).clamp(-1.0, 1.0);
        2.0 * next / (1.0 + next * next)
    }

    fn of_the_scored(&self) -> Rows {
        self.places_in(&self.scored, 0).filter(|gap| !gap.is_empty()).collect()
    }

    /// What is left out, and so many samples after it, as places in some samples.
    fn places_in(&self, samples: &Range<usize>, memory: usize) -> impl Iterator<Item = Range<usize>> {
        let place = |i: usize| i.clamp(samples.start, samples.end) - samples.start;
        let felt = move |gap: &Range<usize>| if gap.len() == 1 { memory.min(1) } else { memory };
        self.ranges.iter().map(move |gap| place(gap.start)..place(gap.end + felt(gap)))
    }

    /// Gaps in the whole recording, for an autoregression.
    pub(super) fn gaps(&self, coefficients: &[f64], scale: f64) -> Gaps {
        Gaps::new(self.ranges, coefficients, scale, self.length)
    }

    /// Gaps in its scored samples alone, for an autoregression.
    pub(super) fn gaps_of_the_scored(&self, coefficients: &[f64], scale: f64) -> Gaps {
        Gaps::new(&self.of_the_scored(), coefficients, scale, self.scored.len())
    }
}

/// What samples alone would give in a whitened series, and the factor of their normal equations.
///
/// Whitened series less what such samples explain of them are those of the other samples alone: least squares
/// with one free value for each sample that is left out.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Gaps {
    places: Vec<usize>,
    /// Whitened unit impulse.
    impulse: Vec<f64>,
    /// Rows of the Cholesky factor: the first column that is not zero, and the entries from there on.
    factor: Vec<(usize, Vec<f64>)>,
}

impl Gaps {
    /// Gaps in series of `length` samples, whitened by an autoregression with this scale.
    fn new(ranges: &[Range<usize>], coefficients: &[f64], scale: f64, length: usize) -> Self {
        let places: Vec<usize> = ranges.iter().flat_map(Clone::clone).filter(|s| *s < length).collect();
        let impulse: Vec<f64> =
            std::iter::once(scale).chain(coefficients.iter().map(|a| -a * scale)).collect();
        let mut gaps = Self { places, impulse, factor: Vec::new() };
        for i in 0..gaps.places.len() {
            let row = gaps.factor_row(i, length);
            gaps.factor.push(row);
        }
        gaps
    }

    /// No gaps.
    pub(super) fn none() -> Self {
        Self::new(&[], &[], 1.0, 0)
    }

    /// Number of samples that are left out.
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    /// Take off a whitened series what the samples explain of it.
    pub(super) fn leave_out(&self, white: &mut [f64]) {
        let length = white.len() + self.memory();
        let mut values: Vec<f64> = Vec::with_capacity(self.places.len());
        for (i, place) in self.places.iter().enumerate() {
            let (here, impulse) = self.seen(*place, length);
            let (first, row) = &self.factor[i];
            let before = dot(&row[..i - first], &values[*first..]);
            values.push((dot(impulse, &white[here]) - before) / row[i - first]);
        }
        for i in (0..self.places.len()).rev() {
            let (first, row) = &self.factor[i];
            values[i] /= row[i - first];
            let value = values[i];
            for (v, l) in values[*first..i].iter_mut().zip(row) {
                *v -= l * value;
            }
        }
        for (place, value) in self.places.iter().zip(values) {
            let (here, impulse) = self.seen(*place, length);
            for (w, a) in white[here].iter_mut().zip(impulse) {
                *w -= a * value;
            }
        }
    }

    /// Samples that the noise remembers.
    fn memory(&self) -> usize {
        self.impulse.len() - 1
    }

    /// Where a whitened series of so many samples shows a sample, and how.
    fn seen(&self, place: usize, length: usize) -> (Range<usize>, &[f64]) {
        let memory = self.memory();
        let (start, end) = (place.max(memory), (place + memory + 1).min(length));
        (start - memory..end.max(start) - memory, &self.impulse[start - place..end.max(start) - place])
    }

    fn factor_row(&self, i: usize, length: usize) -> (usize, Vec<f64>) {
        let (here, impulse) = self.seen(self.places[i], length);
        let first = self.places[..i].partition_point(|s| s + self.memory() < self.places[i]);
        let mut row: Vec<f64> = Vec::with_capacity(i - first + 1);
        for j in first..i {
            let (there, other) = self.seen(self.places[j], length);
            let common = there.end.saturating_sub(here.start).min(here.len());
            let product = dot(&impulse[..common], &other[here.start - there.start..][..common]);
            let (start, known) = &self.factor[j];
            let both = (*start).max(first);
            let done = dot(&row[both - first..], &known[both - start..j - start]);
            row.push((product - done) / known[j - start]);
        }
        let square = dot(impulse, impulse);
        let left = square * (1.0 + RIDGE) - dot(&row, &row);
        row.push(if left > 0.0 { left.sqrt() } else { f64::MAX });
        (first, row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::filter::prediction_error;

    const COEFFICIENTS: [f64; 3] = [0.7, -0.2, 0.3];
    const SCALE: f64 = 2.0;

    fn series(n: usize) -> Vec<f64> {
        (0..n).map(|i| f64::from((i * i * 37 % 101) as u32) / 50.0 - 1.0).collect()
    }

    fn white(y: &[f64], gaps: &Gaps) -> Vec<f64> {
        let mut found = prediction_error(y, &COEFFICIENTS, SCALE);
        gaps.leave_out(&mut found);
        found
    }

    fn place(ranges: &[Range<usize>], length: usize) -> LeftOut<'_> {
        LeftOut { ranges, scored: 0..length, length }
    }

    #[test]
    fn rows_are_kept_between_gaps() {
        let spare = |rows: Rows| place(&[0..2, 5..6, 8..10], 10).spare(&rows);
        assert_eq!(spare(vec![0..7, 7..10]), [2..5, 6..7, 7..8]);
        assert_eq!(spare(vec![1..4, 5..6, 7..10]), [2..4, 7..8]);
        assert_eq!(place(&[], 10).spare(&vec![0..4, 6..10]), [0..4, 6..10]);
    }

    #[test]
    fn single_samples_are_bridged_by_as_much_as_neighbours_are_alike() {
        let single: Vec<Range<usize>> = (5..2000).step_by(10).map(|i| i..i + 1).collect();
        let gaps = place(&single, 2000);
        // Noise without memory keeps none, and what is smooth goes on.
        let mut noise: Vec<f64> =
            (0..2000_u32).map(|i| f64::from(i * i % 4099 * 37 % 1013) / 506.0 - 1.0).collect();
        gaps.bridge(&mut noise);
        let next = dot(&noise[1..], &noise[..1999]) / dot(&noise, &noise);
        assert!(next.abs() < 0.05, "{next}");
        let slow = |i: usize| (0.02 * i as f64).sin();
        let mut smooth: Vec<f64> = (0..2000).map(|i| if i % 10 == 5 { 9.0 } else { slow(i) }).collect();
        gaps.bridge(&mut smooth);
        assert!(smooth.iter().enumerate().all(|(i, y)| (y - slow(i)).abs() < 0.3), "{smooth:?}");
    }

    #[test]
    fn what_is_in_the_gaps_does_not_count() {
        let ranges = [1..3, 10..14, 15..16, 38..40];
        let mut y = series(40);
        let gaps = Gaps::new(&ranges, &COEFFICIENTS, SCALE, y.len());
        let before = white(&y, &gaps);
        for i in ranges.into_iter().flatten() {
            y[i] += 1000.0 * (i as f64).sin();
        }
        let after = white(&y, &gaps);
        assert!(before.iter().zip(&after).all(|(a, b)| (a - b).abs() < 1e-6), "{before:?} {after:?}");
        assert!(dot(&before, &before) > 1.0);
    }

    #[test]
    fn what_is_left_is_the_least_that_other_values_in_the_gaps_would_leave() {
        let mut y = series(40);
        let gaps = Gaps::new(&[10..12, 20..21], &COEFFICIENTS, SCALE, y.len());
        let least = white(&y, &gaps);
        let least = dot(&least, &least);
        // By turns, each value where the others are: the sum of squares is a parabola.
        let sum = |y: &[f64]| {
            let e = prediction_error(y, &COEFFICIENTS, SCALE);
            dot(&e, &e)
        };
        for _ in 0..500 {
            for i in [10, 11, 20] {
                let mut at = |value: f64| {
                    y[i] = value;
                    sum(&y)
                };
                let (low, middle, high) = (at(-1.0), at(0.0), at(1.0));
                y[i] = 0.5 * (low - high) / (low + high - 2.0 * middle);
            }
        }
        assert!((sum(&y) - least).abs() < 1e-9 * least, "{} {least}", sum(&y));
    }

    #[test]
    fn without_gaps_nothing_changes() {
        let y = series(20);
        assert_eq!(white(&y, &Gaps::none()), prediction_error(&y, &COEFFICIENTS, SCALE));
    }
}
