//! The loop of ask, evaluate, tell, with budgets and a monitor.

use std::time::{Duration, Instant};

use super::{Fitness, Swarm};
use crate::error::{Error, Result};

/// When to stop before the last iteration.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Budget {
    /// Most evaluations; kept to the last one.
    pub evaluations: Option<u64>,
    /// Most time; checked between generations.
    pub time: Option<Duration>,
    /// Cost that is good enough.
    pub target: Option<f64>,
}

impl Budget {
    /// Check the limits.
    ///
    /// # Errors
    /// A budget of nothing, or a target that is not a number.
    pub fn check(&self) -> Result<()> {
        if self.evaluations == Some(0) {
            return Err(Error::setting("max_evaluations", 0, "a whole number of at least 1"));
        }
        if self.time == Some(Duration::ZERO) {
            return Err(Error::setting("time_limit", 0, "a number of seconds above 0"));
        }
        match self.target {
            Some(target) if target.is_nan() => Err(Error::setting("target", target, "a number")),
            _ => Ok(()),
        }
    }
}

/// Why an optimisation stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StopReason {
    /// All iterations are done.
    Iterations,
    /// The budget of evaluations is used up.
    Evaluations,
    /// The time is used up.
    Time,
    /// The target is reached.
    Target,
    /// The monitor asked to stop.
    Interrupted,
}

/// Where an optimisation stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// Iterations finished.
    pub iteration: usize,
    /// Points evaluated.
    pub evaluations: u64,
    /// Best cost so far.
    pub best: f64,
}

/// Watches an optimisation between generations.
pub trait Monitor {
    /// True when the costs of the generation at hand are not to be used: it was broken off.
    fn broken_off(&self) -> bool {
        false
    }

    /// Told after every generation; false to stop.
    fn go_on(&mut self, progress: Progress) -> bool;
}

impl<F: FnMut(Progress) -> bool> Monitor for F {
    fn go_on(&mut self, progress: Progress) -> bool {
        self(progress)
    }
}

/// Drive a swarm to its end or to the end of a budget.
pub fn run(
    swarm: &mut dyn Swarm,
    fitness: &mut dyn Fitness,
    dimension: usize,
    budget: &Budget,
    monitor: &mut dyn Monitor,
) -> StopReason {
    let started = Instant::now();
    let mut room = Vec::new();
    while !swarm.finished() {
        let wanted = swarm.asked();
        let left =
            budget.evaluations.map_or(u64::MAX, |most| most.saturating_sub(swarm.bulletin().evaluations));
        let count = wanted.min(usize::try_from(left).unwrap_or(usize::MAX));
        if count == 0 {
            return StopReason::Evaluations;
        }
        if room.len() < count {
            room.resize(count.next_power_of_two(), f64::NAN); // generations differ a little in size
        }
        let costs = &mut room[..count];
        match fitness.shared() {
            Some(shared) if count == wanted => swarm.ask_and_evaluate(shared, costs),
            _ => fitness.costs(&swarm.ask()[..count * dimension], costs),
        }
        let broken_off = monitor.broken_off();
        if broken_off || count < wanted {
            swarm.tell_some(costs);
        } else {
            swarm.tell(costs);
        }
        let go_on = monitor.go_on(progress(swarm));
        if broken_off || !go_on {
            return StopReason::Interrupted;
        }
        if budget.target.is_some_and(|target| swarm.bulletin().cost <= target) {
            return StopReason::Target;
        }
        if count < wanted {
            return StopReason::Evaluations;
        }
        if budget.time.is_some_and(|most| started.elapsed() >= most) {
            return StopReason::Time;
        }
    }
    StopReason::Iterations
}

fn progress(swarm: &dyn Swarm) -> Progress {
    let bulletin = swarm.bulletin();
    Progress {
        iteration: swarm.history().best.len().saturating_sub(1),
        evaluations: bulletin.evaluations,
        best: bulletin.cost,
    }
}
