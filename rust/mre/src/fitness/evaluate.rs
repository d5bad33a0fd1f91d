//! The fitness of many candidates, shared among threads where that is worth it.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::{Kernel, Problem};
use crate::kernel::{BoucWenRk4, LANES};

impl Problem {
    /// True where so few candidates are evaluated on the calling thread alone, outside any thread pool: the
    /// work is not worth sharing.
    pub fn on_one_thread(&self, candidates: usize) -> bool {
        if self.side_by_side() { candidates <= LANES } else { candidates < 2 * self.grain() }
    }

    /// Candidates that keep a thread busy for longer than it takes to hand them over.
    pub(crate) fn grain(&self) -> usize {
        match &*self.kernel {
            Kernel::Sinh(kernel) => kernel.grain(),
            Kernel::BoucWen(_) => LANES,
            Kernel::Terms => self.grain_of_terms(),
        }
    }

    /// True where alike candidates are evaluated side by side, so that many at once take less time.
    pub(crate) fn side_by_side(&self) -> bool {
        matches!(&*self.kernel, Kernel::BoucWen(_))
    }

    /// Fitness in N^2 of candidates, one row each, in parallel on the current thread pool where there are
    /// many.
    ///
    /// A candidate that cannot be simulated costs infinity, as does one with a beta outside the box where
    /// the samples were streamed. After `cancel` is set, NaN stands for those that were not evaluated. The
    /// values do not depend on the number of threads or on the other candidates.
    pub fn fitness(&self, rows: &[f64], out: &mut [f64], cancel: &AtomicBool) {
        match &*self.kernel {
            Kernel::BoucWen(kernels) => self.by_blocks(kernels, rows, out, cancel),
            Kernel::Sinh(kernel) => kernel.sums_of_squares(rows, <[f64]>::copy_from_slice, out, cancel),
            Kernel::Terms => self.one_by_one(rows, out, cancel),
        }
    }

    /// [`Problem::fitness`] of points of the unit box.
    pub fn fitness_in_box(&self, unit: &[f64], out: &mut [f64], cancel: &AtomicBool) {
        let place = |to: &mut [f64], unit: &[f64]| self.bounds.to_physical(unit, to);
        if let Kernel::Sinh(kernel) = &*self.kernel {
            kernel.sums_of_squares(unit, place, out, cancel);
        } else {
            let mut rows = vec![0.0; unit.len()];
            place(&mut rows, unit);
            self.fitness(&rows, out, cancel);
        }
    }

    /// Candidates that keep a thread busy for a millisecond or so.
    fn grain_of_terms(&self) -> usize {
        let samples: usize = self.recordings.iter().map(|r| r.len()).sum();
        (100_000 / samples).max(1)
    }

    fn one_by_one(&self, rows: &[f64], out: &mut [f64], cancel: &AtomicBool) {
        let d = self.parameters.len();
        let one = |scratch: &mut Scratch, (row, out): (&[f64], &mut f64)| {
            *out = if cancel.load(Ordering::Relaxed) {
                f64::NAN
            } else {
                finite_or_infinite(self.term_by_term(scratch, row))
            };
        };
        if self.on_one_thread(out.len()) {
            let mut scratch = Scratch::default();
            rows.chunks(d).zip(out).for_each(|pair| one(&mut scratch, pair));
        } else {
            let pairs = rows.par_chunks(d).zip(out.par_iter_mut());
            pairs.with_min_len(self.grain_of_terms()).for_each_init(Scratch::default, one);
        }
    }

    fn by_blocks(&self, kernels: &[BoucWenRk4], rows: &[f64], out: &mut [f64], cancel: &AtomicBool) {
        let d = self.parameters.len();
        let row = |i: usize| &rows[i * d..(i + 1) * d];
        let one = |block: &[usize]| {
            let mut total = [0.0; LANES];
            let rows: [&[f64]; LANES] = std::array::from_fn(|l| row(block[l.min(block.len() - 1)]));
            let mut sums = [0.0; LANES];
            for (kernel, weight) in kernels.iter().zip(&self.weights) {
                if cancel.load(Ordering::Relaxed) {
                    return [f64::NAN; LANES];
                }
                kernel.sums_of_squares(&rows[..block.len()], &mut sums[..block.len()]);
                for (total, sum) in total.iter_mut().zip(&sums) {
                    *total += weight * sum;
                }
            }
            total.map(finite_or_infinite)
        };
        let mut order: Vec<usize> = (0..out.len()).collect();
        // Alike candidates side by side: a block takes as long as its stiffest lane. The stiffest first,
        // block by block, so that no thread is left with all of them.
        order.sort_by(|a, b| BoucWenRk4::cost(row(*b)).total_cmp(&BoucWenRk4::cost(row(*a))));
        let costs: Vec<[f64; LANES]> = if self.on_one_thread(out.len()) {
            order.chunks(LANES).map(one).collect()
        } else {
            order.par_chunks(LANES).with_max_len(1).map(one).collect()
        };
        for (k, i) in order.into_iter().enumerate() {
            out[i] = costs[k / LANES][k % LANES];
        }
    }

    fn term_by_term(&self, scratch: &mut Scratch, row: &[f64]) -> f64 {
        let mut total = 0.0;
        for (recording, weight) in self.recordings.iter().zip(&self.weights) {
            scratch.resize(recording.len());
            self.law.add_force(&self.model, recording, row, scratch);
            let force = recording.force().unwrap_or_default();
            let errors = recording.scored().map(|i| (force[i] - scratch.force[i]).powi(2));
            total += weight * errors.sum::<f64>();
        }
        total
    }
}

/// Buffers of one thread.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Force of the candidate, N.
    pub force: Vec<f64>,
    /// Column of one term.
    pub column: Vec<f64>,
}

impl Scratch {
    /// Zero force over `n` samples.
    pub fn resize(&mut self, n: usize) {
        self.force.clear();
        self.force.resize(n, 0.0);
        self.column.resize(n, 0.0);
    }
}

/// A candidate that cannot be simulated costs infinity.
pub(crate) fn finite_or_infinite(cost: f64) -> f64 {
    if cost.is_nan() { f64::INFINITY } else { cost }
}
