//! Single numbers from Python, of which the core has only so many digits.

use pyo3::prelude::*;
use pyo3::types::PyInt;

use crate::error::{of_type, quoted};

/// A whole number of 64 bits; its range is checked where it is used.
#[derive(Clone, Copy)]
pub(crate) struct Whole(pub(crate) i64);

/// A number.
#[derive(Clone, Copy)]
pub(crate) struct Number(pub(crate) f64);

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
