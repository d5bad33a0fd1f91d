//! Settings of the swarms from Python dictionaries.

use std::time::Duration;

use mre::swarm::{Budget, Crowd, FishSettings, Neighbourhood, PsoSettings, Schedule, Search};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyInt};

use crate::error::{of_type, quoted, setting, to_python};
use crate::run::raises;
use crate::scalars::Whole;

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

/// One setting; a value of another type is named with its value.
fn item<'py, T>(settings: &Bound<'py, PyDict>, name: &str, wanted: &str) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py>,
{
    match settings.get_item(name)? {
        Some(value) => value.extract::<T>().map_err(|_| {
            if value.is_instance_of::<PyInt>() && value.extract::<i64>().is_err() {
                return setting(name, quoted(&value), "a smaller number");
            }
            of_type(&format!("{name} is {}: wanted {wanted}", quoted(&value)))
        }),
        None => Err(PyTypeError::new_err(format!("{name} is missing: wanted {wanted}"))),
    }
}

fn whole(settings: &Bound<'_, PyDict>, name: &str) -> PyResult<i64> {
    item(settings, name, "a whole number")
}

fn number(settings: &Bound<'_, PyDict>, name: &str) -> PyResult<f64> {
    item(settings, name, "a number")
}

/// Settings of AFSA and MAFSA, checked.
pub(crate) fn fish(settings: &Bound<'_, PyDict>) -> PyResult<FishSettings> {
    let text = |name| item::<String>(settings, name, "a text");
    let (visual_min, step_min) = (number(settings, "visual_min")?, number(settings, "step_min")?);
    let exponent = whole(settings, "p")?;
    let p = u32::try_from(exponent).map_err(|_| setting("p", exponent, "a whole number from 1 to 30"))?;
    let settings = FishSettings {
        fish: count("n_fish", whole(settings, "n_fish")?)?,
        iterations: count("max_iterations", whole(settings, "max_iterations")?)?,
        try_number: count("try_number", whole(settings, "try_number")?)?,
        delta: number(settings, "delta")?,
        visual: number(settings, "visual")?,
        step: number(settings, "step")?,
        schedule: choose(
            "schedule",
            &text("schedule")?,
            &[
                ("start", Schedule::FromStart { visual_min, step_min, p }),
                ("recursive", Schedule::Recursive { visual_min, step_min, p }),
                ("constant", Schedule::Constant),
            ],
        )?,
        neighbourhood: choose(
            "neighbourhood",
            &text("neighbourhood")?,
            &[("swarm", Neighbourhood::Swarm), ("visual", Neighbourhood::Visual)],
        )?,
        crowd: choose(
            "crowd",
            &text("crowd")?,
            &[("literal", Crowd::Literal), ("visual", Crowd::Visual), ("none", Crowd::None)],
        )?,
        search: choose("search", &text("search")?, &[("best", Search::Best), ("step", Search::Step)])?,
    };
    settings.check().map_err(to_python)?;
    Ok(settings)
}

/// Settings of PSO, checked.
pub(crate) fn pso(settings: &Bound<'_, PyDict>) -> PyResult<PsoSettings> {
    let settings = PsoSettings {
        particles: count("n_particles", whole(settings, "n_particles")?)?,
        iterations: count("max_iterations", whole(settings, "max_iterations")?)?,
        inertia: [number(settings, "inertia_start")?, number(settings, "inertia_end")?],
        cognitive: number(settings, "cognitive")?,
        social: number(settings, "social")?,
        speed: number(settings, "speed")?,
    };
    settings.check().map_err(to_python)?;
    Ok(settings)
}

/// Options that every run takes.
#[derive(Default)]
pub(crate) struct RunOptions {
    pub(crate) budget: Budget,
    pub(crate) threads: Option<Whole>,
    pub(crate) callback: Option<Py<PyAny>>,
    /// True where Ctrl-C raises, false where it returns the best so far.
    pub(crate) raise: bool,
}

/// Options of a run from keywords, checked.
pub(crate) fn run_options(keywords: Option<&Bound<'_, PyDict>>) -> PyResult<RunOptions> {
    let mut options = RunOptions { raise: true, ..RunOptions::default() };
    let Some(keywords) = keywords else { return Ok(options) };
    for (name, value) in keywords.iter().filter(|(_, value)| !value.is_none()) {
        match name.extract::<String>()?.as_str() {
            "max_evaluations" => {
                let wanted = "a whole number of at least 1";
                let most: i64 = item(keywords, "max_evaluations", wanted)?;
                let most = u64::try_from(most).map_err(|_| setting("max_evaluations", most, wanted))?;
                options.budget.evaluations = Some(most);
            }
            "time_limit" => {
                let most = number(keywords, "time_limit")?;
                let time = Duration::try_from_secs_f64(most);
                options.budget.time =
                    Some(time.map_err(|_| setting("time_limit", most, "a number of seconds above 0"))?);
            }
            "target" => options.budget.target = Some(number(keywords, "target")?),
            "threads" => options.threads = Some(Whole(whole(keywords, "threads")?)),
            "callback" => options.callback = Some(value.unbind()),
            "on_interrupt" => options.raise = raises(&item::<String>(keywords, "on_interrupt", "a text")?)?,
            other => {
                return Err(PyTypeError::new_err(format!("got an unexpected keyword argument '{other}'")));
            }
        }
    }
    options.budget.check().map_err(to_python)?;
    Ok(options)
}
