//! `Recording`: a validated recording.

use std::collections::BTreeMap;
use std::sync::Arc;

use mre::recording::{self, Condition, Past, Recording as Core, Series};
use mre::transient;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::array::vector;
use crate::error::to_python;
use crate::run::in_pool;
use crate::scalars::{Number, Text, Whole};

/// A validated recording; immutable.
///
/// Parameters
/// ----------
/// time : array, shape (n,)
///     s, strictly increasing, not necessarily uniform; n of at least 8. Times that only rounding takes off an
///     even grid are put back on it.
/// displacement : array, shape (n,)
///     mm.
/// force : array, shape (n,), or None
///     N; None for an excitation to simulate.
/// velocity : array, shape (n,), optional
///     mm/s; derived from the displacement where missing, by local polynomials (`velocity_window` in s).
/// current, temperature : float or array, shape (n,), optional
///     A and degC.
/// simulated : array, shape (n,), optional
///     N; force of a user's own simulation.
/// name : str
///     Name in messages and tables.
///
/// Raises
/// ------
/// MreError
///     Different lengths, too few samples, a value that is not finite, time that does not increase, or
///     a displacement that never changes (a ValueError).
#[pyclass(frozen, from_py_object, module = "mre_core._core")]
#[derive(Clone)]
pub(crate) struct Recording {
    pub(crate) inner: Arc<Core>,
}

/// What a specimen has been through, by name.
type Through = BTreeMap<String, f64>;

/// Its fields by name.
fn fields(past: &mut Past) -> [(&'static str, &mut f64); 8] {
    [
        ("time", &mut past.time),
        ("displacement", &mut past.displacement),
        ("path", &mut past.path),
        ("strokes", &mut past.strokes),
        ("energy", &mut past.energy),
        ("stayed", &mut past.stayed),
        ("dissipated", &mut past.dissipated),
        ("heat", &mut past.heat),
    ]
}

fn wrap(core: mre::error::Result<Core>) -> PyResult<Recording> {
    Ok(Recording { inner: Arc::new(core.map_err(to_python)?) })
}

fn condition(what: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Condition> {
    Ok(match value {
        None => Condition::Missing,
        Some(value) => match value.extract::<f64>() {
            Ok(number) => Condition::Constant(number),
            Err(_) => Condition::Series(vector(what, value)?),
        },
    })
}

fn to_numpy<'py>(py: Python<'py>, condition: &Condition) -> PyResult<Option<Bound<'py, PyAny>>> {
    Ok(match condition {
        Condition::Missing => None,
        Condition::Constant(value) => Some(value.into_pyobject(py)?.into_any()),
        Condition::Series(values) => Some(PyArray1::from_slice(py, values).into_any()),
    })
}

