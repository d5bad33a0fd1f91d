//! `Swarm`: ask, tell, and run to the end.

use std::cell::RefCell;
use std::sync::{Mutex, MutexGuard};

use mre::parameter::Bounds;
use mre::swarm::{FishSwarm, OfProblem, ParticleSwarm, Stream, Swarm as Core, awake, run};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::{matrix, vector};
use crate::bounds::{read_box, read_start};
use crate::error::{MreError, setting, to_python};
use crate::outcome::{history_to_python, name_of};
use crate::problem::Problem;
use crate::run::{Ended, in_pool};
use crate::scalars::Whole;
use crate::settings::{RunOptions, fish, pso, run_options};
use crate::watch::Watch;

/// A swarm in a box; used once.
#[pyclass(frozen, module = "mre_core._core")]
pub(crate) struct Swarm {
    bounds: Bounds,
    state: Mutex<Box<dyn Core>>,
}

impl Swarm {
    fn lock(&self) -> PyResult<MutexGuard<'_, Box<dyn Core>>> {
        self.state.try_lock().map_err(|_| PyRuntimeError::new_err("this swarm is running in another thread"))
    }

    fn to_physical(&self, unit: &[f64]) -> Vec<f64> {
        let mut physical = vec![0.0; unit.len()];
        self.bounds.to_physical(unit, &mut physical);
        physical
    }

    /// Call a Python function of a generation and check what it returns.
    fn call_function(
        &self,
        py: Python<'_>,
        function: &Py<PyAny>,
        unit: &[f64],
        costs: &mut [f64],
    ) -> PyResult<()> {
        py.check_signals()?;
        let points = matrix(py, &self.to_physical(unit), self.bounds.len())?;
        let returned = function.call1(py, (points,))?;
        let values = vector("the value of the function", returned.bind(py))?;
        if values.len() != costs.len() {
            return Err(MreError::new_err(format!(
                "the function returned {} costs: wanted {}, one for each row",
                values.len(),
                costs.len()
            )));
        }
        costs.copy_from_slice(&values);
        Ok(())
    }
}

#[pymethods]
impl Swarm {
    /// `problem` gives names, bounds and scales, or `lower`, `upper` and `names` do.
    #[new]
    #[pyo3(signature = (kind, settings, seed, *, problem=None, lower=None, upper=None, names=None, start=None))]
    #[allow(clippy::too_many_arguments)] // keyword arguments of one constructor
    fn new(
        kind: &str,
        settings: &Bound<'_, PyDict>,
        seed: u64,
        problem: Option<&Problem>,
        lower: Option<&Bound<'_, PyAny>>,
        upper: Option<&Bound<'_, PyAny>>,
        names: Option<Vec<String>>,
        start: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let bounds = match (problem, lower, upper) {
            (Some(problem), ..) => problem.inner.bounds().clone(),
            (None, Some(lower), Some(upper)) => read_box(lower, upper, names)?,
            _ => return Err(setting("bounds", "missing", "a pair (lower, upper) for each parameter")),
        };
        let start = start
            .map(|x0| {
                let mut unit = vec![0.0; bounds.len()];
                bounds.to_unit(&read_start(x0, bounds.len())?, &mut unit);
                Ok::<_, PyErr>(unit)
            })
            .transpose()?;
        let state: Box<dyn Core> = if kind == "pso" {
            let settings = pso(settings)?;
            Box::new(ParticleSwarm::new(settings, bounds.len(), seed, start.as_deref()).map_err(to_python)?)
        } else {
            let settings = fish(settings)?;
            Box::new(FishSwarm::new(settings, bounds.len(), seed, start.as_deref()).map_err(to_python)?)
        };
        Ok(Self { bounds, state: Mutex::new(state) })
    }

