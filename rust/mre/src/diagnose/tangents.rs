//! What small changes of a fitted model, and noise of the motions, change its force by.

use nalgebra::DVector;

use super::least_squares::Data;
use super::normal::whitened;
use super::point::Point;
use crate::assembly::Assembly;
use crate::kernel::filter::dot;

/// What may be noise of a derived motion, whitened: the force does not follow it, so that every coefficient of it is
/// possible; and every dependence of that on a current that changes.
fn noisy(assembly: &Assembly, data: Data, r: usize) -> impl Iterator<Item = Vec<f64>> {
    let recording = &assembly.campaign().recordings()[r];
    let current = recording.current().changing();
    let all = assembly.campaign().doubts()[r].noisy.iter().flatten();
    let white = move |series: &[f64]| whitened(data.noise, r, &data.rows[r], series);
    all.flat_map(move |series| {
        let product = |current: &[f64]| series.iter().zip(current).map(|(s, i)| s * i).collect::<Vec<_>>();
        std::iter::once(white(series)).chain(current.map(|current| white(&product(current))))
    })
}

/// All tangents of a fitted model, whitened; its own columns are taken from the point.
pub(super) fn tangents_at(
    assembly: &Assembly,
    data: Data,
    point: &mut Point,
    known: usize,
) -> Vec<Vec<(usize, Vec<f64>)>> {
    let own = point.tangents(assembly, data).into_iter().zip(&mut point.recordings).enumerate();
    own.map(|(r, (own, local))| {
        let noisy = noisy(assembly, data, r).enumerate().map(|(k, column)| (known + k, column));
        std::mem::take(&mut local.columns).into_iter().chain(own).chain(noisy).collect()
    })
    .collect()
}

/// Products of so many tangents with residuals, by recording.
pub(super) fn products<'r>(
    tangents: &[Vec<(usize, Vec<f64>)>],
    residuals: impl Iterator<Item = &'r [f64]>,
    count: usize,
) -> DVector<f64> {
    let mut sums = DVector::zeros(count);
    for (columns, residual) in tangents.iter().zip(residuals) {
        for (i, column) in columns {
            sums[*i] += dot(column, residual);
        }
    }
    sums
}
