//! The sinh kernel of a problem: compressed where possible, sample by sample elsewhere.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use rayon::prelude::*;

use super::sinh_compressed::{LANES, SinhCompressed};
use super::sinh_direct::SinhDirect;
use crate::fitness::finite_or_infinite;
use crate::recording::Recording;

/// Numbers of a candidate.
const WIDTH: usize = 5;
/// Fewer samples than this for every column of the factor: the direct kernel is as fast.
const WORTHWHILE: usize = 4;
/// Candidates that are worked on together.
const PART: usize = 8 * LANES;
/// Candidates of the compressed kernel that keep a thread busy for longer than it takes to hand them over.
const GRAIN: usize = 256;

/// Recordings made ready for evaluations.
#[derive(Debug)]
pub(crate) struct Sinh {
    recordings: Vec<Arc<Recording>>,
    weights: Vec<f64>,
    /// Packed samples, once a candidate needs them.
    direct: OnceLock<Vec<SinhDirect>>,
    compressed: Option<SinhCompressed>,
    samples: usize,
}

impl Sinh {
    /// Prepare recordings with a force, for candidates with beta up to `largest_beta`. Others are
    /// evaluated too, but slowly.
    pub(crate) fn new(recordings: &[Arc<Recording>], weights: &[f64], largest_beta: f64) -> Self {
        let samples = recordings.iter().map(|r| r.scored().len()).sum();
        Self {
            recordings: recordings.to_vec(),
            weights: weights.to_vec(),
            direct: OnceLock::new(),
            compressed: SinhCompressed::new(recordings, weights, largest_beta)
                .filter(|c| samples >= WORTHWHILE * c.triangle().columns()),
            samples,
        }
    }

    /// From samples that are not kept; candidates with a larger beta cost infinity.
    pub(crate) fn streamed(compressed: SinhCompressed, samples: usize) -> Self {
        Self {
            recordings: Vec::new(),
            weights: Vec::new(),
            direct: OnceLock::new(),
            compressed: Some(compressed),
            samples,
        }
    }

    /// Number of samples.
    pub(crate) fn samples(&self) -> usize {
        self.samples
    }

    /// Weighted sums of squares of candidates, in parallel. `place` fills `[c0, k0, alpha, beta, F0]` of
    /// some candidates from their rows. After `cancel` is set, NaN stands for those that were not evaluated.
    pub(crate) fn sums_of_squares(
        &self,
        rows: &[f64],
        place: impl Fn(&mut [f64], &[f64]) + Sync,
        out: &mut [f64],
        cancel: &AtomicBool,
    ) {
        let some = |(rows, out): (&[f64], &mut [f64])| {
            if cancel.load(Ordering::Relaxed) {
                out.fill(f64::NAN);
                return;
            }
            let mut candidates = [0.0; WIDTH * PART];
            let candidates = &mut candidates[..rows.len()];
            place(candidates, rows);
            self.some(candidates, out);
        };
        let part = if self.compressed.is_some() { PART } else { 1 };
        let grain = self.grain();
        if out.len() < 2 * grain {
            rows.chunks(part * WIDTH).zip(out.chunks_mut(part)).for_each(some);
        } else {
            rows.par_chunks(part * WIDTH)
                .zip(out.par_chunks_mut(part))
                .with_min_len((grain / part).max(1))
                .for_each(some);
        }
    }

    /// Candidates that keep a thread busy for longer than it takes to hand them over.
    pub(crate) fn grain(&self) -> usize {
        if self.compressed.is_some() { GRAIN } else { (100 * GRAIN / self.samples).max(1) }
    }

    fn some(&self, rows: &[f64], out: &mut [f64]) {
        if let Some(compressed) = &self.compressed {
            for (rows, out) in rows.chunks(LANES * WIDTH).zip(out.chunks_mut(LANES)) {
                compressed.sums_of_squares(rows, out);
            }
        }
        for (row, out) in rows.chunks_exact(WIDTH).zip(out) {
            if !self.compressed.as_ref().is_some_and(|c| c.holds(row)) {
                *out = self.direct(row);
            }
            *out = finite_or_infinite(*out);
        }
    }

    fn direct(&self, row: &[f64]) -> f64 {
        if self.recordings.is_empty() {
            return f64::INFINITY;
        }
        let direct = self.direct.get_or_init(|| self.recordings.iter().map(|r| SinhDirect::new(r)).collect());
        direct.iter().zip(&self.weights).map(|(k, w)| w * k.sum_of_squares(row)).sum()
    }

    /// The compressed samples, if they are.
    pub(crate) fn compressed(&self) -> Option<&SinhCompressed> {
        self.compressed.as_ref()
    }
}
