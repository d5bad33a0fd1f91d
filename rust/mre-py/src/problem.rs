//! `Problem`: the fitness of a model on recordings.

use std::sync::Arc;

use mre::fitness::{Problem as Core, Weights, is_small};
use mre::model::Model;
use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array;
use crate::bounds::by_name;
use crate::error::{setting, to_python};
use crate::recording::Recording;
use crate::run::{Link, here, in_pool};
use crate::scalars::{Number, Text, Whole};
use crate::stream;

/// Fitness of a model's parameters on recordings: eq. 5 of Yu, Li and Li (ISARC 2014); immutable.
///
/// All recordings share the parameters, whatever their constant current; where the current changes
/// within one of them, the coefficients are affine in the current and have two values each.
///
/// Parameters
/// ----------
/// recordings : Recording or sequence of them
///     With force.
/// model : {"sinh", "bouc_wen", "kelvin_voigt"}
///     The model.
/// bounds : mapping of name to (lower, upper), optional
///     Bounds that replace default ones, which follow from the recordings.
/// weights : {"samples", "force"} or array, shape (number of recordings,), optional
///     Every sample counts the same, or every recording by the inverse of its mean squared force, or by
///     the given weight. The fitness stays a mean over all samples, in N^2.
///
/// Raises
/// ------
/// MreError
///     No recording, a recording without force, an unknown model or parameter, bounds that are reversed
///     or not admissible, weights that are not positive (a ValueError).
#[pyclass(frozen, module = "mre_core._core")]
pub(crate) struct Problem {
    pub(crate) inner: Arc<Core>,
    recordings: Vec<Recording>,
}

type NewArguments<'py> = ((Vec<Recording>, &'static str, Bound<'py, PyDict>), Bound<'py, PyDict>);

