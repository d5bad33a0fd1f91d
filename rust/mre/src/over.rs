//! What the levels of a device run over.

use crate::error::{Error, Result};
use crate::recording::{Condition, Recording};

/// What the levels of a device run over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Over {
    /// The coil current, A.
    #[default]
    Current,
    /// The temperature, degC.
    Temperature,
    /// The largest displacement of a recording, mm.
    Amplitude,
}

impl Over {
    /// By its name.
    ///
    /// # Errors
    /// Another name.
    pub fn named(name: &str) -> Result<Self> {
        match name {
            "current" => Ok(Self::Current),
            "temperature" => Ok(Self::Temperature),
            "amplitude" => Ok(Self::Amplitude),
            other => {
                Err(Error::setting("over", format!("'{other}'"), "one of current, temperature, amplitude"))
            }
        }
    }

    /// Its value at every sample of a recording.
    ///
    /// # Errors
    /// The recording does not have it.
    pub(crate) fn of(self, recording: &Recording) -> Result<Vec<f64>> {
        let samples = recording.len();
        let found = match self {
            Self::Current => {
                let current = recording.current();
                let constant =
                    || current.level().and_then(|level| Condition::Constant(level).sampled(samples));
                current.changing().map(<[f64]>::to_vec).or_else(constant)
            }
            Self::Temperature => recording.temperature().sampled(samples),
            Self::Amplitude => {
                let far = recording.displacement().iter().fold(0.0_f64, |far, x| far.max(x.abs()));
                Some(vec![far; samples])
            }
        };
        found.ok_or_else(|| {
            let (name, unit) = if self == Self::Current { ("current", "A") } else { ("temperature", "degC") };
            let text = format!(
                "the model has several levels of {name}, and the recording none: set {name}=VALUE[{unit}]"
            );
            Error::Recording(text).in_recording(recording.name())
        })
    }
}
