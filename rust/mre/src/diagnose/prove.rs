//! Proof on data that took no part.

use rayon::prelude::*;

use super::explained::unexplained;
use super::gaps::LeftOut;
use super::least_squares::{Data, Fitted, refine};
use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::Rows;
use super::point::Point;
use super::splits::Split;
use crate::assembly::Assembly;

/// Ridge on the square of a column of the measurement.
const OWN_RIDGE: f64 = 1e-10;

/// Squared errors in N^2 and number of samples, by recording.
type Sums = Vec<(f64, usize)>;

/// Sum of squared errors in N^2, and of samples, on training and held-out samples over all splits.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// Rms error on the samples trained on, N.
    pub train_rms: f64,
    /// Rms error on the samples held out, N.
    pub held_out_rms: f64,
    /// Squared errors of the held-out samples in N^2 by recording, and their number.
    pub by_recording: Vec<(f64, usize)>,
}

/// Train a model on each split, from a fit to everything, and judge it on what was held out.
///
/// Coefficients of the measurement (drift, interference, initial states) belong to a recording: they are fitted to
/// it by least squares, held out or not, and the rest of the model is not. A fit under correlated noise has little
/// against an initial state that decays as the noise does.
pub(super) fn prove(
    assembly: &Assembly,
    noise: &Noise,
    splits: &[Split],
    fitted: &Fitted,
    monitor: &dyn Monitor,
) -> Proof {
    let count = assembly.campaign().recordings().len();
    let sums: Vec<(Sums, Sums)> = splits
        .par_iter()
        .map(|split| {
            let data = Data { noise, rows: &split.train, monitor };
            let trained = refine(assembly, data, &fitted.unit);
            let point = Point::at(assembly, data, trained.unit);
            let own = own_coefficients(assembly);
            let errors = (0..count).map(|r| {
                let recording = &assembly.campaign().recordings()[r];
                let measured = recording.force().unwrap_or_default();
                let error: Vec<f64> = if own {
                    beside_its_own(assembly, &point, r, measured)
                } else {
                    measured.iter().zip(&point.recordings[r].force).map(|(f, m)| f - m).collect()
                };
                let left_out = LeftOut::of(assembly.campaign(), r);
                let sum = |rows: &Rows| {
                    let rows = left_out.spare(rows);
                    let all = rows.iter().flat_map(|range| &error[range.clone()]);
                    let count = rows.iter().map(ExactSizeIterator::len).sum();
                    (all.map(|e| e * e).sum::<f64>(), count)
                };
                // The first samples of a recording are what the noise's memory starts from: no fit counts them.
                let lost = noise.lost(r);
                let fitted = split.train[r].iter().map(|t| t.start.max(lost).min(t.end)..t.end).collect();
                (sum(&fitted), sum(&split.held_out[r]))
            });
            errors.unzip()
        })
        .collect();
    let total = |side: fn(&(Sums, Sums)) -> &Sums| {
        let mut by_recording = vec![(0.0, 0); count];
        for split in &sums {
            for (all, one) in by_recording.iter_mut().zip(side(split)) {
                *all = (all.0 + one.0, all.1 + one.1);
            }
        }
        by_recording
    };
    let rms = |sums: &[(f64, usize)]| {
        let (squares, count) = sums.iter().fold((0.0, 0), |s, one| (s.0 + one.0, s.1 + one.1));
        (squares / count.max(1) as f64).sqrt()
    };
    let by_recording = total(|s| &s.1);
    Proof { train_rms: rms(&total(|s| &s.0)), held_out_rms: rms(&by_recording), by_recording }
}

fn own_coefficients(assembly: &Assembly) -> bool {
    assembly.effects().iter().any(|e| e.of_the_measurement())
}

/// Error of the device on a recording, less what the measurement's own columns explain of it.
fn beside_its_own(assembly: &Assembly, point: &Point, r: usize, measured: &[f64]) -> Vec<f64> {
    let columns = assembly.columns(r, &assembly.physical(&point.fitted.unit));
    let device = assembly.device_coefficients();
    let pairs = point.fitted.coefficients.iter().zip(&device);
    let of_device: Vec<f64> = pairs.map(|(c, own)| if *own { *c } else { 0.0 }).collect();
    let force = columns.measured(&of_device);
    let error = measured.iter().zip(force).map(|(f, m)| f - m).collect();
    let own: Vec<&[f64]> = columns
        .columns
        .iter()
        .zip(&columns.places)
        .filter(|(_, place)| !device[**place])
        .map(|(column, _)| &column[..])
        .collect();
    unexplained(error, &own, |square| OWN_RIDGE * square.max(f64::MIN_POSITIVE))
}
