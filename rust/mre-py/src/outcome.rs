//! What a run hands back to Python: histories, and why it stopped.

use mre::swarm::{History, StopReason};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::run::Ended;

/// Columns of a history.
pub(crate) fn history_to_python<'py>(py: Python<'py>, history: &History) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("best", PyArray1::from_slice(py, &history.best))?;
    dict.set_item("mean", PyArray1::from_slice(py, &history.mean))?;
    dict.set_item("evaluations", PyArray1::from_slice(py, &history.evaluations))?;
    dict.set_item("range", PyArray1::from_slice(py, &history.range))?;
    dict.set_item("step", PyArray1::from_slice(py, &history.step))?;
    Ok(dict)
}

/// The name of a reason in Python.
pub(crate) fn name_of(reason: StopReason, ended: Ended) -> &'static str {
    match (reason, ended) {
        (StopReason::Interrupted, Ended::ByCallback) => "callback",
        // Also where the run was through when the signal was seen.
        (_, Ended::Interrupted) | (StopReason::Interrupted, _) => "interrupted",
        (StopReason::Iterations, _) => "max_iterations",
        (StopReason::Evaluations, _) => "max_evaluations",
        (StopReason::Time, _) => "time_limit",
        (StopReason::Target, _) => "target",
    }
}
