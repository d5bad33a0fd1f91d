//! Models by name, and the simulation of an identified device.

use mre::assembly::{self, Source};
use mre::device::{Device, Level};
use mre::extent::Extent;
use mre::model::{self, Model};
use mre::over::Over;
use mre::physics::Classical;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::effects::{self, Given};
use crate::error::{setting, to_python};
use crate::recording::Recording;
use crate::run::in_pool;
use crate::scalars::Whole;

/// Names of the models.
#[pyfunction]
pub(crate) fn models() -> Vec<&'static str> {
    model::names()
}

/// Names and units of a model's parameters.
#[pyfunction]
pub(crate) fn parameters(model: &str) -> PyResult<Vec<(String, &'static str)>> {
    let model = Model::named(model).map_err(to_python)?;
    Ok(model.parameters(&Extent::UNIT).into_iter().map(|p| (p.name, p.unit)).collect())
}

/// Name of a model that is the user's own simulation.
const SIMULATED: &str = "simulated";

pub(crate) type Levels = Vec<(Option<f64>, Vec<f64>)>;

pub(crate) fn device(model: &str, levels: Levels, over: &str) -> PyResult<Device> {
    let over = Over::named(over).map_err(to_python)?;
    let levels = levels.into_iter().map(|(current, values)| Level { current, values }).collect();
    let device = Device::new(Model::named(model).map_err(to_python)?, levels).map_err(to_python)?;
    Ok(device.running_over(over))
}

/// Check a model's parameters at levels of the current.
#[pyfunction]
pub(crate) fn check(model: &str, levels: Levels) -> PyResult<()> {
    device(model, levels, "current").map(|_| ())
}

/// Restoring force in N of a model with parameters at levels of the current, or the simulated one of the
/// recording, with effects. `over` says what the levels are of. Effects are `(id, law, coefficients, shapes)`;
/// `sizes` are those of the recordings that they were fitted to.
#[pyfunction]
#[pyo3(signature = (model, levels, recording, effects=Vec::new(), sizes=None, over="current"))]
#[allow(clippy::needless_pass_by_value)] // taken over from Python
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    model: &str,
    levels: Levels,
    recording: Recording,
    effects: Vec<Given>,
    sizes: Option<Bound<'py, PyMapping>>,
    over: &str,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let device = if model == SIMULATED { None } else { Some(device(model, levels, over)?) };
    let source = device.as_ref().map_or(Source::Simulated, Source::Device);
    let additions = effects.into_iter().map(effects::addition).collect::<PyResult<Vec<_>>>()?;
    let sizes = match sizes {
        Some(sizes) => effects::sizes(&sizes)?,
        None if additions.is_empty() => effects::any_sizes(),
        None => return Err(setting("sizes", "missing", "the sizes of the recordings behind the effects")),
    };
    // A pool of its own: the global one does not survive a fork.
    let job = |_: &_| assembly::simulate(source, &additions, &sizes, &recording.inner);
    let force = in_pool(py, Some(Whole(1)), None, true, job)?.0.map_err(to_python)?;
    Ok(PyArray1::from_vec(py, force))
}

/// `(k0, alpha, A, beta, gamma)` of eq. 1 and 2 from the normalised Bouc-Wen parameters.
#[pyfunction]
pub(crate) fn classical(kx: f64, kw: f64, rho: f64, sigma: f64, n: f64) -> (f64, Option<f64>, f64, f64, f64) {
    let c = Classical::from_normalised(kx, kw, rho, sigma, n);
    (c.k0, c.alpha, 1.0, c.beta, c.gamma)
}