fn to_weights(value: Option<&Bound<'_, PyAny>>) -> PyResult<Weights> {
    let Some(value) = value else { return Ok(Weights::Samples) };
    match value.extract::<String>() {
        Ok(name) if name == "force" => Ok(Weights::Force),
        Ok(name) if name == "samples" => Ok(Weights::Samples),
        Ok(name) => {
            Err(setting("weights", format!("'{name}'"), "'samples', 'force', or one number a recording"))
        }
        Err(_) => Ok(Weights::Given(array::vector("weights", value)?)),
    }
}

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(
        signature = (recordings, model=Text("sinh".into()), bounds=None, *, weights=None),
        text_signature = "(recordings, model='sinh', bounds=None, *, weights=None)"
    )]
    fn new(
        py: Python<'_>,
        recordings: &Bound<'_, PyAny>,
        model: Text,
        bounds: Option<&Bound<'_, PyAny>>,
        weights: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let recordings = match recordings.extract::<Recording>() {
            Ok(single) => vec![single],
            Err(_) => recordings.extract::<Vec<Recording>>()?,
        };
        let Text(model) = model;
        let model = Model::named(&model).map_err(to_python)?;
        let bounds = by_name(bounds)?;
        let weights = to_weights(weights)?;
        let cores: Vec<_> = recordings.iter().map(|r| Arc::clone(&r.inner)).collect();
        let small = is_small(&cores);
        let job = |_: &Link| Core::new(cores, model, &bounds, &weights);
        // A pool of its own: the global one does not survive a fork.
        let made = if small { here(py, None, job)? } else { in_pool(py, None, None, true, job)?.0 };
        let inner = made.map_err(to_python)?;
        Ok(Self { inner: Arc::new(inner), recordings })
    }

    /// Problem of the sinh model from samples that pass by once and are not kept.
    ///
    /// Every sample counts the same. Memory does not grow with their number, and an evaluation costs what
    /// it costs on a few thousand. What has to be known beforehand is the largest displacement and, through it or as a
    /// bound, the largest beta: they decide the polynomials by which sinh is represented. The default
    /// box is that of `Problem` with the largest displacement given here.
    ///
    /// Parameters
    /// ----------
    /// chunks : iterable of Recording or of (displacement, velocity, force)
    ///     Recordings, of which the scored samples count, or three arrays of shape (n,) in mm, mm/s and N
    ///     with any n, such as `read_chunks` gives. The result does not depend on where they are cut.
    /// largest_displacement : float
    ///     mm; no displacement may be larger in absolute value.
    /// bounds : mapping of name to (lower, upper), optional
    ///     As in `Problem`; beta at most 25 / largest_displacement.
    /// threads : int, optional
    ///     All cores by default. The result does not depend on it.
    ///
    /// Returns
    /// -------
    /// Problem
    ///     Without recordings. Its fitness is infinite for a beta above its bound. It cannot be pickled.
    ///
    /// Raises
    /// ------
    /// MreError
    ///     A chunk, the largest displacement or a bound is not usable (a ValueError).
    #[staticmethod]
    #[pyo3(signature = (chunks, largest_displacement, bounds=None, *, threads=None))]
    fn streamed(
        py: Python<'_>,
        chunks: &Bound<'_, PyAny>,
        largest_displacement: Number,
        bounds: Option<&Bound<'_, PyAny>>,
        threads: Option<Whole>,
    ) -> PyResult<Self> {
        let core = stream::read(py, chunks, largest_displacement.0, &by_name(bounds)?, threads)?;
        Ok(Self { inner: Arc::new(core), recordings: Vec::new() })
    }

    #[getter]
    fn model(&self) -> &'static str {
        self.inner.model().name()
    }

    #[getter]
    fn recordings(&self) -> Vec<Recording> {
        self.recordings.clone()
    }

    #[getter]
    fn names(&self) -> Vec<&str> {
        self.inner.parameters().iter().map(|p| p.name.as_str()).collect()
    }

    #[getter]
    fn units(&self) -> Vec<&'static str> {
        self.inner.parameters().iter().map(|p| p.unit).collect()
    }

    /// Smallest and largest admissible value of every parameter, whatever the box.
    #[getter]
    fn limits(&self) -> Vec<(f64, f64)> {
        self.inner.parameters().iter().map(|p| (p.smallest, p.largest)).collect()
    }

    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.inner.bounds().lower())
    }

    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.inner.bounds().upper())
    }

    /// Fitness in N^2 of one candidate, shape (d,), or of rows of them, shape (n, d); infinite where a
    /// candidate cannot be simulated. The result does not depend on the number of threads.
    #[pyo3(signature = (x, *, threads=None))]
    fn fitness<'py>(
        &self,
        py: Python<'py>,
        x: &Bound<'py, PyAny>,
        threads: Option<Whole>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (rows, single) = array::rows("x", x, self.inner.parameters().len())?;
        let count = rows.len() / self.inner.parameters().len();
        let job = |link: &Link| {
            let mut costs = vec![0.0; count];
            self.inner.fitness(&rows, &mut costs, link.cancel());
            costs
        };
        let costs = if self.inner.on_one_thread(count) {
            here(py, threads, job)?
        } else {
            in_pool(py, threads, None, true, job)?.0
        };
        if single {
            return Ok(costs[0].into_pyobject(py)?.into_any());
        }
        Ok(PyArray1::from_vec(py, costs).into_any())
    }

    /// Levels of current and the model's parameters at them, for one candidate.
    #[pyo3(signature = (x, current=None))]
    fn levels(
        &self,
        x: &Bound<'_, PyAny>,
        current: Option<Number>,
    ) -> PyResult<Vec<(Option<f64>, Vec<f64>)>> {
        let (row, _) = array::rows("x", x, self.inner.parameters().len())?;
        Ok(self
            .inner
            .law()
            .levels(&row, current.map(|i| i.0))
            .into_iter()
            .map(|l| (l.current, l.values))
            .collect())
    }

    /// -1, 0 or 1 for every parameter: on its lower bound, inside, on its upper bound.
    fn on_bound(&self, x: &Bound<'_, PyAny>) -> PyResult<Vec<i8>> {
        let (row, _) = array::rows("x", x, self.inner.parameters().len())?;
        Ok(self.inner.bounds().on_bound(&row))
    }

    /// For pickle.
    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<NewArguments<'py>> {
        if self.recordings.is_empty() {
            return Err(PyTypeError::new_err("a streamed problem keeps no samples: it cannot be pickled"));
        }
        let bounds = PyDict::new(py); // in their order: the same problem, the same bytes
        for p in self.inner.parameters() {
            bounds.set_item(&p.name, (p.lower, p.upper))?;
        }
        let keywords = PyDict::new(py);
        keywords.set_item("weights", PyArray1::from_slice(py, self.inner.weights()))?;
        Ok(((self.recordings(), self.model(), bounds), keywords))
    }

    fn __repr__(&self) -> String {
        let from = match self.recordings.len() {
            0 => format!("{} samples streamed", self.inner.samples()),
            1 => "1 recording".into(),
            count => format!("{count} recordings"),
        };
        format!("Problem({}, {from})", self.inner.model().name())
    }
}
