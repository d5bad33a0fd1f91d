//! A run on a Python function: the interpreter is attached all the time.

use std::cell::RefCell;

use mre::swarm::{Monitor, Progress};
use pyo3::prelude::*;

use crate::run::{Ended, News};

/// Watches a run on a Python function, on the thread that runs it.
pub(crate) struct Watch<'a, 'py> {
    pub(crate) py: Python<'py>,
    pub(crate) callback: Option<&'a Py<PyAny>>,
    pub(crate) failure: &'a RefCell<Option<PyErr>>,
    pub(crate) ended: Ended,
}

impl Monitor for Watch<'_, '_> {
    fn broken_off(&self) -> bool {
        self.failure.borrow().is_some()
    }

    fn go_on(&mut self, progress: Progress) -> bool {
        if self.broken_off() {
            return false;
        }
        match self.callback.map_or(Ok(false), |callback| News::Progress(progress).tell(self.py, callback)) {
            Ok(false) => return true,
            Ok(true) => self.ended = Ended::ByCallback,
            Err(error) => *self.failure.borrow_mut() = Some(error),
        }
        false
    }
}
