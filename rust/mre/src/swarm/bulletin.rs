//! The bulletin board: the best point ever evaluated, and the history of an optimisation.

use super::seen::Seen;

/// The best point ever told, and how many were told.
#[derive(Debug, Clone, PartialEq)]
pub struct Bulletin {
    /// Best point in the unit box; the first one while no finite cost was told.
    pub position: Vec<f64>,
    /// Its cost; infinite while no finite cost was told.
    pub cost: f64,
    /// Points told.
    pub evaluations: u64,
    /// Points that cost infinity.
    pub failures: u64,
}

impl Bulletin {
    pub(super) fn new(dimension: usize) -> Self {
        Self { position: vec![0.5; dimension], cost: f64::INFINITY, evaluations: 0, failures: 0 }
    }

    /// Note points and their costs; the first of equals stays. NaN marks a point that was not evaluated.
    pub(super) fn note(&mut self, points: &[f64], costs: &[f64]) {
        let seen = Seen::of(costs);
        if self.evaluations == 0
            && let Some(first) = costs.iter().position(|cost| !cost.is_nan())
        {
            self.stand(points, first);
        }
        self.evaluations += costs.len() as u64 - u64::from(seen.unknown);
        self.failures += u64::from(seen.infinite);
        self.better(points, &seen);
    }

    /// Note the points of one fish, of which those without a cost count as infinite.
    pub(super) fn note_seen(&mut self, points: &[f64], seen: &Seen) {
        self.evaluations += (points.len() / self.position.len()) as u64;
        self.failures += u64::from(seen.infinite + seen.unknown);
        self.better(points, seen);
    }

    fn better(&mut self, points: &[f64], seen: &Seen) {
        if seen.least < self.cost {
            self.stand(points, seen.at);
            self.cost = seen.least;
        }
    }

    fn stand(&mut self, points: &[f64], at: usize) {
        let d = self.position.len();
        self.position.copy_from_slice(&points[at * d..(at + 1) * d]);
    }
}

/// One entry an iteration, the initial swarm first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// Best cost so far.
    pub best: Vec<f64>,
    /// Mean cost of the swarm where it stands, over its finite costs.
    pub mean: Vec<f64>,
    /// Evaluations so far.
    pub evaluations: Vec<u64>,
    /// Visual range of the fish; inertia weight of the particles.
    pub range: Vec<f64>,
    /// Step of the fish; largest speed of the particles.
    pub step: Vec<f64>,
}

impl History {
    /// Room for the swarm as it starts and so many iterations.
    pub(super) fn with_room(iterations: usize) -> Self {
        let room = iterations + 1;
        Self {
            best: Vec::with_capacity(room),
            mean: Vec::with_capacity(room),
            evaluations: Vec::with_capacity(room),
            range: Vec::with_capacity(room),
            step: Vec::with_capacity(room),
        }
    }

    pub(super) fn record(&mut self, bulletin: &Bulletin, costs: &[f64], range: f64, step: f64) {
        let (sum, count) =
            costs.iter().filter(|c| c.is_finite()).fold((0.0, 0_u32), |(sum, count), c| (sum + c, count + 1));
        self.best.push(bulletin.cost);
        self.mean.push(if count > 0 { sum / f64::from(count) } else { f64::INFINITY });
        self.evaluations.push(bulletin.evaluations);
        self.range.push(range);
        self.step.push(step);
    }
}
