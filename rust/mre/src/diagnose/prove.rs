//! Proof on data that took no part: folds of recordings, or of blocks where there are too few recordings.

use std::ops::Range;

use rayon::prelude::*;

use super::least_squares::{Data, Fitted, refine};
use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::Rows;
use super::point::Point;
use crate::assembly::{Assembly, Base, Campaign};
use crate::kernel::filter::dot;
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

/// Splits in each of which other samples are held out.
///
/// Whole recordings are held out where every group that shares parameters has enough of them; otherwise,
/// or where `by_blocks` asks for it, contiguous blocks of every recording, separated by a guard.
pub(super) fn splits(campaign: &Campaign, base: &Base, by_blocks: bool) -> Vec<Split> {
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
            fold_of[*r] = Some(place % FOLDS);
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

/// Squared errors in N^2 and number of samples, by recording.
type Sums = Vec<(f64, usize)>;

/// Sum of squared errors in N^2, and of samples, on training and held-out samples over all splits.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Rms error on the samples trained on, N.
    pub train_rms: f64,
    /// Rms error on the samples held out, N.
    pub held_out_rms: f64,
    /// Squared errors of the held-out samples in N^2 by recording, and their number.
    pub by_recording: Vec<(f64, usize)>,
}

/// Train a model on each split, from a fit to everything, and judge it on what was held out.
///
/// Coefficients of the measurement (drift, interference) belong to a recording: those of a held-out one are
/// fitted to it, and the rest of the model is not.
pub(super) fn prove(
    assembly: &Assembly,
    noise: &Noise,
    splits: &[Split],
    fitted: &Fitted,
    monitor: &dyn Monitor,
) -> Proof {
    let count = assembly.campaign().recordings().len();
    let sums: Vec<(Sums, Sums)> = splits
        .par_iter()
        .map(|split| {
            let data = Data { noise, rows: &split.train, monitor };
            let trained = refine(assembly, data, &fitted.unit);
            let point = Point::at(assembly, data, trained.unit);
            let own = own_coefficients(assembly);
            let errors = (0..count).map(|r| {
                let recording = &assembly.campaign().recordings()[r];
                let measured = recording.force().unwrap_or_default();
                let error: Vec<f64> = if own && !split.held_out[r].is_empty() {
                    beside_its_own(assembly, &point, r, measured)
                } else {
                    measured.iter().zip(&point.recordings[r].force).map(|(f, m)| f - m).collect()
                };
                let sum = |rows: &Rows| {
                    let all = rows.iter().flat_map(|range| &error[range.clone()]);
                    let count = rows.iter().map(ExactSizeIterator::len).sum();
                    (all.map(|e| e * e).sum::<f64>(), count)
                };
                // The first samples of a recording are what the noise's memory starts from: no fit counts them.
                let lost = noise.lost(r);
                let fitted = split.train[r].iter().map(|t| t.start.max(lost).min(t.end)..t.end).collect();
                (sum(&fitted), sum(&split.held_out[r]))
            });
            errors.unzip()
        })
        .collect();
    let total = |side: fn(&(Sums, Sums)) -> &Sums| {
        let mut by_recording = vec![(0.0, 0); count];
        for split in &sums {
            for (all, one) in by_recording.iter_mut().zip(side(split)) {
                *all = (all.0 + one.0, all.1 + one.1);
            }
        }
        by_recording
    };
    let rms = |sums: &[(f64, usize)]| {
        let (squares, count) = sums.iter().fold((0.0, 0), |s, one| (s.0 + one.0, s.1 + one.1));
        (squares / count.max(1) as f64).sqrt()
    };
    let by_recording = total(|s| &s.1);
    Proof { train_rms: rms(&total(|s| &s.0)), held_out_rms: rms(&by_recording), by_recording }
}

fn own_coefficients(assembly: &Assembly) -> bool {
    assembly.effects().iter().any(|e| e.of_the_measurement())
}

/// Error of the device on a recording, less what the measurement's own columns explain of it.
fn beside_its_own(assembly: &Assembly, point: &Point, r: usize, measured: &[f64]) -> Vec<f64> {
    let columns = assembly.columns(r, &assembly.physical(&point.fitted.unit));
    let device = assembly.device_coefficients();
    let pairs = point.fitted.coefficients.iter().zip(&device);
    let of_device: Vec<f64> = pairs.map(|(c, own)| if *own { *c } else { 0.0 }).collect();
    let force = columns.measured(&of_device);
    let mut error: Vec<f64> = measured.iter().zip(force).map(|(f, m)| f - m).collect();
    let own: Vec<&Vec<f64>> = columns
        .columns
        .iter()
        .zip(&columns.places)
        .filter(|(_, place)| !device[**place])
        .map(|(column, _)| column)
        .collect();
    let size = |i: usize| dot(own[i], own[i]).sqrt().max(f64::MIN_POSITIVE);
    let gram = nalgebra::DMatrix::from_fn(own.len(), own.len(), |i, j| {
        let ridge = if i == j { 1e-10 } else { 0.0 };
        dot(own[i], own[j]) / (size(i) * size(j)) + ridge
    });
    let right = nalgebra::DVector::from_fn(own.len(), |i, _| dot(own[i], &error) / size(i));
    if let Some(factor) = gram.cholesky() {
        let c = factor.solve(&right);
        for (i, column) in own.iter().enumerate() {
            for (e, value) in error.iter_mut().zip(*column) {
                *e -= c[i] / size(i) * value;
            }
        }
    }
    error
}
