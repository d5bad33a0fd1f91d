//! Boxes and starting points from Python.

use mre::parameter::{Bounds, Scale};
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::array::{rows, vector};
use crate::error::{quoted, setting, to_python};

/// Bounds by name, in the order of the names: the same error whatever the order of the mapping.
pub(crate) fn by_name(bounds: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<(String, f64, f64)>> {
    let Some(bounds) = bounds else { return Ok(Vec::new()) };
    let Ok(mapping) = bounds.cast::<PyMapping>() else {
        return Err(setting("bounds", quoted(bounds), "a mapping of name to (lower, upper)"));
    };
    let mut found = Vec::new();
    for item in mapping.items()?.iter() {
        let (name, pair): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let Ok(name) = name.extract::<String>() else {
            return Err(setting("a name of bounds", quoted(&name), "the symbol of a parameter"));
        };
        let what = format!("bounds of {name}");
        match vector(&what, &pair).map_err(|_| setting(&what, quoted(&pair), "(lower, upper)"))?[..] {
            [low, high] => found.push((name, low, high)),
            ref other => {
                return Err(setting(&format!("number of {what}"), other.len(), "two, (lower, upper)"));
            }
        }
    }
    found.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(found)
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
