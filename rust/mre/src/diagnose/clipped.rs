//! Samples of a clipped force: they tell only that it is beyond the level.

use crate::assembly::{Assembly, Columns};

/// Samples whose modelled force is beyond the level.
pub(super) fn clipped(columns: &Columns, coefficients: &[f64]) -> Vec<bool> {
    columns.clip.map_or_else(Vec::new, |(low, high)| {
        columns.force(coefficients).iter().map(|f| *f <= low || *f >= high).collect()
    })
}

/// Samples whose measured force is near the level, before there is a modelled one.
pub(super) fn clipped_as_measured(assembly: &Assembly, raw: &[Columns]) -> Vec<Vec<bool>> {
    let recordings = assembly.campaign().recordings();
    raw.iter()
        .zip(recordings)
        .map(|(c, r)| {
            c.clip.map_or_else(Vec::new, |(low, high)| {
                let margin = 0.02 * (high - low);
                let measured = r.force().unwrap_or_default();
                measured.iter().map(|f| *f <= low + margin || *f >= high - margin).collect()
            })
        })
        .collect()
}
