//! The one error type: what is wrong, where, which value, and what was wanted.

use std::fmt::Display;
use std::sync::atomic::{AtomicBool, Ordering};

use thiserror::Error;

/// Everything that can be wrong with an input or a setting.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// Two series that belong together differ in length.
    #[error("{what} has {got} samples, but time has {expected}: all series need the same length")]
    Length {
        /// Name of the series.
        what: &'static str,
        /// Samples in `time`.
        expected: usize,
        /// Samples found.
        got: usize,
    },
    /// A sample is NaN or infinite.
    #[error("{what} is {value} at sample {index}: every sample has to be a finite number")]
    NotFinite {
        /// Name of the series.
        what: &'static str,
        /// Zero-based sample.
        index: usize,
        /// The value found.
        value: f64,
    },
    /// A sample is so large that nothing measured it: its square would soon overflow.
    #[error("{what} is {value:e} at sample {index}: every sample has to be within {largest:e}")]
    TooLarge {
        /// Name of the series.
        what: &'static str,
        /// Zero-based sample.
        index: usize,
        /// The value found.
        value: f64,
        /// Largest absolute value that is taken.
        largest: f64,
    },
    /// Time stands still or runs backward.
    #[error(
        "time goes from {before} s to {after} s at sample {index}: it has to increase from sample to sample"
    )]
    Time {
        /// Zero-based sample at which time fails to increase.
        index: usize,
        /// Time of the sample before.
        before: f64,
        /// Time at the sample.
        after: f64,
    },
    /// The recording cannot identify anything.
    #[error("{0}")]
    Recording(String),
    /// A setting, bound or option outside what is allowed.
    #[error("{name} is {value}: {wanted}")]
    Setting {
        /// Name of the setting.
        name: String,
        /// The value given, as text.
        value: String,
        /// What is allowed.
        wanted: String,
    },
    /// The caller asked to stop.
    #[error("stopped before it was done")]
    Stopped,
}

impl Error {
    /// Nothing, until the caller has asked to stop.
    pub(crate) fn if_stopped(cancel: &AtomicBool) -> Result<()> {
        if cancel.load(Ordering::Relaxed) { Err(Self::Stopped) } else { Ok(()) }
    }

    /// A setting that is not allowed.
    pub fn setting(name: impl Into<String>, value: impl Display, wanted: impl Into<String>) -> Self {
        Self::Setting { name: name.into(), value: format!("{value}"), wanted: wanted.into() }
    }

    /// The same error with the name of the recording in front.
    #[must_use]
    pub fn in_recording(self, name: &str) -> Self {
        if name.is_empty() { self } else { Self::Recording(format!("recording '{name}': {self}")) }
    }
}

/// Result with the one error type.
pub type Result<T> = std::result::Result<T, Error>;
