//! Boxes and starting points from Python.

use std::collections::HashMap;

use mre::parameter::{Bounds, Scale};
use pyo3::prelude::*;

use crate::array::{rows, vector};
use crate::error::{setting, to_python};

/// Bounds in the order of their names: the same error whatever the order of the hash.
pub(crate) fn by_name(bounds: Option<HashMap<String, (f64, f64)>>) -> Vec<(String, f64, f64)> {
    let mut bounds: Vec<_> =
        bounds.unwrap_or_default().into_iter().map(|(name, (low, high))| (name, low, high)).collect();
    bounds.sort_by(|a, b| a.0.cmp(&b.0));
    bounds
}

/// A box for a function.
pub(crate) fn read_box(
    lower: &Bound<'_, PyAny>,
    upper: &Bound<'_, PyAny>,
    names: Option<Vec<String>>,
) -> PyResult<Bounds> {
    let (lower, upper) = (vector("lower", lower)?, vector("upper", upper)?);
    if lower.len() != upper.len() {
        return Err(setting("length of upper", upper.len(), &format!("{}, as lower", lower.len())));
    }
    let names = names.unwrap_or_else(|| (0..lower.len()).map(|i| format!("x[{i}]")).collect());
    if names.len() != lower.len() {
        return Err(setting("number of names", names.len(), &format!("{}, one a bound", lower.len())));
    }
    let scale = vec![Scale::Linear; lower.len()];
    Bounds::new(&names, lower, upper, scale).map_err(to_python)
}

/// Where an optimisation starts.
pub(crate) fn read_start(x0: &Bound<'_, PyAny>, dimension: usize) -> PyResult<Vec<f64>> {
    let (row, _) = rows("x0", x0, dimension)?;
    match row.iter().find(|value| !value.is_finite()) {
        Some(bad) => Err(setting("x0", bad, "finite numbers")),
        None => Ok(row),
    }
}
