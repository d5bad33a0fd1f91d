//! The one table of errors: Rust to Python.

use pyo3::create_exception;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;

/// Characters of a message; longer ones lose their middle.
const LONGEST: usize = 1000;
/// Characters of a value in a message.
const LONGEST_VALUE: usize = 60;

create_exception!(
    mre_core._core,
    MreError,
    PyValueError,
    "An input or a setting is wrong; the message says what, where, the value, and what was wanted."
);

/// Any error of the core as a Python exception.
#[allow(clippy::needless_pass_by_value)] // the shape that map_err wants
pub(crate) fn to_python(error: mre::error::Error) -> PyErr {
    MreError::new_err(one_line(&error.to_string()))
}

/// An argument of another type altogether, as a Python exception.
pub(crate) fn of_type(message: &str) -> PyErr {
    PyTypeError::new_err(one_line(message))
}

/// A value for a message: shortened, whatever it says of itself.
pub(crate) fn quoted(value: &Bound<'_, PyAny>) -> String {
    let text =
        value.repr().map_or_else(|_| "something else".into(), |text| one_line(&text.to_string_lossy()));
    if text.chars().count() <= LONGEST_VALUE {
        return text;
    }
    text.chars().take(LONGEST_VALUE - 3).chain("...".chars()).collect()
}

/// One line that a terminal shows and does not obey: names and values come from anywhere.
fn one_line(text: &str) -> String {
    let line: Vec<char> = text
        .lines()
        .collect::<Vec<_>>()
        .join(" ")
        .chars()
        .map(|char| if char.is_control() { '?' } else { char })
        .collect();
    let end = line.len();
    if end <= LONGEST {
        return line.into_iter().collect();
    }
    let half = LONGEST / 2;
    line[..half].iter().chain(" ... ".chars().collect::<Vec<_>>().iter()).chain(&line[end - half..]).collect()
}

/// A setting that is not allowed, as a Python exception.
pub(crate) fn setting(name: &str, value: impl std::fmt::Display, wanted: &str) -> PyErr {
    to_python(mre::error::Error::setting(name, value, wanted))
}
