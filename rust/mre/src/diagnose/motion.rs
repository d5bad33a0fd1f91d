//! Functions of the motion of a recording that the size of its noise does not follow.

use std::ops::Range;

use crate::effect::Scene;

/// Stretches of the displacement.
const ACROSS: usize = 8;
/// Stretches of the time of each recording.
const LONG: usize = 6;
/// Columns: the ends of the stretches, the squares of velocity and acceleration, and the sizes of the motion around.
pub(super) const COLUMNS: usize = ACROSS + LONG + 6;
/// The sizes of the motion around are over so many seconds on either side.
const AROUND: f64 = 1.0;

/// Hats over the displacement and over time, the squares of velocity and acceleration, over their largest, and the
/// mean squares of displacement and velocity around.
pub(super) fn functions_of_the_motion(scene: &Scene, rows: Range<usize>) -> Vec<Vec<f64>> {
    let sizes = scene.sizes;
    let (x, v) = (&scene.displacement[rows.clone()], &scene.velocity[rows]);
    let last = v.len() - 1;
    let place = |i: usize| (x[i] / sizes.displacement + 1.0) * 0.5 * ACROSS as f64;
    let moment = |i: usize| (LONG * i) as f64 / last as f64;
    let slope = |i: usize| v[(i + 1).min(last)] - v[i.saturating_sub(1)];
    let square = |values: Vec<f64>| {
        let largest = values.iter().fold(f64::MIN_POSITIVE, |far, v| far.max(v.abs()));
        values.into_iter().map(|v| (v / largest).powi(2)).collect()
    };
    let hat = |at: &dyn Fn(usize) -> f64, k: usize| {
        (0..=last).map(|i| (1.0 - (at(i) - k as f64).abs()).max(0.0)).collect()
    };
    let across = (0..=ACROSS).map(|k| hat(&place, k));
    let mut columns: Vec<Vec<f64>> = across.chain((0..=LONG).map(|k| hat(&moment, k))).collect();
    columns.push(square(v.to_vec()));
    columns.push(square((0..v.len()).map(slope).collect()));
    let reach = (AROUND / scene.step()) as usize;
    columns.extend([x, v].map(|series| around(&square(series.to_vec()), reach)));
    columns
}

/// Means over so many values on either side.
fn around(values: &[f64], reach: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    for value in values {
        sums.push(sums[sums.len() - 1] + value);
    }
    (0..values.len())
        .map(|i| {
            let (from, to) = (i.saturating_sub(reach), (i + reach + 1).min(values.len()));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect()
}
