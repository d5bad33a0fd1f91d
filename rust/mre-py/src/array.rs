//! `NumPy` in and out: the only file that knows how arrays are read.

use numpy::{AllowTypeChange, PyArray1, PyArrayLike1, PyArrayLike2, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

use crate::error::MreError;

/// Look up which NumPy this is before its interface is used for the first time, where an error of the look-up,
/// such as an interruption, would be a panic.
pub(crate) fn numpy_is_there(py: Python<'_>) -> PyResult<()> {
    static THERE: PyOnceLock<()> = PyOnceLock::new();
    THERE.get_or_try_init(py, || numpy::get_array_module(py).map(drop)).copied()
}

/// A one-dimensional array of numbers, copied: the caller may go on writing to its own.
pub(crate) fn vector(what: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let wanted = "a one-dimensional array of numbers";
    let array = plain(value)?.ok_or_else(|| unreadable(what, value, wanted))?;
    match array.extract::<PyArrayLike1<'_, f64, AllowTypeChange>>() {
        Ok(array) => Ok(array.as_array().iter().copied().collect()),
        Err(_) => Err(unreadable(what, value, wanted)),
    }
}

/// The value as a NumPy array of real numbers; `None` where it is something else.
fn plain<'py>(value: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
    numpy_is_there(value.py())?;
    Ok(without_mask(value))
}

/// NumPy itself would turn words into numbers, drop imaginary parts and forget masks.
fn without_mask<'py>(value: &Bound<'py, PyAny>) -> Option<Bound<'py, PyAny>> {
    let numpy = value.py().import("numpy").ok()?;
    if value.is_instance(&numpy.getattr("ma").ok()?.getattr("MaskedArray").ok()?).ok()? {
        return None;
    }
    let array = numpy.call_method1("asarray", (value,)).ok()?;
    let kind: String = array.getattr("dtype").ok()?.getattr("kind").ok()?.extract().ok()?;
    match kind.as_str() {
        "b" | "i" | "u" | "f" => Some(array),
        "O" => {
            let numbers: Vec<f64> = array.call_method0("ravel").ok()?.extract().ok()?;
            let shape = array.getattr("shape").ok()?;
            PyArray1::from_vec(value.py(), numbers).call_method1("reshape", (shape,)).ok()
        }
        _ => None,
    }
}

/// Rows of `columns` numbers; a single row may come one-dimensional. The flag says whether it did.
pub(crate) fn rows(what: &str, value: &Bound<'_, PyAny>, columns: usize) -> PyResult<(Vec<f64>, bool)> {
    let wanted = format!("an array of shape (n, {columns}) or ({columns},)");
    let array = plain(value)?.ok_or_else(|| unreadable(what, value, &wanted))?;
    if let Ok(array) = array.extract::<PyArrayLike2<'_, f64, AllowTypeChange>>() {
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
