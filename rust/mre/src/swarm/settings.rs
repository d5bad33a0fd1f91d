//! Settings of the swarms, checked once.

use super::Schedule;
use crate::error::{Error, Result};

/// Whom a fish looks at when it swarms and follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Neighbourhood {
    /// The whole swarm (MAFSA, section 3.2.2 of the paper).
    Swarm,
    /// Its fellows within the visual range (AFSA, section 3.1).
    Visual,
}

/// How the crowd test counts the fellows, `n_f` in `Y_target / n_f > delta Y_i`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crowd {
    /// All fellows that swarming and following look at; in the whole swarm `n_f = N - 1`.
    Literal,
    /// Those within the visual range, even where the whole swarm is looked at.
    Visual,
    /// No crowd test: the target only has to be better.
    None,
}

/// Where a searching fish goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Search {
    /// To the best of all looks (MAFSA).
    Best,
    /// A step towards the first look that is better (AFSA).
    Step,
}

/// Settings of AFSA and MAFSA. Lengths are in the unit box.
#[derive(Debug, Clone, PartialEq)]
pub struct FishSettings {
    /// Number of fish, N.
    pub fish: usize,
    /// Iterations, Tmax.
    pub iterations: usize,
    /// Looks of a searching fish.
    pub try_number: usize,
    /// Crowd factor.
    pub delta: f64,
    /// Initial visual range.
    pub visual: f64,
    /// Initial step.
    pub step: f64,
    /// How visual range and step shrink.
    pub schedule: Schedule,
    /// Whom a fish looks at.
    pub neighbourhood: Neighbourhood,
    /// How the crowd test counts.
    pub crowd: Crowd,
    /// Where a searching fish goes.
    pub search: Search,
}

/// Settings of PSO.
#[derive(Debug, Clone, PartialEq)]
pub struct PsoSettings {
    /// Number of particles.
    pub particles: usize,
    /// Iterations.
    pub iterations: usize,
    /// Inertia weight at the first and the last iteration; linear between.
    pub inertia: [f64; 2],
    /// Pull to the particle's own best.
    pub cognitive: f64,
    /// Pull to the swarm's best.
    pub social: f64,
    /// Largest speed, in the unit box.
    pub speed: f64,
}

fn at_least_one(name: &str, value: usize) -> Result<()> {
    if value == 0 { Err(Error::setting(name, value, "a whole number of at least 1")) } else { Ok(()) }
}

fn within(name: &str, value: f64, low: f64, high: f64) -> Result<()> {
    if value >= low && value <= high {
        Ok(())
    } else {
        Err(Error::setting(name, value, format!("a number from {low} to {high}")))
    }
}

fn positive(name: &str, value: f64) -> Result<()> {
    if value > 0.0 && value <= 1.0 {
        Ok(())
    } else {
        Err(Error::setting(name, value, "a number above 0 and up to 1, as a share of the box"))
    }
}

impl FishSettings {
    /// MAFSA with the paper's settings.
    pub fn mafsa(iterations: usize) -> Self {
        Self {
            fish: 50,
            iterations,
            try_number: 50,
            delta: 0.6,
            visual: 0.5,
            step: 0.25,
            schedule: Schedule::FromStart { visual_min: 0.002, step_min: 0.0003, p: 5 },
            neighbourhood: Neighbourhood::Swarm,
            crowd: Crowd::Literal,
            search: Search::Best,
        }
    }

    /// Check every setting.
    ///
    /// # Errors
    /// The first setting that is outside its range.
    pub fn check(&self) -> Result<()> {
        at_least_one("n_fish", self.fish)?;
        at_least_one("max_iterations", self.iterations)?;
        at_least_one("try_number", self.try_number)?;
        within("delta", self.delta, 0.0, 1.0)?;
        positive("visual", self.visual)?;
        positive("step", self.step)?;
        if let Schedule::FromStart { visual_min, step_min, p }
        | Schedule::Recursive { visual_min, step_min, p } = self.schedule
        {
            within("visual_min", visual_min, 0.0, 1.0)?;
            within("step_min", step_min, 0.0, 1.0)?;
            if !(1..=30).contains(&p) {
                return Err(Error::setting("p", p, "a whole number from 1 to 30"));
            }
        }
        Ok(())
    }
}

impl PsoSettings {
    /// Check every setting.
    ///
    /// # Errors
    /// The first setting that is outside its range.
    pub fn check(&self) -> Result<()> {
        at_least_one("n_particles", self.particles)?;
        at_least_one("max_iterations", self.iterations)?;
        within("inertia_start", self.inertia[0], 0.0, 2.0)?;
        within("inertia_end", self.inertia[1], 0.0, 2.0)?;
        within("cognitive", self.cognitive, 0.0, 10.0)?;
        within("social", self.social, 0.0, 10.0)?;
        positive("speed", self.speed)
    }
}
