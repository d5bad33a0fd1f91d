//! Settings of the swarms from Python dictionaries.

use mre::swarm::{Budget, Crowd, FishSettings, Neighbourhood, PsoSettings, Schedule, Search};
use pyo3::prelude::*;
use std::time::Duration;

use crate::error::{setting, to_python};

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
#[allow(clippy::struct_field_names)] // the names in Python
pub(crate) struct Fish {
    n_fish: i64,
    max_iterations: i64,
    try_number: i64,
    delta: f64,
    visual: f64,
    step: f64,
    visual_min: f64,
    step_min: f64,
    p: i64,
    schedule: String,
    neighbourhood: String,
    crowd: String,
    search: String,
}

#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Pso {
    n_particles: i64,
    max_iterations: i64,
    inertia_start: f64,
    inertia_end: f64,
    cognitive: f64,
    social: f64,
    speed: f64,
}

fn count(name: &str, value: i64) -> PyResult<usize> {
    // Beyond ten million the swarm itself would not fit.
    usize::try_from(value)
        .ok()
        .filter(|n| (1..=10_000_000).contains(n))
        .ok_or_else(|| setting(name, value, "a whole number from 1 to 10000000"))
}

fn choose<T: Copy>(name: &str, value: &str, among: &[(&str, T)]) -> PyResult<T> {
    among.iter().find(|(known, _)| *known == value).map(|(_, chosen)| *chosen).ok_or_else(|| {
        let known: Vec<&str> = among.iter().map(|(known, _)| *known).collect();
        setting(name, format!("'{value}'"), &format!("one of {}", known.join(", ")))
    })
}

impl Fish {
    pub(crate) fn to_core(&self) -> PyResult<FishSettings> {
        let (visual_min, step_min) = (self.visual_min, self.step_min);
        let p = u32::try_from(self.p).map_err(|_| setting("p", self.p, "a whole number from 1 to 30"))?;
        let settings = FishSettings {
            fish: count("n_fish", self.n_fish)?,
            iterations: count("max_iterations", self.max_iterations)?,
            try_number: count("try_number", self.try_number)?,
            delta: self.delta,
            visual: self.visual,
            step: self.step,
            schedule: choose(
                "schedule",
                &self.schedule,
                &[
                    ("start", Schedule::FromStart { visual_min, step_min, p }),
                    ("recursive", Schedule::Recursive { visual_min, step_min, p }),
                    ("constant", Schedule::Constant),
                ],
            )?,
            neighbourhood: choose(
                "neighbourhood",
                &self.neighbourhood,
                &[("swarm", Neighbourhood::Swarm), ("visual", Neighbourhood::Visual)],
            )?,
            crowd: choose(
                "crowd",
                &self.crowd,
                &[("literal", Crowd::Literal), ("visual", Crowd::Visual), ("none", Crowd::None)],
            )?,
            search: choose("search", &self.search, &[("best", Search::Best), ("step", Search::Step)])?,
        };
        settings.check().map_err(to_python)?;
        Ok(settings)
    }
}

impl Pso {
    pub(crate) fn to_core(&self) -> PyResult<PsoSettings> {
        let settings = PsoSettings {
            particles: count("n_particles", self.n_particles)?,
            iterations: count("max_iterations", self.max_iterations)?,
            inertia: [self.inertia_start, self.inertia_end],
            cognitive: self.cognitive,
            social: self.social,
            speed: self.speed,
        };
        settings.check().map_err(to_python)?;
        Ok(settings)
    }
}

/// Budgets as they come from Python.
pub(crate) fn budget(evaluations: Option<i64>, time: Option<f64>, target: Option<f64>) -> PyResult<Budget> {
    let evaluations = evaluations
        .map(|n| u64::try_from(n).map_err(|_| setting("max_evaluations", n, "a whole number of at least 1")))
        .transpose()?;
    let time = time
        .map(|s| {
            Duration::try_from_secs_f64(s)
                .map_err(|_| setting("time_limit", s, "a number of seconds above 0"))
        })
        .transpose()?;
    let budget = Budget { evaluations, time, target };
    budget.check().map_err(to_python)?;
    Ok(budget)
}
