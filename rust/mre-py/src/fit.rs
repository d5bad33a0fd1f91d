//! Exact and hybrid fits.

use mre::fit;
use mre::swarm::StopReason;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::to_python;
use crate::problem::Problem;
use crate::run::{Ended, in_pool, raises};
use crate::settings::{budget, fish};
use crate::swarm::{history_to_python, name_of, read_start};

type Outcome<'py> = (Bound<'py, PyArray1<f64>>, f64, u64, &'static str, Bound<'py, PyDict>);

fn outcome(py: Python<'_>, fit: fit::Fit, ended: Ended) -> PyResult<Outcome<'_>> {
    let reason = if ended == Ended::ByItself { fit.reason } else { StopReason::Interrupted };
    let history = history_to_python(py, &fit.history)?;
    Ok((PyArray1::from_vec(py, fit.values), fit.cost, fit.evaluations, name_of(reason, ended), history))
}

/// Exact optimum: `(x, fitness, evaluations, reason, history)`.
#[pyfunction]
#[pyo3(signature = (problem, *, threads=None, on_interrupt="raise"))]
pub(crate) fn fit_exact<'py>(
    py: Python<'py>,
    problem: &Problem,
    threads: Option<i64>,
    on_interrupt: &str,
) -> PyResult<Outcome<'py>> {
    let raise = raises(on_interrupt)?;
    let (fit, ended) = in_pool(py, threads, None, raise, |link| fit::exact(&problem.inner, link.cancel()))?;
    outcome(py, fit, ended)
}

/// MAFSA over the shapes with exact coefficients, then descent: `(x, fitness, evaluations, reason, history)`.
#[pyfunction]
#[pyo3(signature = (problem, settings, seed, *, start=None, max_evaluations=None, time_limit=None, target=None, threads=None, callback=None, on_interrupt="raise"))]
#[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)]
pub(crate) fn fit_hybrid<'py>(
    py: Python<'py>,
    problem: &Problem,
    settings: &Bound<'py, PyDict>,
    seed: u64,
    start: Option<&Bound<'py, PyAny>>,
    max_evaluations: Option<i64>,
    time_limit: Option<f64>,
    target: Option<f64>,
    threads: Option<i64>,
    callback: Option<Py<PyAny>>,
    on_interrupt: &str,
) -> PyResult<Outcome<'py>> {
    let budget = budget(max_evaluations, time_limit, target)?;
    let raise = raises(on_interrupt)?;
    let settings = fish(settings)?;
    let start = start.map(|x0| read_start(x0, problem.inner.parameters().len())).transpose()?;
    let (fit, ended) = in_pool(py, threads, callback.as_ref(), raise, |link| {
        let mut monitor = link;
        fit::hybrid(&problem.inner, settings, seed, start.as_deref(), &budget, &mut monitor, link.cancel())
    })?;
    outcome(py, fit.map_err(to_python)?, ended)
}
