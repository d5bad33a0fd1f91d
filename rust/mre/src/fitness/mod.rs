//! Fitness of candidate parameters on recordings: eq. 5 (mean squared error, N^2), of which eq. 9 is
//! the root; over several recordings together, each with its weight.

mod bounds;
mod changed;
mod stream;
mod weights;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
pub use stream::Stream;
pub use weights::Weights;

use crate::error::Result;
use crate::extent::Extent;
use crate::kernel::{BoucWenRk4, LANES, Sinh, SinhCompressed};
use crate::law::Law;
use crate::model::Model;
use crate::parameter::{Bounds, Parameter};
use crate::recording::Recording;

/// Recordings, a model, and the box of its parameters.
#[derive(Debug)]
pub struct Problem {
    recordings: Vec<Arc<Recording>>,
    model: Model,
    law: Law,
    parameters: Vec<Parameter>,
    bounds: Bounds,
    weights: Vec<f64>,
    /// Shared by problems on the same samples.
    kernel: Arc<Kernel>,
}

#[derive(Debug)]
enum Kernel {
    Sinh(Box<Sinh>),
    BoucWen(Vec<BoucWenRk4>),
    /// Any model, term by term.
    Terms,
}

impl Kernel {
    fn new(
        recordings: &[Arc<Recording>],
        model: &Model,
        law: &Law,
        bounds: &Bounds,
        weights: &[f64],
    ) -> Self {
        match (model.name(), law) {
            ("sinh", Law::Shared) => {
                let largest_beta = bounds.lower()[3].abs().max(bounds.upper()[3].abs());
                Self::Sinh(Box::new(Sinh::new(recordings, weights, largest_beta)))
            }
            ("bouc_wen", Law::Shared) => {
                Self::BoucWen(recordings.iter().cloned().map(BoucWenRk4::new).collect())
            }
            _ => Self::Terms,
        }
    }
}

impl Problem {
    /// A problem with the default box, in which named parameters have other bounds.
    ///
    /// All recordings share the parameters, whatever their current, unless the current changes within
    /// one of them: then the coefficients are affine in the current.
    ///
    /// # Errors
    /// No recording, a recording without force or with less motion than the model needs, an unknown
    /// parameter, bounds that are reversed, not admissible or so wide that sinh overflows, or weights
    /// that are not positive.
    pub fn new(
        recordings: Vec<Arc<Recording>>,
        model: Model,
        bounds: &[(String, f64, f64)],
        weights: &Weights,
    ) -> Result<Self> {
        let extent = Extent::of(&recordings)?;
        let law = Law::of(&recordings, &model)?;
        let mut parameters = law.parameters(&model, &extent);
        let bounds = bounds::choose(&mut parameters, bounds, extent.displacement)?;
        let weights = weights.scaled(&recordings)?;
        let kernel = Arc::new(Kernel::new(&recordings, &model, &law, &bounds, &weights));
        Ok(Self { recordings, model, law, parameters, bounds, weights, kernel })
    }

    /// The recordings; none where the samples were streamed.
    pub fn recordings(&self) -> &[Arc<Recording>] {
        &self.recordings
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// How the parameters depend on the current.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Parameters with the bounds in force.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Weight of the sum of squares of each recording; the fitness is the weighted sum.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The box.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Number of samples that count.
    pub fn samples(&self) -> usize {
        match &*self.kernel {
            Kernel::Sinh(kernel) => kernel.samples(),
            _ => self.recordings.iter().map(|r| r.scored().len()).sum(),
        }
    }

    /// The samples as a triangular factor, where the model and the box allow one.
    pub(crate) fn compressed(&self) -> Option<&SinhCompressed> {
        if let Kernel::Sinh(kernel) = &*self.kernel { kernel.compressed() } else { None }
    }

    /// True where so few candidates are evaluated on the calling thread alone, outside any thread pool: the
    /// work is not worth sharing.
    pub fn on_one_thread(&self, candidates: usize) -> bool {
        match &*self.kernel {
            Kernel::Sinh(kernel) => candidates < 2 * kernel.grain(),
            Kernel::BoucWen(_) => candidates <= LANES,
            Kernel::Terms => candidates < 2 * self.grain_of_terms(),
        }
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
            if cancel.load(Ordering::Relaxed) {
                return [f64::NAN; LANES];
            }
            let rows: [&[f64]; LANES] = std::array::from_fn(|l| row(block[l.min(block.len() - 1)]));
            let mut sums = [0.0; LANES];
            for (kernel, weight) in kernels.iter().zip(&self.weights) {
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
