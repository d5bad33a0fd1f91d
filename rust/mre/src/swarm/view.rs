//! What a fish sees: its fellows, their centre and the best of them.

use super::{Crowd, Neighbourhood};

/// Euclidean distance in the unit box.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Food concentration `Y` of a cost: positive, and higher where the cost is lower.
///
/// The crowd test compares ratios, so `Y = -H` cannot serve; for `H >= 0` this is `1 / (1 + H)`.
pub(super) fn food(cost: f64) -> f64 {
    if cost >= 0.0 { 1.0 / (1.0 + cost) } else { 1.0 - cost }
}

/// Positions and costs of a swarm.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) positions: &'a [f64],
    pub(super) costs: &'a [f64],
    pub(super) dimension: usize,
    pub(super) visual: f64,
    pub(super) neighbourhood: Neighbourhood,
}

impl<'a> View<'a> {
    pub(super) fn position(&self, fish: usize) -> &'a [f64] {
        &self.positions[fish * self.dimension..(fish + 1) * self.dimension]
    }

    /// The fellows within the visual range.
    pub(super) fn within_sight(&self, fish: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.costs.len()).filter(move |&other| {
            other != fish && distance(self.position(fish), self.position(other)) < self.visual
        })
    }

    /// Fellows that the crowd test counts.
    pub(super) fn crowd(&self, fish: usize, crowd: Crowd) -> usize {
        if crowd == Crowd::Visual || self.neighbourhood == Neighbourhood::Visual {
            self.within_sight(fish).count()
        } else {
            self.costs.len() - 1
        }
    }

    /// The fish with the most food; the first of equals.
    pub(super) fn best(&self, fish: impl Iterator<Item = usize>) -> Option<usize> {
        fish.reduce(|best, other| if self.costs[best] <= self.costs[other] { best } else { other })
    }

    /// Add the centre of the fellows within sight to the rows; false if there are none.
    pub(super) fn push_centre_within_sight(&self, fish: usize, rows: &mut Vec<f64>) -> bool {
        self.push_mean(self.within_sight(fish), rows)
    }

    /// Add the centre of the whole swarm to the rows.
    pub(super) fn push_centre(&self, rows: &mut Vec<f64>) {
        self.push_mean(0..self.costs.len(), rows);
    }

    fn push_mean(&self, fellows: impl Iterator<Item = usize>, rows: &mut Vec<f64>) -> bool {
        let first = rows.len();
        rows.resize(first + self.dimension, 0.0);
        let mut count = 0.0;
        for fellow in fellows {
            count += 1.0;
            for (sum, x) in rows[first..].iter_mut().zip(self.position(fellow)) {
                *sum += x;
            }
        }
        if count == 0.0 {
            rows.truncate(first);
            return false;
        }
        rows[first..].iter_mut().for_each(|sum| *sum /= count);
        true
    }
}

/// The test `Y_target / n_f > delta Y_i`; without crowd test the target has to be better.
pub(super) fn attracts(target_cost: f64, own_cost: f64, fellows: usize, delta: f64, crowd: Crowd) -> bool {
    let (target, own) = (food(target_cost), food(own_cost));
    match crowd {
        Crowd::None => target > own,
        Crowd::Literal | Crowd::Visual => fellows >= 1 && target / fellows as f64 > delta * own,
    }
}
