//! Samples of an iterable, chunk by chunk.

use mre::error::Error;
use mre::fitness::{Problem, Stream};
use pyo3::prelude::*;

use crate::array::vector;
use crate::error::{setting, to_python};
use crate::recording::Recording;
use crate::run::in_pool;
use crate::scalars::Whole;

/// The problem of all chunks.
pub(crate) fn read(
    py: Python<'_>,
    chunks: &Bound<'_, PyAny>,
    largest_displacement: f64,
    bounds: &[(String, f64, f64)],
    threads: Option<Whole>,
) -> PyResult<Problem> {
    let mut stream = Stream::new(largest_displacement, bounds).map_err(to_python)?;
    for chunk in chunks.try_iter()? {
        let chunk = Chunk::read(&chunk?)?;
        in_pool(py, threads, None, true, |_| chunk.pass_to(&mut stream))?.0.map_err(to_python)?;
    }
    in_pool(py, threads, None, true, |_| stream.into_problem())?.0.map_err(to_python)
}

enum Chunk {
    Recording(Recording),
    /// Displacement, velocity, force.
    Series([Vec<f64>; 3]),
}

impl Chunk {
    fn read(chunk: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(recording) = chunk.extract::<Recording>() {
            return Ok(Self::Recording(recording));
        }
        let Ok((displacement, velocity, force)) =
            chunk.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>, Bound<'_, PyAny>)>()
        else {
            let found = chunk.get_type().name()?;
            return Err(setting("chunk", found, "a Recording, or a tuple (displacement, velocity, force)"));
        };
        Ok(Self::Series([
            vector("displacement", &displacement)?,
            vector("velocity", &velocity)?,
            vector("force", &force)?,
        ]))
    }

    fn pass_to(&self, stream: &mut Stream) -> Result<(), Error> {
        match self {
            Self::Series([displacement, velocity, force]) => stream.absorb(displacement, velocity, force),
            Self::Recording(recording) => {
                let (recording, scored) = (&recording.inner, recording.inner.scored());
                let Some(force) = recording.force() else {
                    let text = "no force: an identification needs one";
                    return Err(Error::Recording(text.into()).in_recording(recording.name()));
                };
                let motion = [recording.displacement(), recording.velocity(), force];
                let [displacement, velocity, force] = motion.map(|series| &series[scored.clone()]);
                stream.absorb(displacement, velocity, force)
            }
        }
    }
}
