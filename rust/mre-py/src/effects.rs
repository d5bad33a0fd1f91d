//! The catalogue of effects, and effects with their parameters.

use mre::assembly::Addition;
use mre::effect::{self, CATALOGUE, Effect, Sizes};
use mre::parameter::Parameter;
use mre::recording::{LARGEST, SMALLEST};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};

use crate::error::{MreError, setting};

/// Id, law, coefficients, shapes.
pub(crate) type Given = (String, String, Vec<f64>, Vec<f64>);

/// Every law of every effect: its id and law, what it is in plain words, equation, reference and limit.
#[pyfunction]
pub(crate) fn catalogue(py: Python<'_>) -> PyResult<Vec<Bound<'_, PyDict>>> {
    let row = |known: &&'static dyn Effect| {
        let (row, about) = (PyDict::new(py), known.about());
        row.set_item("id", about.effect)?;
        row.set_item("law", about.law)?;
        row.set_item("plain", about.plain)?;
        row.set_item("equation", about.equation)?;
        row.set_item("reference", about.reference)?;
        row.set_item("limit", about.limit)?;
        row.set_item("of_the_measurement", known.of_the_measurement())?;
        row.set_item("feels_temperature", known.feels_temperature())?;
        Ok(row)
    };
    CATALOGUE.iter().map(row).collect()
}

type Names = Vec<(String, &'static str)>;

/// Names and units of the coefficients of a law and of its shapes, and whether the coefficients belong to
/// the measurement: they are then no part of a device.
#[pyfunction]
pub(crate) fn effect_parameters(id: &str, law: &str) -> PyResult<(Names, Names, bool)> {
    let known = law_of(id, law)?;
    let names = |all: Vec<Parameter>| all.into_iter().map(|p| (p.name, p.unit)).collect();
    Ok((names(known.coefficients()), names(known.shape(&any_sizes())), known.of_the_measurement()))
}

/// Check an effect with its parameters.
#[pyfunction]
#[allow(clippy::needless_pass_by_value)] // taken over from Python
pub(crate) fn check_effect(id: &str, law: &str, coefficients: Vec<f64>, shapes: Vec<f64>) -> PyResult<()> {
    addition((id.to_owned(), law.to_owned(), coefficients, shapes)).map(|_| ())
}

pub(crate) fn law_of(id: &str, law: &str) -> PyResult<&'static dyn Effect> {
    effect::named(id, law).ok_or_else(|| {
        let (mut ids, mut laws) = (Vec::new(), Vec::new());
        for about in CATALOGUE.iter().map(|known| known.about()) {
            ids.push(about.effect);
            if about.effect == id {
                laws.push(about.law);
            }
        }
        ids.dedup();
        if laws.is_empty() {
            setting("effect", format!("'{id}'"), &format!("one of {}", ids.join(", ")))
        } else {
            setting(&format!("law of {id}"), format!("'{law}'"), &format!("one of {}", laws.join(", ")))
        }
    })
}

/// An effect to simulate. One of the measurement has no coefficients.
pub(crate) fn addition((id, law, coefficients, shape): Given) -> PyResult<Addition> {
    let effect = law_of(&id, &law)?;
    let own = if effect.of_the_measurement() { Vec::new() } else { effect.coefficients() };
    for (kind, wanted, values) in
        [("coefficients", own, &coefficients), ("shapes", effect.shape(&any_sizes()), &shape)]
    {
        if wanted.len() != values.len() {
            let name = format!("number of {kind} of {id} ({law})");
            return Err(setting(&name, values.len(), &format!("{} values", wanted.len())));
        }
        for (p, value) in wanted.iter().zip(values) {
            if !value.is_finite() || *value < p.smallest || *value > p.largest {
                let limits = format!("a finite number from {} to {}", p.smallest, p.largest);
                return Err(setting(&format!("{} of {id}", p.name), value, &limits));
            }
        }
    }
    Ok(Addition { effect, coefficients, shape })
}

/// Sizes of the recordings that effects were fitted to.
pub(crate) fn sizes(given: &Bound<'_, PyMapping>) -> PyResult<Sizes> {
    let item = |name: &str| given.get_item(name).ok().filter(|value| !value.is_none());
    let within = |name: &str, least: f64| {
        let value = item(name).and_then(|value| value.extract::<f64>().ok());
        value.filter(|value| (least..=LARGEST).contains(value))
    };
    let yes = |name: &str| -> PyResult<bool> {
        let known = |value: Bound<'_, PyAny>| value.extract().map_err(|_| unusable(name, "true or false"));
        item(name).map_or(Ok(false), known)
    };
    let number = |name: &str| -> PyResult<f64> {
        within(name, SMALLEST).ok_or_else(|| unusable(name, "a number above 0"))
    };
    Ok(Sizes {
        displacement: number("displacement")?,
        // Models of before it mattered have none.
        noise: match item("noise") {
            Some(_) => within("noise", 0.0).ok_or_else(|| unusable("noise", "a number from 0"))?,
            None => 0.0,
        },
        velocity: number("velocity")?,
        force: number("force")?,
        step: number("step")?,
        duration: number("duration")?,
        total: number("total")?,
        path: number("path")?,
        energy: number("energy")?,
        // Models of before there were laws that need it have none.
        dissipated: item("dissipated").map_or_else(|| number("energy"), |_| number("dissipated"))?,
        life: item("life").map_or(Ok(1.0), |_| number("life"))?,
        current: item("current").map(|value| ends("current", "A", &value)).transpose()?,
        current_varies: yes("current_varies")?,
        current_steps: yes("current_steps")?,
        temperature: item("temperature").map(|value| ends("temperature", "degC", &value)).transpose()?,
        quantum: item("quantum").map(|_| number("quantum")).transpose()?,
    })
}

/// Lowest and highest of a condition.
fn ends(name: &str, unit: &str, value: &Bound<'_, PyAny>) -> PyResult<(f64, f64)> {
    match value.extract::<[f64; 2]>() {
        Ok([low, high]) if -LARGEST <= low && low <= high && high <= LARGEST => Ok((low, high)),
        _ => Err(unusable(name, &format!("the lowest and the highest, in {unit}"))),
    }
}

fn unusable(name: &str, wanted: &str) -> PyErr {
    MreError::new_err(format!("sizes have no usable '{name}': wanted {wanted}"))
}

/// Sizes for what does not depend on them: how many parameters a law has, and their names and limits.
pub(crate) fn any_sizes() -> Sizes {
    Sizes {
        displacement: 1.0,
        noise: 0.0,
        velocity: 1.0,
        force: 1.0,
        step: 0.01,
        duration: 10.0,
        total: 10.0,
        path: 1.0,
        energy: 1.0,
        dissipated: 1.0,
        life: 1.0,
        current: Some((0.0, 1.0)),
        current_varies: true,
        current_steps: true,
        temperature: Some((20.0, 40.0)),
        quantum: None,
    }
}