    fn ask<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let unit = self.lock()?.ask().to_vec();
        matrix(py, &self.to_physical(&unit), self.bounds.len())
    }

    fn tell(&self, costs: &Bound<'_, PyAny>) -> PyResult<()> {
        let costs = vector("costs", costs)?;
        let mut state = self.lock()?;
        let wanted = state.asked();
        if costs.len() != wanted || wanted == 0 {
            return Err(setting(
                "number of costs",
                costs.len(),
                &format!("{wanted}, as many as were asked for"),
            ));
        }
        state.tell(&costs);
        Ok(())
    }

    #[getter]
    fn finished(&self) -> PyResult<bool> {
        Ok(self.lock()?.finished())
    }

    /// Best parameters so far and their cost.
    #[getter]
    fn best<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyArray1<f64>>, f64)> {
        let state = self.lock()?;
        let x = self.to_physical(&state.bulletin().position);
        Ok((PyArray1::from_vec(py, x), state.bulletin().cost))
    }

    /// Evaluations so far, and how many of them cost infinity.
    #[getter]
    fn evaluations(&self) -> PyResult<(u64, u64)> {
        let state = self.lock()?;
        Ok((state.bulletin().evaluations, state.bulletin().failures))
    }

    #[getter]
    fn history<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        history_to_python(py, self.lock()?.history())
    }

    #[getter]
    fn behaviours<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let behaviours = self.lock()?.behaviours();
        let dict = PyDict::new(py);
        dict.set_item("search", behaviours.search)?;
        dict.set_item("swarm", behaviours.swarm)?;
        dict.set_item("follow", behaviours.follow)?;
        dict.set_item("random", behaviours.random)?;
        Ok(dict)
    }

    /// Run on a problem, detached from the interpreter; keywords as in `RunOptions`. Returns why it stopped.
    #[pyo3(signature = (problem, **options))]
    fn run_problem(
        &self,
        py: Python<'_>,
        problem: &Problem,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<&'static str> {
        let RunOptions { budget, threads, callback, raise } = run_options(options)?;
        let d = self.bounds.len();
        let mut state = self.lock()?;
        let swarm: &mut dyn Core = &mut **state;
        let (reason, ended) = in_pool(py, threads, callback.as_ref(), raise, |link| {
            let mut fitness = OfProblem { problem: &problem.inner, cancel: link.cancel() };
            let mut monitor = link;
            awake(|| run(swarm, &mut fitness, d, &budget, &mut monitor))
        })?;
        Ok(name_of(reason, ended))
    }

    /// Run on a Python function of a generation, called on this thread; keywords as in `RunOptions`.
    /// Returns why it stopped.
    #[pyo3(signature = (function, **options))]
    #[allow(clippy::needless_pass_by_value)] // taken over from Python
    fn run_function(
        &self,
        py: Python<'_>,
        function: Py<PyAny>,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<&'static str> {
        let RunOptions { budget, callback, raise, .. } = run_options(options)?;
        let failure = RefCell::new(None);
        let mut state = self.lock()?;
        let mut evaluate = |unit: &[f64], costs: &mut [f64]| {
            if let Err(error) = self.call_function(py, &function, unit, costs) {
                costs.fill(f64::NAN);
                *failure.borrow_mut() = Some(error);
            }
        };
        let mut watch = Watch { py, callback: callback.as_ref(), failure: &failure, ended: Ended::ByItself };
        let reason = run(&mut **state, &mut evaluate, self.bounds.len(), &budget, &mut watch);
        let ended = watch.ended;
        match failure.into_inner() {
            Some(error) if raise || !error.is_instance_of::<PyKeyboardInterrupt>(py) => Err(error),
            _ => Ok(name_of(reason, ended)),
        }
    }
}

/// The first numbers of one fish's stream: for tests that repeat a swarm elsewhere.
#[pyfunction]
pub(crate) fn uniforms(py: Python<'_>, seed: u64, stream: usize, count: usize) -> Bound<'_, PyArray1<f64>> {
    let mut stream = Stream::new(seed, stream);
    PyArray1::from_vec(py, (0..count).map(|_| stream.uniform()).collect())
}

/// Eq. 8: `exp(-20 (iteration / iterations)^p)`.
#[pyfunction]
pub(crate) fn inertia_weight(iteration: Whole, iterations: Whole, p: Whole) -> PyResult<f64> {
    let whole = |name, Whole(value): Whole, least| {
        let wanted = format!("a whole number from {least} to 10000000");
        usize::try_from(value)
            .ok()
            .filter(|n| (least..=10_000_000).contains(n))
            .ok_or_else(|| setting(name, value, &wanted))
    };
    let (now, all) = (whole("iteration", iteration, 0)?, whole("iterations", iterations, 1)?);
    let p = u32::try_from(whole("p", p, 0)?).unwrap_or(u32::MAX);
    Ok(mre::swarm::inertia_weight(now, all, p))
}
