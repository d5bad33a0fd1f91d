//! The Python module `mre_core._core`: arrays in, arrays out, errors, signals. No mathematics.

#![allow(clippy::doc_markdown)] // docstrings are read in Python, in the form of numpydoc

use pyo3::prelude::*;

mod array;
mod bounds;
mod device;
mod diagnose;
mod effects;
mod error;
mod fit;
mod outcome;
mod problem;
mod recording;
mod run;
mod scalars;
mod settings;
mod stream;
mod swarm;
mod uncertainty;
mod watch;

#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::device::{check, classical, models, parameters, simulate};
    #[pymodule_export]
    use crate::diagnose::{diagnose_recordings, excitation};
    #[pymodule_export]
    use crate::effects::{catalogue, check_effect, effect_parameters};
    #[pymodule_export]
    use crate::error::MreError;
    #[pymodule_export]
    use crate::fit::{certify, check_certifiable, exact_is_quick, fit_exact, fit_hybrid};
    #[pymodule_export]
    use crate::problem::Problem;
    #[pymodule_export]
    use crate::recording::{Recording, with_slopes};
    #[pymodule_export]
    use crate::swarm::{Swarm, inertia_weight, uniforms};
    #[pymodule_export]
    use crate::uncertainty::{fit_bootstrap, fit_profile, fit_uncertainty, noise_products};

    use super::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
