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

    fn within_sight(&self, fish: usize) -> impl Iterator<Item = usize> + '_ {
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

    /// The fellow with the most food.
    pub(super) fn best(&self, fish: usize) -> Option<usize> {
        let better = |best: Option<usize>, other: usize| match best {
            Some(b) if self.costs[b] <= self.costs[other] => best,
            _ => Some(other),
        };
        match self.neighbourhood {
            Neighbourhood::Swarm => (0..self.costs.len()).filter(|&other| other != fish).fold(None, better),
            Neighbourhood::Visual => self.within_sight(fish).fold(None, better),
        }
    }

    /// Centre of the fellows within sight, if there are any.
    pub(super) fn centre_within_sight(&self, fish: usize) -> Option<Vec<f64>> {
        let mut centre = vec![0.0; self.dimension];
        let mut count = 0.0;
        for other in self.within_sight(fish) {
            count += 1.0;
            for (sum, x) in centre.iter_mut().zip(self.position(other)) {
                *sum += x;
            }
        }
        (count > 0.0).then(|| centre.iter().map(|sum| sum / count).collect())
    }

    /// Centre of the whole swarm.
    pub(super) fn centre(&self) -> Vec<f64> {
        let mut centre = vec![0.0; self.dimension];
        for position in self.positions.chunks_exact(self.dimension) {
            for (sum, x) in centre.iter_mut().zip(position) {
                *sum += x;
            }
        }
        centre.iter().map(|sum| sum / self.costs.len() as f64).collect()
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
