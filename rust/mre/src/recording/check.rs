//! What makes a recording usable.

use super::{Condition, MIN_SAMPLES, Series, extent};
use crate::error::{Error, Result};

pub(super) fn series(series: &Series) -> Result<()> {
    let n = series.time.len();
    if n < MIN_SAMPLES {
        return Err(Error::Recording(format!("{n} samples: at least {MIN_SAMPLES} are needed")));
    }
    finite("time", &series.time)?;
    for (i, pair) in series.time.windows(2).enumerate() {
        if pair[1] <= pair[0] {
            return Err(Error::Time { index: i + 1, before: pair[0], after: pair[1] });
        }
    }
    let mut columns = vec![("displacement", Some(&series.displacement))];
    columns.push(("velocity", series.velocity.as_ref()));
    columns.push(("force", series.force.as_ref()));
    columns.push(("simulated", series.simulated.as_ref()));
    for (what, condition) in [("current", &series.current), ("temperature", &series.temperature)] {
        match condition {
            Condition::Missing => {}
            Condition::Constant(value) => finite(what, std::slice::from_ref(value))?,
            Condition::Series(values) => columns.push((what, Some(values))),
        }
    }
    for (what, values) in columns.into_iter().filter_map(|(what, v)| v.map(|v| (what, v))) {
        if values.len() != n {
            return Err(Error::Length { what, expected: n, got: values.len() });
        }
        finite(what, values)?;
    }
    let (low, high) = extent(&series.displacement);
    if low == high {
        return Err(Error::Recording(format!(
            "displacement is {low} mm throughout: a moving device is needed"
        )));
    }
    Ok(())
}

fn finite(what: &'static str, values: &[f64]) -> Result<()> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(Error::NotFinite { what, index, value: values[index] }),
        None => Ok(()),
    }
}
