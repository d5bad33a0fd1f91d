//! The diagnosis.

use mre::assembly::{Base, Campaign};
use mre::diagnose;
use pyo3::prelude::*;
use serde_json::json;

use crate::error::to_python;
use crate::recording::Recording;
use crate::run::in_pool;

/// Diagnose; the result as JSON.
#[pyfunction]
#[pyo3(signature = (recordings, model, groups, *, false_alarm, seed, threads=None))]
#[allow(clippy::needless_pass_by_value)]
pub(crate) fn diagnose_raw(
    py: Python<'_>,
    recordings: Vec<Recording>,
    model: &str,
    groups: Vec<Vec<usize>>,
    false_alarm: f64,
    seed: u64,
    threads: Option<i64>,
) -> PyResult<String> {
    let recordings: Vec<_> = recordings.into_iter().map(|r| r.inner).collect();
    let (result, _) = in_pool(py, threads, None, true, |_| -> mre::error::Result<String> {
        let campaign = Campaign::new(recordings.clone())?;
        let base = Base::fitted(&recordings, model, &groups)?;
        let rows: Vec<diagnose::Rows> = recordings.iter().map(|r| vec![r.scored()]).collect();
        let t0 = std::time::Instant::now();
        let begun = diagnose::begin(&campaign, &base, &rows);
        let t1 = t0.elapsed().as_secs_f64();
        let named =
            diagnose::name(&begun.assembly, &rows, (&begun.noise, &begun.fitted), false_alarm, seed);
        let t2 = t0.elapsed().as_secs_f64();
        let scores: Vec<_> = named
            .scores
            .iter()
            .map(|s| {
                let about = s.effect.about();
                json!([about.effect, about.law, s.gain, s.p_value, s.visible, s.freedom, s.start])
            })
            .collect();
        let effects: Vec<_> =
            named.assembly.effects().iter().map(|e| json!([e.about().effect, e.about().law])).collect();
        let shapes: Vec<_> = named
            .assembly
            .shapes()
            .iter()
            .zip(named.assembly.physical(&named.fitted.unit))
            .map(|(p, v)| json!([p.name, v]))
            .collect();
        let coefficients: Vec<_> = named
            .assembly
            .coefficients()
            .iter()
            .zip(&named.fitted.coefficients)
            .map(|(p, v)| json!([p.name, v]))
            .collect();
        let steps: Vec<_> = named
            .steps
            .iter()
            .map(|step| {
                step.iter()
                    .map(|c| {
                        let about = c.assembly.effects().last().map(|e| e.about());
                        json!([about.map(|a| a.effect), about.map(|a| a.law), c.fitted.left, c.criterion()])
                    })
                    .collect::<Vec<_>>()
            })
            .collect();
        Ok(json!({
            "effects": effects, "scores": scores, "shapes": shapes, "coefficients": coefficients,
            "base_left": begun.fitted.left, "left": named.fitted.left, "rows": named.fitted.rows,
            "steps": steps, "seconds": [t1, t2],
        })
        .to_string())
    })?;
    result.map_err(to_python)
}
