//! `NumPy` in and out: the only file that knows how arrays are read.

use numpy::{AllowTypeChange, PyArray1, PyArrayLike1, PyArrayLike2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::error::MreError;

/// A one-dimensional array of numbers, copied: the caller may go on writing to its own.
pub(crate) fn vector(what: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    match value.extract::<PyArrayLike1<'_, f64, AllowTypeChange>>() {
        Ok(array) => Ok(array.as_array().iter().copied().collect()),
        Err(_) => Err(unreadable(what, value, "a one-dimensional array of numbers")),
    }
}

/// Rows of `columns` numbers; a single row may come one-dimensional. The flag says whether it did.
pub(crate) fn rows(what: &str, value: &Bound<'_, PyAny>, columns: usize) -> PyResult<(Vec<f64>, bool)> {
    let wanted = format!("an array of shape (n, {columns}) or ({columns},)");
    if let Ok(array) = value.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() {
        return if array.shape()[1] == columns {
            Ok((array.as_array().iter().copied().collect(), false))
        } else {
            Err(unreadable(what, value, &wanted))
        };
    }
    match vector(what, value) {
        Ok(row) if row.len() == columns => Ok((row, true)),
        _ => Err(unreadable(what, value, &wanted)),
    }
}

/// Rows of `columns` numbers as a two-dimensional array.
pub(crate) fn matrix<'py>(
    py: Python<'py>,
    rows: &[f64],
    columns: usize,
) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
    PyArray1::from_slice(py, rows).reshape([rows.len() / columns, columns])
}

fn unreadable(what: &str, value: &Bound<'_, PyAny>, wanted: &str) -> PyErr {
    let found = match value.getattr("shape").and_then(|s| s.str()).map(|s| s.to_string()) {
        Ok(shape) => {
            let dtype =
                value.getattr("dtype").and_then(|d| d.str()).map_or(String::new(), |d| format!(" of {d}"));
            format!("an array of shape {shape}{dtype}")
        }
        Err(_) => value.get_type().name().map_or_else(|_| "something else".into(), |name| name.to_string()),
    };
    MreError::new_err(format!("{what} is {found}: wanted {wanted}"))
}
