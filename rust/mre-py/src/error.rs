//! The one table of errors: Rust to Python.

use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::PyValueError;

create_exception!(
    mre_core._core,
    MreError,
    PyValueError,
    "An input or a setting is wrong; the message says what, where, the value, and what was wanted."
);

/// Any error of the core as a Python exception.
#[allow(clippy::needless_pass_by_value)] // the shape that map_err wants
pub(crate) fn to_python(error: mre::error::Error) -> PyErr {
    MreError::new_err(error.to_string())
}

/// A setting that is not allowed, as a Python exception.
pub(crate) fn setting(name: &str, value: impl std::fmt::Display, wanted: &str) -> PyErr {
    to_python(mre::error::Error::setting(name, value, wanted))
}
