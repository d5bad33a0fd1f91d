//! The diagnosis: recordings in, JSON and force histories out.

mod describe;

use std::collections::BTreeMap;

use describe::After;
use mre::assembly::{Base, Campaign, Kept, temperature_known};
use mre::diagnose::{self, GivenLimits, KINDS, Limits, Monitor, Settings, Stage};
use mre::error::{Error, Result};
use numpy::PyArray1;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyMapping;

use crate::array::numpy_is_there;
use crate::device::{self, Levels};
use crate::effects::{self, Given, law_of};
use crate::error::to_python;
use crate::recording::Recording;
use crate::run::{in_pool, raises};
use crate::scalars::Whole;

type Forces<'py> = Vec<Bound<'py, PyArray1<f64>>>;

/// Diagnose recordings: `(JSON, base force and final force of every recording)`.
///
/// `groups` are the places of recordings that share parameters of the model. Where `held` has levels, of the current
/// or of what else `over` says, the model keeps them; where `given` has a force for every recording, that force is the
/// base instead of the model; `held_effects` as for a simulation, with their `sizes`, are kept with them.
/// `base_effects` are `(id, law, shapes to start from)` of effects that belong to the base, `without` ids of effects
/// that are ruled out; `limits` (stroke, speed, highest, duration) and `limit_current` are those of the next test. So
/// many `blank` campaigns are diagnosed after that. `on_stage` is called with each stage in words. Where Ctrl-C ends it
/// and is not to be raised, what is known by then is returned; it is raised where that is nothing.
#[pyfunction]
#[pyo3(signature = (recordings, model, groups, *, false_alarm, seed, held=None, over="current", held_effects=Vec::new(), sizes=None, given=None, base_effects=Vec::new(), without=Vec::new(), limits=BTreeMap::new(), limit_current=None, blank=0, threads=None, on_stage=None, on_interrupt="raise"))]
#[allow(clippy::needless_pass_by_value, clippy::too_many_arguments)]
pub(crate) fn diagnose_recordings<'py>(
    py: Python<'py>,
    recordings: Vec<Recording>,
    model: &str,
    groups: Vec<Vec<usize>>,
    false_alarm: f64,
    seed: u64,
    held: Option<Levels>,
    over: &str,
    held_effects: Vec<Given>,
    sizes: Option<Bound<'py, PyMapping>>,
    given: Option<Vec<Vec<f64>>>,
    base_effects: Vec<(String, String, Vec<f64>)>,
    without: Vec<String>,
    limits: BTreeMap<String, f64>,
    limit_current: Option<(f64, f64)>,
    blank: usize,
    threads: Option<Whole>,
    on_stage: Option<Py<PyAny>>,
    on_interrupt: &str,
) -> PyResult<(String, Forces<'py>, Forces<'py>)> {
    let recordings: Vec<_> = recordings.into_iter().map(|r| r.inner).collect();
    let held = held.map(|levels| device::device(model, levels, over)).transpose()?;
    let kept = held_effects.into_iter().map(effects::addition).collect::<PyResult<Vec<_>>>()?;
    let sizes = sizes.map(|sizes| effects::sizes(&sizes)).transpose()?;
    let own = base_effects
        .into_iter()
        .map(|(id, law, shapes)| Ok((law_of(&id, &law)?, shapes)))
        .collect::<PyResult<Vec<_>>>()?;
    let raise = raises(on_interrupt)?;
    let (result, _) = in_pool(
        py,
        threads,
        on_stage.as_ref(),
        raise,
        |link| -> Result<Option<(String, Histories, Histories)>> {
            let mut campaign = Campaign::new(recordings.clone())?;
            if let Some(sizes) = &sizes {
                // Effects of one model have one set of sizes.
                campaign = campaign.sized(sizes);
            }
            if held.is_some() || given.is_some() {
                let sizes = campaign.sizes().clone().of_one_device();
                campaign = campaign.sized(&sizes);
            }
            let of_the_base = kept.iter().map(|k| k.effect).chain(own.iter().map(|(effect, _)| *effect));
            recordings.iter().try_for_each(|r| temperature_known(of_the_base.clone(), r))?;
            let base = match (held, given) {
                (Some(device), _) => Base::Held(match sizes {
                    Some(sizes) => Kept::with_effects(device, kept, sizes),
                    None => Kept::new(device),
                }),
                (None, Some(force)) => Base::Given(force),
                (None, None) => Base::fitted(campaign.recordings(), model, &groups)?,
            };
            let limit = |name: &str| limits.get(name).copied();
            let limits = GivenLimits {
                stroke: limit("stroke"),
                speed: limit("speed"),
                highest: limit("highest"),
                duration: limit("duration"),
                current: limit_current,
            };
            let settings = Settings { limits, ..Settings::new(false_alarm, seed, &without, &base) };
            let Some(found) = diagnose::run(&campaign, &base, &own, &settings, link) else { return Ok(None) };
            let found = diagnose::beside_refitted(found, &groups, link.cancel(), link);
            let blanks = match blank {
                0 => None,
                count => Some(diagnose::blank(&found, &base, &own, &settings, count, link)?),
            };
            link.begins(Stage::Done);
            let after = After { blanks, broken_off: link.broken_off() };
            let text = describe::describe(&found, &base, own.len(), &after).to_string();
            Ok(Some((text, found.base_force, found.final_force)))
        },
    )?;
    let found = result.map_err(to_python)?;
    let (text, base, last) = found.ok_or_else(|| PyKeyboardInterrupt::new_err(()))?;
    let arrays = |forces: Histories| forces.into_iter().map(|force| PyArray1::from_vec(py, force)).collect();
    Ok((text, arrays(base), arrays(last)))
}

type Histories = Vec<Vec<f64>>;

/// Command signal of an excitation: `(time in s, displacement in mm, current in A or None)`.
#[pyfunction]
#[pyo3(signature = (kind, *, stroke, speed, highest, duration, rate, current=None))]
#[allow(clippy::type_complexity, clippy::too_many_arguments)]
pub(crate) fn excitation<'py>(
    py: Python<'py>,
    kind: &str,
    stroke: f64,
    speed: f64,
    highest: f64,
    duration: f64,
    rate: f64,
    current: Option<(f64, f64)>,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>, Option<Bound<'py, PyArray1<f64>>>)> {
    numpy_is_there(py)?;
    let known = KINDS.iter().find(|k| k.id() == kind);
    let limits = Limits { stroke, speed, highest, duration, rate, current };
    let signal = known.and_then(|k| k.signal(&limits, 1)).ok_or_else(|| {
        let ids: Vec<&str> = KINDS.iter().map(|k| k.id()).collect();
        to_python(Error::setting("excitation", format!("'{kind}'"), format!("one of {}", ids.join(", "))))
    })?;
    Ok((
        PyArray1::from_vec(py, signal.time),
        PyArray1::from_vec(py, signal.displacement),
        signal.current.map(|current| PyArray1::from_vec(py, current)),
    ))
}
