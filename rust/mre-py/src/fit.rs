//! Exact and hybrid fits.

use mre::fit::{self, certified};
use mre::swarm::StopReason;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::rows;
use crate::bounds::read_start;
use crate::error::to_python;
use crate::outcome::{history_to_python, name_of};
use crate::problem::Problem;
use crate::run::{Ended, Link, by_signal, here, in_pool, raises};
use crate::scalars::Whole;
use crate::settings::{RunOptions, fish, run_options};

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
    threads: Option<Whole>,
    on_interrupt: &str,
) -> PyResult<Outcome<'py>> {
    let raise = raises(on_interrupt)?;
    let job = |link: &Link| fit::exact(&problem.inner, link.cancel());
    let (fit, ended) = if certified::is_quick(&problem.inner) {
        (here(py, threads, job)?, by_signal(py, raise)?)
    } else {
        in_pool(py, threads, None, raise, job)?
    };
    outcome(py, fit, ended)
}

/// True where the exact optimum takes less time than a thread to start.
#[pyfunction]
pub(crate) fn exact_is_quick(problem: &Problem) -> bool {
    certified::is_quick(&problem.inner)
}

/// MAFSA over the shapes with exact coefficients, then descent: `(x, fitness, evaluations, reason, history)`.
#[pyfunction]
#[pyo3(signature = (problem, settings, seed, *, start=None, **options))]
pub(crate) fn fit_hybrid<'py>(
    py: Python<'py>,
    problem: &Problem,
    settings: &Bound<'py, PyDict>,
    seed: u64,
    start: Option<&Bound<'py, PyAny>>,
    options: Option<&Bound<'py, PyDict>>,
) -> PyResult<Outcome<'py>> {
    let RunOptions { budget, threads, callback, raise } = run_options(options)?;
    let settings = fish(settings)?;
    let start = start.map(|x0| read_start(x0, problem.inner.parameters().len())).transpose()?;
    let (fit, ended) = in_pool(py, threads, callback.as_ref(), raise, |link| {
        let mut monitor = link;
        fit::hybrid(&problem.inner, settings, seed, start.as_deref(), &budget, &mut monitor, link.cancel())
    })?;
    outcome(py, fit.map_err(to_python)?, ended)
}

/// Refuse a problem for which no certificate exists.
#[pyfunction]
pub(crate) fn check_certifiable(problem: &Problem) -> PyResult<()> {
    certified::check(&problem.inner).map_err(to_python)
}

/// How far parameters are from the best of the box: `(lower, gap, certified, evaluations)`.
#[pyfunction]
#[pyo3(signature = (problem, x, tolerance, *, threads=None))]
pub(crate) fn certify(
    py: Python<'_>,
    problem: &Problem,
    x: &Bound<'_, PyAny>,
    tolerance: f64,
    threads: Option<Whole>,
) -> PyResult<(f64, f64, bool, u64)> {
    let (row, _) = rows("x", x, problem.inner.parameters().len())?;
    let job = |link: &Link| {
        let mut cost = [0.0];
        problem.inner.fitness(&row, &mut cost, link.cancel());
        certified::certificate(&problem.inner, cost[0], tolerance, link.cancel())
    };
    let proof = in_pool(py, threads, None, true, job)?.0.map_err(to_python)?;
    Ok((proof.lower, proof.gap, proof.certified, proof.evaluations))
}
