//! A residual that follows the motion of its own recording is a mismatch: an autoregression of a recording would
//! take it for a narrow band of noise, and whiten the mismatch away.

use crate::assembly::Assembly;
use crate::kernel::filter::dot;

/// A residual follows the motion where this removes more than this share of its squares.
const MOST: f64 = 0.5;
/// Cycles in each half of a recording: over fewer, slow noise follows the motion too.
const CYCLES: usize = 5;
/// Share of its range by which a motion leaves its middle to count.
const ASIDE: f64 = 0.1;

/// Residuals in N of the scored samples, those that follow the motion less what follows it.
pub(super) fn without_the_coherent(assembly: &Assembly, residuals: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let recordings = assembly.campaign().recordings().iter();
    residuals
        .into_iter()
        .zip(recordings)
        .map(|(residual, recording)| {
            let of = |series: &[f64]| series[recording.scored()].to_vec();
            let (x, v) = (of(recording.displacement()), of(recording.velocity()));
            let middle = residual.len() / 2;
            let halves = [0..middle, middle..residual.len()];
            let mut left = Vec::with_capacity(residual.len());
            let (mut before, mut after) = (0.0, 0.0);
            for half in halves {
                let [e, x, v] = [&residual, &x, &v].map(|series| about_its_mean(&series[half.clone()]));
                if cycles(&x) < CYCLES {
                    return residual;
                }
                let rest = beside(&beside(&e, &x), &beside(&v, &x));
                before += dot(&e, &e);
                after += dot(&rest, &rest);
                let mean = residual[half.clone()].iter().sum::<f64>() / half.len() as f64;
                left.extend(rest.into_iter().map(|e| e + mean));
            }
            if after < (1.0 - MOST) * before { left } else { residual }
        })
        .collect()
}

fn about_its_mean(series: &[f64]) -> Vec<f64> {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    series.iter().map(|value| value - mean).collect()
}

/// A series less its projection onto another.
fn beside(series: &[f64], other: &[f64]) -> Vec<f64> {
    let share = dot(series, other) / dot(other, other).max(f64::MIN_POSITIVE);
    series.iter().zip(other).map(|(s, o)| s - share * o).collect()
}

/// Whole cycles of a motion about zero.
fn cycles(x: &[f64]) -> usize {
    let aside = ASIDE * x.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
    let sides = x.iter().filter(|x| x.abs() > aside).map(|x| *x > 0.0).collect::<Vec<_>>();
    sides.windows(2).filter(|pair| pair[0] != pair[1]).count() / 2
}
