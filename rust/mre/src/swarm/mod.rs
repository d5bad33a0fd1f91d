//! Swarms on the unit box, driven by ask and tell.
//!
//! A swarm says which points it wants to know (`ask`), is told their costs (`tell`), and moves. All
//! fish act at once on the state before them, so that a whole generation can be evaluated in parallel
//! and the result does not depend on the order of the fish. Every fish draws from its own stream of
//! random numbers: same seed, same bits, for any number of threads.

mod awake;
mod batch;
mod bulletin;
mod fish;
mod fitness;
mod follow;
mod pso;
mod random;
mod run;
mod schedule;
mod search;
mod seen;
mod settings;
mod swarming;
mod view;

pub use awake::awake;
pub use bulletin::{Bulletin, History};
pub use fish::FishSwarm;
pub use fitness::{Fitness, OfProblem, Shared};
pub use pso::ParticleSwarm;
pub use random::Stream;
pub use run::{Budget, Monitor, Progress, StopReason, run};
pub use schedule::{Schedule, inertia_weight};
pub use settings::{Crowd, FishSettings, Neighbourhood, PsoSettings, Search};

/// How often each behaviour of the fish decided where a fish went.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Behaviours {
    /// Moves by the searching behaviour.
    pub search: u64,
    /// Moves by the swarming behaviour.
    pub swarm: u64,
    /// Moves by the following behaviour.
    pub follow: u64,
    /// Moves by the random behaviour.
    pub random: u64,
}

/// A swarm that asks for costs and is told them.
pub trait Swarm: Send {
    /// Number of points whose costs are wanted.
    fn asked(&self) -> usize;

    /// Points of the unit box whose costs are wanted, one row each; the same until told.
    fn ask(&mut self) -> &[f64];

    /// [`Swarm::ask`], and the costs of all the points, which are to be told next.
    fn ask_and_evaluate(&mut self, fitness: &dyn Shared, costs: &mut [f64]) {
        fitness.costs(self.ask(), costs);
    }

    /// Costs of all points asked for, in their order; NaN counts as infinite.
    fn tell(&mut self, costs: &[f64]);

    /// Costs of the first points asked for, when a budget forbids the others: only the bulletin learns.
    /// NaN stands for a point that was not evaluated.
    fn tell_some(&mut self, costs: &[f64]);

    /// True after the last iteration: nothing more is asked.
    fn finished(&self) -> bool;

    /// The best point ever told.
    fn bulletin(&self) -> &Bulletin;

    /// What happened in each iteration.
    fn history(&self) -> &History;

    /// How often each behaviour acted; zero for swarms that are no fish.
    fn behaviours(&self) -> Behaviours {
        Behaviours::default()
    }
}