#[pymethods]
impl Recording {
    #[new]
    #[pyo3(
        signature = (time, displacement, force, *, velocity=None, current=None, temperature=None, simulated=None, name=Text::default()),
        text_signature = "(time, displacement, force, *, velocity=None, current=None, temperature=None, simulated=None, name='')"
    )]
    #[allow(clippy::too_many_arguments)] // the columns of a recording
    fn new(
        time: &Bound<'_, PyAny>,
        displacement: &Bound<'_, PyAny>,
        force: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
        current: Option<&Bound<'_, PyAny>>,
        temperature: Option<&Bound<'_, PyAny>>,
        simulated: Option<&Bound<'_, PyAny>>,
        name: Text,
    ) -> PyResult<Self> {
        let series = Series {
            time: vector("time", time)?,
            displacement: vector("displacement", displacement)?,
            velocity: velocity.map(|v| vector("velocity", v)).transpose()?,
            force: force.map(|v| vector("force", v)).transpose()?,
            simulated: simulated.map(|v| vector("simulated", v)).transpose()?,
            current: condition("current", current)?,
            temperature: condition("temperature", temperature)?,
            name: name.0,
        };
        // A pool of its own: the global one does not survive a fork.
        wrap(in_pool(time.py(), None, None, true, |_| Core::new(series))?.0)
    }

    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    #[getter]
    fn time<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.inner.time())
    }

    #[getter]
    fn displacement<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.inner.displacement())
    }

    #[getter]
    fn velocity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.inner.velocity())
    }

    #[getter]
    fn force<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.inner.force().map(|force| PyArray1::from_slice(py, force))
    }

    #[getter]
    fn simulated<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.inner.simulated().map(|force| PyArray1::from_slice(py, force))
    }

    #[getter]
    fn current<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        to_numpy(py, self.inner.current())
    }

    #[getter]
    fn temperature<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        to_numpy(py, self.inner.temperature())
    }

    #[getter]
    fn current_level(&self) -> Option<f64> {
        self.inner.current().level()
    }

    #[getter]
    fn current_varies(&self) -> bool {
        self.inner.current().varies()
    }

    #[getter]
    fn velocity_window(&self) -> Option<f64> {
        self.inner.velocity_window()
    }

    #[getter]
    fn sampling_rate(&self) -> f64 {
        self.inner.sampling_rate()
    }

    #[getter]
    fn evenly_sampled(&self) -> bool {
        self.inner.evenly_sampled()
    }

    #[getter]
    fn scored(&self) -> (usize, usize) {
        let range = self.inner.scored();
        (range.start, range.end)
    }

    fn __len__(&self) -> usize {
        self.inner.len()
    }

    /// Keep the part from `start` to `stop` (s). What is cut off is forgotten: a simulation starts rested. Of a specimen with
    /// a past, it belongs to that.
    #[pyo3(signature = (start=None, stop=None))]
    fn cut(&self, start: Option<Number>, stop: Option<Number>) -> PyResult<Self> {
        let (start, stop) = (start.map_or(f64::NEG_INFINITY, |s| s.0), stop.map_or(f64::INFINITY, |s| s.0));
        wrap(self.inner.cut(start, stop))
    }

    /// Leave "start_transient", "stop_transient" or both out of the fitness; they stay in simulations.
    /// Found from the strokes between reversals; nothing is left out where the motion is not steady.
    #[pyo3(signature = (*names))]
    fn exclude(&self, names: &Bound<'_, PyTuple>) -> PyResult<Self> {
        let names: Vec<String> = names.extract()?;
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        wrap(transient::exclude(&self.inner, &names))
    }

    /// The same recording of a specimen that has been through others, the first of them first; none for a first one. Wear,
    /// softening that does not come back and ageing then go on from them. Each has to have a force.
    #[allow(clippy::needless_pass_by_value)] // taken over from Python
    fn after(&self, earlier: Vec<Self>) -> PyResult<Self> {
        wrap(self.inner.after(earlier.iter().map(|recording| recording.inner.as_ref())))
    }

    /// The same recording at another current, A, at every sample.
    fn at_current(&self, current: &Bound<'_, PyAny>) -> PyResult<Self> {
        wrap(self.inner.at_current(vector("current", current)?))
    }

    #[getter]
    fn past(&self) -> Option<Through> {
        let mut past = self.inner.past()?;
        Some(fields(&mut past).map(|(name, value)| (name.to_owned(), *value)).into())
    }

    fn __repr__(&self) -> String {
        let time = self.inner.time();
        format!(
            "Recording('{}', {} samples, {} s to {} s, {:.6} Hz)",
            self.inner.name(),
            time.len(),
            time[0],
            time[time.len() - 1],
            self.inner.sampling_rate()
        )
    }

    /// For pickle: the columns, and the window, range and past that they alone do not tell.
    #[staticmethod]
    fn _restore(
        columns: &Bound<'_, PyTuple>,
        keywords: &Bound<'_, PyDict>,
        window: Option<f64>,
        scored: (usize, usize),
        past: Option<Through>,
    ) -> PyResult<Self> {
        let plain = columns.py().get_type::<Self>().call(columns, Some(keywords))?.extract::<Self>()?;
        let past = past.map(|through| {
            let mut past = Past::default();
            for (name, value) in fields(&mut past) {
                *value = through.get(name).copied().unwrap_or_default();
            }
            past
        });
        wrap(plain.inner.with_past(past).restored(window, scored.0..scored.1))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let this = slf.get();
        let keywords = PyDict::new(py);
        keywords.set_item("velocity", this.velocity(py))?;
        keywords.set_item("current", this.current(py)?)?;
        keywords.set_item("temperature", this.temperature(py)?)?;
        keywords.set_item("simulated", this.simulated(py))?;
        keywords.set_item("name", this.name())?;
        let columns = (this.time(py), this.displacement(py), this.force(py));
        let arguments = (columns, keywords, this.inner.velocity_window(), this.scored(), this.past());
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(py)?))
    }
}

/// Each recording with a derived velocity where the recorded one is a difference quotient of the displacement, or all are
/// smoothed; None where it stays.
#[pyfunction]
#[pyo3(signature = (recordings, *, threads=None))]
pub(crate) fn with_slopes(
    py: Python<'_>,
    recordings: Vec<Recording>,
    threads: Option<Whole>,
) -> PyResult<Vec<Option<Recording>>> {
    let inner: Vec<Arc<Core>> = recordings.into_iter().map(|recording| recording.inner).collect();
    let found = in_pool(py, threads, None, true, |_| recording::with_slopes(&inner))?.0;
    let wrapped = |found: Option<Core>| found.map(|core| Recording { inner: Arc::new(core) });
    Ok(found.into_iter().map(wrapped).collect())
}
