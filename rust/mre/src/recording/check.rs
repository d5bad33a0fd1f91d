//! What makes a recording usable.

use super::{Condition, LARGEST, MIN_SAMPLES, SMALLEST, Series, extent};
use crate::error::{Error, Result};

/// Nothing is colder, degC.
const ABSOLUTE_ZERO: f64 = -273.15;

pub(super) fn series(series: &Series) -> Result<()> {
    let n = series.time.len();
    if n < MIN_SAMPLES {
        return Err(Error::Recording(format!("{n} samples: at least {MIN_SAMPLES} are needed")));
    }
    usable("time", &series.time)?;
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
            Condition::Constant(value) => usable(what, std::slice::from_ref(value))?,
            Condition::Series(values) => columns.push((what, Some(values))),
        }
    }
    for (what, values) in columns.into_iter().filter_map(|(what, v)| v.map(|v| (what, v))) {
        if values.len() != n {
            return Err(Error::Length { what, expected: n, got: values.len() });
        }
        usable(what, values)?;
    }
    warm(&series.temperature)?;
    let (low, high) = extent(&series.displacement);
    if low == high {
        return Err(Error::Recording(format!(
            "displacement is {low} mm throughout: a moving device is needed"
        )));
    }
    if high - low < SMALLEST {
        return Err(Error::Recording(format!(
            "displacement changes by {:e} mm in all: a device that moves by at least {SMALLEST:e} mm is needed",
            high - low
        )));
    }
    Ok(())
}

/// Refuse a temperature that nothing has.
fn warm(temperature: &Condition) -> Result<()> {
    let values = match temperature {
        Condition::Missing => return Ok(()),
        Condition::Constant(value) => std::slice::from_ref(value),
        Condition::Series(values) => values,
    };
    let Some(index) = values.iter().position(|t| *t < ABSOLUTE_ZERO) else { return Ok(()) };
    let text = format!(
        "temperature is {} degC at sample {index}: at least {ABSOLUTE_ZERO} degC, absolute zero, is needed",
        values[index]
    );
    Err(Error::Recording(text))
}

/// Refuse a series with a sample that is not finite or beyond [`LARGEST`].
pub(crate) fn usable(what: &'static str, values: &[f64]) -> Result<()> {
    let Some(index) = values.iter().position(|v| v.is_nan() || v.abs() > LARGEST) else { return Ok(()) };
    let value = values[index];
    Err(if value.is_finite() {
        Error::TooLarge { what, index, value, largest: LARGEST }
    } else {
        Error::NotFinite { what, index, value }
    })
}
