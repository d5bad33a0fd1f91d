//! Uncertainty of a fit: by tangents, by profiles, by bootstrap.

use mre::uncertainty::{self, Estimate};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::array::{matrix, vector};
use crate::error::{setting, to_python};
use crate::problem::Problem;
use crate::run::{Link, in_pool};
use crate::scalars::Whole;

/// Name, unit, value, standard error, low, high, determined.
type Row = (String, &'static str, f64, Option<f64>, Option<f64>, Option<f64>, bool);
/// Name, unit, value, low, high, points with their cost.
type ProfileRow<'py> = (String, &'static str, f64, Option<f64>, Option<f64>, Bound<'py, PyArray2<f64>>);
/// Names and units, rows, intervals, samples of a block.
type Replicates<'py> = (Vec<(String, &'static str)>, Bound<'py, PyArray2<f64>>, Vec<(f64, f64)>, Vec<usize>);

fn row(estimate: Estimate) -> Row {
    let Estimate { name, unit, value, standard_error, interval, determined } = estimate;
    (name, unit, value, standard_error, interval.map(|i| i.0), interval.map(|i| i.1), determined)
}

/// Uncertainty of a fit at its values.
#[pyfunction]
#[pyo3(signature = (problem, x, level=0.95))]
pub(crate) fn fit_uncertainty<'py>(
    py: Python<'py>,
    problem: &Problem,
    x: &Bound<'py, PyAny>,
    level: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let values = vector("x", x)?;
    let job = |link: &Link| uncertainty::estimate(&problem.inner, &values, level, link.cancel());
    let found = in_pool(py, Some(Whole(1)), None, true, job)?.0.map_err(to_python)?;
    let d = values.len();
    let dict = PyDict::new(py);
    let rows = |estimates: Vec<Estimate>| estimates.into_iter().map(row).collect::<Vec<_>>();
    dict.set_item("parameters", rows(found.parameters))?;
    dict.set_item("derived", rows(found.derived))?;
    dict.set_item("correlation", PyArray1::from_vec(py, found.correlation).reshape([d, d])?)?;
    dict.set_item("condition_number", found.condition_number)?;
    dict.set_item("amplitude", found.cycle.amplitude)?;
    dict.set_item("frequency", found.cycle.frequency)?;
    dict.set_item("words", found.words)?;
    Ok(dict)
}

/// What one recording adds to the covariance of a joint fit: `J' V J`, and the independent samples in it.
#[pyfunction]
pub(crate) fn noise_products<'py>(
    py: Python<'py>,
    tangents: &Bound<'py, PyList>,
    residual: &Bound<'py, PyAny>,
    rate: f64,
) -> PyResult<(Bound<'py, PyArray2<f64>>, f64)> {
    let residual = vector("residual", residual)?;
    let columns = tangents.iter().map(|c| vector("tangents", &c)).collect::<PyResult<Vec<_>>>()?;
    let found = uncertainty::products(&columns, &residual, rate).map_err(to_python)?;
    Ok((matrix(py, &found.noisy, columns.len().max(1))?, found.independent))
}

/// Profile-likelihood intervals.
#[pyfunction]
#[pyo3(signature = (problem, x, level=0.95, *, threads=None))]
pub(crate) fn fit_profile<'py>(
    py: Python<'py>,
    problem: &Problem,
    x: &Bound<'py, PyAny>,
    level: f64,
    threads: Option<Whole>,
) -> PyResult<Vec<ProfileRow<'py>>> {
    let values = vector("x", x)?;
    let job = |link: &Link| uncertainty::profile(&problem.inner, &values, level, link.cancel());
    let found = in_pool(py, threads, None, true, job)?.0.map_err(to_python)?;
    found
        .into_iter()
        .map(|p| {
            let flat: Vec<f64> = p.points.iter().flat_map(|(value, cost)| [*value, *cost]).collect();
            Ok((p.name, p.unit, p.value, p.low, p.high, matrix(py, &flat, 2)?))
        })
        .collect()
}

/// Refits of simulated repetitions.
#[pyfunction]
#[pyo3(signature = (problem, x, replicates, seed, level=0.95, *, threads=None))]
pub(crate) fn fit_bootstrap<'py>(
    py: Python<'py>,
    problem: &Problem,
    x: &Bound<'py, PyAny>,
    replicates: i64,
    seed: u64,
    level: f64,
    threads: Option<Whole>,
) -> PyResult<Replicates<'py>> {
    let values = vector("x", x)?;
    let count = usize::try_from(replicates)
        .map_err(|_| setting("replicates", replicates, "a whole number of at least 2"))?;
    let job =
        |link: &Link| uncertainty::bootstrap(&problem.inner, &values, count, level, seed, link.cancel());
    let found = in_pool(py, threads, None, true, job)?.0.map_err(to_python)?;
    let rows = matrix(py, &found.rows, found.names.len())?;
    Ok((found.names, rows, found.intervals, found.blocks))
}
