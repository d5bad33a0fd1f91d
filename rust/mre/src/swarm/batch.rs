//! Points that fish want to know the costs of.

use super::Stream;
use super::random::around;
use super::search::Wait;
use super::view::View;

/// Fewer random numbers than this are drawn before another thread has woken up.
const GRAIN: usize = 1024;

/// Fish that wait for costs, and their rows of the unit box, one fish after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct Batch {
    pub(super) rows: Vec<f64>,
    waiting: Vec<(usize, Wait)>,
    dimension: usize,
}

impl Batch {
    /// An empty batch with room, so that iterations do not allocate.
    pub(super) fn with_room(fish: usize, rows: usize, dimension: usize) -> Self {
        Self { rows: Vec::with_capacity(rows * dimension), waiting: Vec::with_capacity(fish), dimension }
    }

    pub(super) fn clear(&mut self) {
        self.rows.clear();
        self.waiting.clear();
    }

    /// True if no fish waits.
    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Add a fish, with a higher number than those before; its rows are still to be filled in.
    pub(super) fn add(&mut self, fish: usize, wait: Wait) -> &mut [f64] {
        self.waiting.push((fish, wait));
        let first = self.rows.len();
        self.rows.resize(first + wait.rows() * self.dimension, 0.0);
        &mut self.rows[first..]
    }

    /// The fish, what they wait for, their rows and the costs of these.
    pub(super) fn with_costs<'a>(
        &'a self,
        mut costs: &'a [f64],
    ) -> impl Iterator<Item = (usize, Wait, &'a [f64], &'a [f64])> {
        let mut rows = self.rows.as_slice();
        self.waiting.iter().map(move |&(fish, wait)| {
            let (own_rows, own_costs);
            (own_rows, rows) = rows.split_at(wait.rows() * self.dimension);
            (own_costs, costs) = costs.split_at(wait.rows());
            (fish, wait, own_rows, own_costs)
        })
    }

    /// Fill in the looks, in parallel on the current thread pool. Every fish draws from its own stream, so
    /// that it does not matter who draws first.
    pub(super) fn draw_looks(&mut self, view: &View, streams: &mut [Stream]) {
        draw(view, &self.waiting, (0, streams), &mut self.rows);
    }
}

/// `streams` are those of the fish from `first` on.
fn draw(view: &View, waiting: &[(usize, Wait)], (first, streams): (usize, &mut [Stream]), rows: &mut [f64]) {
    let d = view.dimension;
    // Outside a pool rayon would start its global one, which does not survive a fork.
    let worthwhile = rows.len() >= 2 * GRAIN && rayon::current_thread_index().is_some();
    if waiting.len() > 1 && worthwhile {
        let (left, right) = waiting.split_at(waiting.len() / 2);
        let middle = right[0].0;
        let (streams, other_streams) = streams.split_at_mut(middle - first);
        let count: usize = left.iter().map(|(_, wait)| wait.rows()).sum();
        let (rows, other_rows) = rows.split_at_mut(count * d);
        rayon::join(
            || draw(view, left, (first, streams), rows),
            || draw(view, right, (middle, other_streams), other_rows),
        );
        return;
    }
    let mut rows = rows;
    for &(fish, wait) in waiting {
        let own;
        (own, rows) = rows.split_at_mut(wait.rows() * d);
        if let Wait::Looks { .. } = wait {
            around(view.position(fish), view.visual, &mut streams[fish - first], own);
        }
    }
}
