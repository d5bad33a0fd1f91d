//! `Swarm`: ask, tell, and run to the end.

use std::cell::RefCell;
use std::sync::{Mutex, MutexGuard};

use mre::parameter::{Bounds, Scale};
use mre::swarm::{
    FishSwarm, History, Monitor, ParticleSwarm, Progress, StopReason, Stream, Swarm as Core, run,
};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::array::{matrix, rows, vector};
use crate::error::{MreError, setting, to_python};
use crate::problem::Problem;
use crate::run::{Ended, call, in_pool, raises};
use crate::settings::{budget, fish, pso};

/// A swarm in a box; used once.
#[pyclass(frozen, module = "mre_core._core")]
pub(crate) struct Swarm {
    bounds: Bounds,
    state: Mutex<Box<dyn Core>>,
}

/// Where an optimisation starts.
pub(crate) fn read_start(x0: &Bound<'_, PyAny>, dimension: usize) -> PyResult<Vec<f64>> {
    let (row, _) = rows("x0", x0, dimension)?;
    match row.iter().find(|value| !value.is_finite()) {
        Some(bad) => Err(setting("x0", bad, "finite numbers")),
        None => Ok(row),
    }
}

/// Columns of a history.
pub(crate) fn history_to_python<'py>(py: Python<'py>, history: &History) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("best", PyArray1::from_slice(py, &history.best))?;
    dict.set_item("mean", PyArray1::from_slice(py, &history.mean))?;
    dict.set_item("evaluations", PyArray1::from_slice(py, &history.evaluations))?;
    dict.set_item("range", PyArray1::from_slice(py, &history.range))?;
    dict.set_item("step", PyArray1::from_slice(py, &history.step))?;
    Ok(dict)
}

/// The name of a reason in Python.
pub(crate) fn name_of(reason: StopReason, ended: Ended) -> &'static str {
    match (reason, ended) {
        (StopReason::Interrupted, Ended::ByCallback) => "callback",
        (StopReason::Interrupted, _) => "interrupted",
        (StopReason::Iterations, _) => "max_iterations",
        (StopReason::Evaluations, _) => "max_evaluations",
        (StopReason::Time, _) => "time_limit",
        (StopReason::Target, _) => "target",
    }
}

impl Swarm {
    fn lock(&self) -> PyResult<MutexGuard<'_, Box<dyn Core>>> {
        self.state.try_lock().map_err(|_| PyRuntimeError::new_err("this swarm is running in another thread"))
    }

    fn to_physical(&self, unit: &[f64]) -> Vec<f64> {
        let d = self.bounds.len();
        let mut physical = vec![0.0; unit.len()];
        for (unit, physical) in unit.chunks_exact(d).zip(physical.chunks_exact_mut(d)) {
            self.bounds.to_physical(unit, physical);
        }
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
            (None, Some(lower), Some(upper)) => {
                let (lower, upper) = (vector("lower", lower)?, vector("upper", upper)?);
                if lower.len() != upper.len() {
                    return Err(setting(
                        "length of upper",
                        upper.len(),
                        &format!("{}, as lower", lower.len()),
                    ));
                }
                let names = names.unwrap_or_else(|| (0..lower.len()).map(|i| format!("x[{i}]")).collect());
                if names.len() != lower.len() {
                    return Err(setting(
                        "number of names",
                        names.len(),
                        &format!("{}, one a bound", lower.len()),
                    ));
                }
                let scale = vec![Scale::Linear; lower.len()];
                Bounds::new(&names, lower, upper, scale).map_err(to_python)?
            }
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
        let wanted = state.ask().len() / self.bounds.len();
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

    /// Run on a problem, detached from the interpreter. Returns why it stopped.
    #[pyo3(signature = (problem, *, max_evaluations=None, time_limit=None, target=None, threads=None, callback=None, on_interrupt="raise"))]
    #[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)]
    fn run_problem(
        &self,
        py: Python<'_>,
        problem: &Problem,
        max_evaluations: Option<i64>,
        time_limit: Option<f64>,
        target: Option<f64>,
        threads: Option<i64>,
        callback: Option<Py<PyAny>>,
        on_interrupt: &str,
    ) -> PyResult<&'static str> {
        let budget = budget(max_evaluations, time_limit, target)?;
        let raise = raises(on_interrupt)?;
        let d = self.bounds.len();
        let mut state = self.lock()?;
        let swarm: &mut dyn Core = &mut **state;
        let (reason, ended) = in_pool(py, threads, callback.as_ref(), raise, |link| {
            let mut physical = Vec::new();
            let mut evaluate = |unit: &[f64], costs: &mut [f64]| {
                physical.resize(unit.len(), 0.0);
                for (unit, physical) in unit.chunks_exact(d).zip(physical.chunks_exact_mut(d)) {
                    self.bounds.to_physical(unit, physical);
                }
                problem.inner.fitness(&physical, costs, link.cancel());
            };
            let mut monitor = link;
            run(swarm, &mut evaluate, d, &budget, &mut monitor)
        })?;
        Ok(name_of(reason, ended))
    }

    /// Run on a Python function of a generation, called on this thread. Returns why it stopped.
    #[pyo3(signature = (function, *, max_evaluations=None, time_limit=None, target=None, callback=None, on_interrupt="raise"))]
    #[allow(clippy::too_many_arguments, clippy::needless_pass_by_value)]
    fn run_function(
        &self,
        py: Python<'_>,
        function: Py<PyAny>,
        max_evaluations: Option<i64>,
        time_limit: Option<f64>,
        target: Option<f64>,
        callback: Option<Py<PyAny>>,
        on_interrupt: &str,
    ) -> PyResult<&'static str> {
        let budget = budget(max_evaluations, time_limit, target)?;
        let raise = raises(on_interrupt)?;
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

/// Watches a run on a Python function, on the thread that runs it.
struct Watch<'a, 'py> {
    py: Python<'py>,
    callback: Option<&'a Py<PyAny>>,
    failure: &'a RefCell<Option<PyErr>>,
    ended: Ended,
}

impl Monitor for Watch<'_, '_> {
    fn broken_off(&self) -> bool {
        self.failure.borrow().is_some()
    }

    fn go_on(&mut self, progress: Progress) -> bool {
        if self.broken_off() {
            return false;
        }
        match self.callback.map_or(Ok(false), |callback| call(self.py, callback, progress)) {
            Ok(false) => return true,
            Ok(true) => self.ended = Ended::ByCallback,
            Err(error) => *self.failure.borrow_mut() = Some(error),
        }
        false
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
pub(crate) fn inertia_weight(iteration: usize, iterations: usize, p: u32) -> f64 {
    mre::swarm::inertia_weight(iteration, iterations, p)
}
