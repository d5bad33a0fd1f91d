//! Points that fish want to know the costs of.

use super::random::around;
use super::search::Wait;
use super::seen::Seen;
use super::view::View;
use super::{Shared, Stream};

/// Rows of the unit box, and fish that wait for the costs of theirs, one fish after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct Batch {
    /// Rows in use, and room for more: what was there is written over, not cleared.
    buffer: Vec<f64>,
    used: usize,
    waiting: Vec<(usize, Wait)>,
    /// Of each fish that waits, once its rows are evaluated.
    seen: Vec<Seen>,
    dimension: usize,
    /// False while the rows of looks are still to be filled in.
    drawn: bool,
}

impl Batch {
    /// An empty batch with room, so that iterations do not allocate.
    pub(super) fn with_room(fish: usize, rows: usize, dimension: usize) -> Self {
        Self {
            buffer: Vec::with_capacity(rows * dimension),
            used: 0,
            waiting: Vec::with_capacity(fish),
            seen: Vec::with_capacity(fish),
            dimension,
            drawn: true,
        }
    }

    pub(super) fn clear(&mut self) {
        self.used = 0;
        self.waiting.clear();
        self.seen.clear();
        self.drawn = true;
    }

    /// True if no fish waits.
    pub(super) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Number of rows.
    pub(super) fn count(&self) -> usize {
        self.used / self.dimension
    }

    /// The rows; those of looks once they are drawn.
    pub(super) fn rows(&self) -> &[f64] {
        &self.buffer[..self.used]
    }

    /// Add rows that no fish waits for.
    pub(super) fn extend(&mut self, rows: &[f64]) {
        self.room_for(rows.len()).copy_from_slice(rows);
    }

    /// Add a fish, with a higher number than those before; the row of an arrival is still to be filled in.
    pub(super) fn add(&mut self, fish: usize, wait: Wait) -> &mut [f64] {
        self.waiting.push((fish, wait));
        self.drawn &= wait == Wait::Arrival;
        self.room_for(wait.rows() * self.dimension)
    }

    fn room_for(&mut self, numbers: usize) -> &mut [f64] {
        let first = self.used;
        self.used += numbers;
        if self.buffer.len() < self.used {
            self.buffer.resize(self.used, 0.0);
        }
        &mut self.buffer[first..self.used]
    }

    /// See what the costs of all rows come to, fish by fish, if that was not seen when they were evaluated.
    pub(super) fn see(&mut self, mut costs: &[f64]) {
        if self.seen.len() < self.waiting.len() {
            self.seen.clear();
            self.seen.extend(self.waiting.iter().map(|(_, wait)| {
                let own;
                (own, costs) = costs.split_at(wait.rows());
                Seen::of(own)
            }));
        }
    }

    /// Forget what was seen, where it was broken off.
    pub(super) fn forget(&mut self) {
        self.seen.clear();
    }

    /// The fish, what they wait for, their rows and what was seen there.
    pub(super) fn with_what_was_seen(&self) -> impl Iterator<Item = (usize, Wait, &[f64], &Seen)> {
        let mut rows = self.rows();
        self.waiting.iter().zip(&self.seen).map(move |(&(fish, wait), seen)| {
            let own;
            (own, rows) = rows.split_at(wait.rows() * self.dimension);
            (fish, wait, own, seen)
        })
    }

    /// Draw the looks that are not drawn yet.
    pub(super) fn draw(&mut self, view: &View, streams: &mut [Stream]) {
        if !std::mem::replace(&mut self.drawn, true) {
            self.all(streams, &mut []).draw(view);
        }
    }

    /// The same, the costs of all rows and what they come to, in shares on the current thread pool. Every fish
    /// draws from its own stream, so that it does not matter who draws first.
    pub(super) fn evaluate(
        &mut self,
        view: &View,
        streams: &mut [Stream],
        fitness: &dyn Shared,
        costs: &mut [f64],
    ) {
        if std::mem::replace(&mut self.drawn, true) {
            self.forget();
            fitness.costs(self.rows(), costs);
            return;
        }
        self.seen.resize(self.waiting.len(), Seen::NOTHING);
        self.all(streams, costs).evaluate(view, fitness);
    }

    fn all<'a>(&'a mut self, streams: &'a mut [Stream], costs: &'a mut [f64]) -> Share<'a> {
        let (rows, seen) = (&mut self.buffer[..self.used], &mut self.seen);
        Share { waiting: &self.waiting, first: 0, streams, rows, costs, seen }
    }
}

/// Some of the fish that wait, with what is theirs.
struct Share<'a> {
    waiting: &'a [(usize, Wait)],
    /// Fish of the first stream.
    first: usize,
    streams: &'a mut [Stream],
    rows: &'a mut [f64],
    costs: &'a mut [f64],
    seen: &'a mut [Seen],
}

impl Share<'_> {
    fn draw(&mut self, view: &View) {
        let mut rows = &mut *self.rows;
        for &(fish, wait) in self.waiting {
            let own;
            (own, rows) = rows.split_at_mut(wait.rows() * view.dimension);
            if let Wait::Looks { .. } = wait {
                around(view.position(fish), view.visual, &mut self.streams[fish - self.first], own);
            }
        }
    }

    fn evaluate(mut self, view: &View, fitness: &dyn Shared) {
        // Smaller shares than a grain: the thread that is done first finds one left.
        // Outside a pool rayon would start its global one, which does not survive a fork.
        let worthwhile = self.costs.len() >= fitness.grain() && rayon::current_thread_index().is_some();
        if self.waiting.len() > 1 && worthwhile {
            let (left, right) = self.halves(view.dimension);
            rayon::join(|| left.evaluate(view, fitness), || right.evaluate(view, fitness));
            return;
        }
        self.draw(view);
        fitness.costs(self.rows, self.costs);
        let mut costs = &*self.costs;
        for ((_, wait), seen) in self.waiting.iter().zip(self.seen) {
            let own;
            (own, costs) = costs.split_at(wait.rows());
            *seen = Seen::of(own);
        }
    }

    /// Cut in two with about as many rows, each with all of its fish.
    fn halves(&mut self, dimension: usize) -> (Share<'_>, Share<'_>) {
        let (half, last) = (self.costs.len() / 2, self.waiting.len() - 1);
        let (mut fish, mut count) = (0, 0);
        while fish == 0 || (fish < last && count < half) {
            count += self.waiting[fish].1.rows();
            fish += 1;
        }
        let (waiting, others) = self.waiting.split_at(fish);
        let middle = others[0].0;
        let (streams, other_streams) = self.streams.split_at_mut(middle - self.first);
        let (rows, other_rows) = self.rows.split_at_mut(count * dimension);
        let (costs, other_costs) = self.costs.split_at_mut(count);
        let (seen, other_seen) = self.seen.split_at_mut(fish);
        (
            Share { waiting, first: self.first, streams, rows, costs, seen },
            Share {
                waiting: others,
                first: middle,
                streams: other_streams,
                rows: other_rows,
                costs: other_costs,
                seen: other_seen,
            },
        )
    }
}
