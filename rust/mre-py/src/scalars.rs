//! Single numbers and texts from Python, of which the core takes only those that it can write.

use pyo3::exceptions::PyUnicodeEncodeError;
use pyo3::prelude::*;
use pyo3::types::PyInt;

use crate::error::{of_type, quoted};

/// A whole number of 64 bits; its range is checked where it is used.
#[derive(Clone, Copy)]
pub(crate) struct Whole(pub(crate) i64);

/// A number.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub(crate) f64);

/// A text.
#[derive(Default)]
pub(crate) struct Text(pub(crate) String);

impl<'py> FromPyObject<'_, 'py> for Text {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        value.extract().map(Self).map_err(|error: PyErr| {
            if error.is_instance_of::<PyUnicodeEncodeError>(value.py()) {
                return of_type(&format!("{} holds half of a character: wanted a text", quoted(&value)));
            }
            error
        })
    }
}

impl<'py> FromPyObject<'_, 'py> for Whole {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        value.extract().map(Self).map_err(|error| digits(&value, error))
    }
}

impl<'py> FromPyObject<'_, 'py> for Number {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        value.extract().map(Self).map_err(|error| digits(&value, error))
    }
}

/// The error for an integer that is too large, which names its argument as other wrong types do.
fn digits(value: &Bound<'_, PyAny>, error: PyErr) -> PyErr {
    if value.is_instance_of::<PyInt>() {
        return of_type(&format!("{} has too many digits", quoted(value)));
    }
    error
}
