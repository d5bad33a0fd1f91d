//! What a swarm minimises.

use std::sync::atomic::AtomicBool;

use crate::fitness::Problem;

/// Costs of points of the unit box, one row each.
pub trait Fitness {
    /// Fill in the costs; NaN for points that were left out because it was broken off.
    fn costs(&mut self, rows: &[f64], costs: &mut [f64]);

    /// The same function for any thread, where points gain nothing from being evaluated together.
    fn shared(&self) -> Option<&dyn Shared> {
        None
    }
}

/// Costs that any thread may ask for.
pub trait Shared: Sync {
    /// As [`Fitness::costs`].
    fn costs(&self, rows: &[f64], costs: &mut [f64]);

    /// Points that keep a thread busy for longer than it takes to hand them over.
    fn grain(&self) -> usize;
}

impl<F: FnMut(&[f64], &mut [f64])> Fitness for F {
    fn costs(&mut self, rows: &[f64], costs: &mut [f64]) {
        self(rows, costs);
    }
}

/// The fitness of a problem, eq. 5, until it is cancelled.
#[derive(Debug, Clone, Copy)]
pub struct OfProblem<'a> {
    /// Recordings, model and box.
    pub problem: &'a Problem,
    /// Set to break off.
    pub cancel: &'a AtomicBool,
}

impl Fitness for OfProblem<'_> {
    fn costs(&mut self, rows: &[f64], costs: &mut [f64]) {
        Shared::costs(self, rows, costs);
    }

    fn shared(&self) -> Option<&dyn Shared> {
        if self.problem.side_by_side() { None } else { Some(self) }
    }
}

impl Shared for OfProblem<'_> {
    fn costs(&self, rows: &[f64], costs: &mut [f64]) {
        self.problem.fitness_in_box(rows, costs, self.cancel);
    }

    fn grain(&self) -> usize {
        self.problem.grain()
    }
}
