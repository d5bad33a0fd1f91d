//! The only doors for work, detached from the interpreter: a small job on the calling thread, a long one in
//! its own thread pool, with Ctrl-C answered and progress reported from the calling thread.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use mre::diagnose::{self, Stage};
use mre::swarm::{Monitor, Progress};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;

use crate::error::setting;
use crate::scalars::Whole;

const POLL: Duration = Duration::from_millis(50);

/// What a job and the thread that waits for it tell each other.
#[derive(Default)]
pub(crate) struct Link {
    cancel: AtomicBool,
    news: Mutex<Vec<News>>,
}

impl Link {
    /// Set when the job should end soon.
    pub(crate) fn cancel(&self) -> &AtomicBool {
        &self.cancel
    }

    fn take(&self) -> Vec<News> {
        self.news.lock().map(|mut news| std::mem::take(&mut *news)).unwrap_or_default()
    }
}

impl Monitor for &Link {
    fn broken_off(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    fn go_on(&mut self, progress: Progress) -> bool {
        if let Ok(mut news) = self.news.lock() {
            // Only the latest matters.
            news.clear();
            news.push(News::Progress(progress));
        }
        !self.broken_off()
    }
}

impl diagnose::Monitor for Link {
    fn broken_off(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    fn begins(&self, stage: Stage) {
        if let Ok(mut news) = self.news.lock() {
            news.push(News::Stage(stage));
        }
    }
}

/// What a job tells a callback.
pub(crate) enum News {
    /// After an iteration: `(iteration, evaluations, best)`; something true asks to stop.
    Progress(Progress),
    /// When a stage of a diagnosis begins: what it does, in words.
    Stage(Stage),
}

impl News {
    /// Call the callback. True when it asks to stop.
    pub(crate) fn tell(&self, py: Python<'_>, callback: &Py<PyAny>) -> PyResult<bool> {
        match self {
            Self::Progress(p) => callback.call1(py, (p.iteration, p.evaluations, p.best))?.is_truthy(py),
            Self::Stage(stage) => callback.call1(py, (stage.to_string(),)).map(|_| false),
        }
    }
}

/// Who ended a job early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ended {
    /// Nobody.
    ByItself,
    /// Ctrl-C.
    Interrupted,
    /// The callback returned something true.
    ByCallback,
}

/// Run a job on the calling thread: for one that no pool would make shorter, and that takes no part in
/// Ctrl-C, because nothing could end it early.
pub(crate) fn here<R: Send>(
    py: Python<'_>,
    threads: Option<Whole>,
    job: impl FnOnce(&Link) -> R + Send,
) -> PyResult<R> {
    count(threads)?;
    Ok(py.detach(|| job(&Link::default())))
}

/// Who has ended a job by now: a signal is raised, unless it is Ctrl-C and `raise` is false.
pub(crate) fn by_signal(py: Python<'_>, raise: bool) -> PyResult<Ended> {
    match py.check_signals() {
        Ok(()) => Ok(Ended::ByItself),
        Err(error) if !raise && error.is_instance_of::<PyKeyboardInterrupt>(py) => Ok(Ended::Interrupted),
        Err(error) => Err(error),
    }
}

/// The number of threads for rayon.
fn count(threads: Option<Whole>) -> PyResult<usize> {
    match threads {
        None => Ok(0), // rayon: as many as the machine has
        Some(Whole(n @ 1..=1024)) => Ok(n as usize),
        Some(Whole(n)) => Err(setting("threads", n, "a whole number from 1 to 1024")),
    }
}

/// Run a job in a pool of its own. A signal or an exception in the callback stops it and is raised,
/// unless the signal is Ctrl-C and `raise` is false.
///
/// No pool is kept: its sleeping threads would be lost, with their locks, in a process that is forked.
pub(crate) fn in_pool<R: Send>(
    py: Python<'_>,
    threads: Option<Whole>,
    callback: Option<&Py<PyAny>>,
    raise: bool,
    job: impl FnOnce(&Link) -> R + Send,
) -> PyResult<(R, Ended)> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(count(threads)?)
        .build()
        .map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    let link = Link::default();
    let mut result = None;
    let (failure, mut ended) = py.detach(|| {
        pool.in_place_scope(|scope| {
            let (done, wait) = channel::<()>();
            let (link, result) = (&link, &mut result);
            scope.spawn(move |_| {
                *result = catch_unwind(AssertUnwindSafe(|| job(link))).ok();
                drop(done);
            });
            let (mut failure, mut ended) = (None, Ended::ByItself);
            while wait.recv_timeout(POLL) == Err(RecvTimeoutError::Timeout) {
                if failure.is_none() && ended == Ended::ByItself {
                    match Python::attach(|py| attend(py, link, callback)) {
                        Ok(false) => {}
                        Ok(true) => ended = Ended::ByCallback,
                        Err(error) => failure = Some(error),
                    }
                    if failure.is_some() || ended != Ended::ByItself {
                        link.cancel.store(true, Ordering::Relaxed);
                    }
                }
            }
            (failure, ended)
        })
    });
    let Some(result) = result else {
        return Err(PyRuntimeError::new_err("a worker thread failed; please report this with its input"));
    };
    let last = if failure.is_none() { attend(py, &link, callback).err() } else { failure };
    match last {
        Some(error) if !raise && error.is_instance_of::<PyKeyboardInterrupt>(py) => {
            ended = Ended::Interrupted;
        }
        Some(error) => return Err(error),
        None => {}
    }
    Ok((result, ended))
}

/// Signals, then news for the callback. True when the callback asks to stop.
fn attend(py: Python<'_>, link: &Link, callback: Option<&Py<PyAny>>) -> PyResult<bool> {
    py.check_signals()?;
    let Some(callback) = callback else { return Ok(false) };
    for news in link.take() {
        if news.tell(py, callback)? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// "raise" or "return".
pub(crate) fn raises(on_interrupt: &str) -> PyResult<bool> {
    match on_interrupt {
        "raise" => Ok(true),
        "return" => Ok(false),
        other => Err(setting("on_interrupt", format!("'{other}'"), "'raise' or 'return'")),
    }
}
