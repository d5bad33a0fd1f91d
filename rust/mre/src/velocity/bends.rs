//! Bends of a motion: its acceleration jumps there, as at a quick release, and polynomials across swing on both sides.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::local::{NARROWEST, TERMS, chebyshev};

/// Half windows over which a bend is looked for: over more it stands out of the noise further, and a motion needs more terms.
const REACH: f64 = 1.5;
/// Standard deviations by which a bend stands out of the noise, and times that it stands out of what else polynomials miss.
const STANDS_OUT: f64 = 5.0;
/// Terms of a polynomial that leaves less than one with a bend where a motion is only quicker than elsewhere.
const MORE_TERMS: usize = TERMS + 2;
/// Samples of the shortest part between bends.
const SHORTEST: usize = 4 * NARROWEST;
/// Median of the size of a normal variable of variance one.
const MEDIAN: f64 = 0.6745;

/// The samples of a displacement in mm after which it bends, in rising order, on an even grid and with noise of this `variance`
/// in mm² that is told over `half` samples on either side.
pub(super) fn bends(displacement: &[f64], variance: f64, half: usize) -> Vec<usize> {
    let reach = ((REACH * half as f64).ceil() as usize).max(MORE_TERMS);
    let samples = displacement.len();
    if variance <= 0.0 || samples <= 2 * reach + 1 {
        return Vec::new();
    }
    let around = |i: usize| {
        let middle = displacement[i];
        displacement[i - reach..=i + reach].iter().map(move |x| x - middle)
    };
    let smooth = columns(reach, MORE_TERMS, None);
    let bent = columns(reach, TERMS, Some(2));
    let bend: Vec<f64> = bent.column(TERMS).iter().copied().collect();
    let size =
        |i: usize| (bend.iter().zip(around(i)).map(|(b, x)| b * x).sum::<f64>() / variance.sqrt()).abs();
    let sizes: Vec<f64> = (reach..samples - reach).into_par_iter().map(size).collect();
    let least = STANDS_OUT * (median(&sizes) / MEDIAN).max(1.0);
    let mut places: Vec<usize> = (0..sizes.len()).filter(|k| sizes[*k] > least).collect();
    places.sort_by(|a, b| sizes[*b].total_cmp(&sizes[*a]));
    let mut found: Vec<usize> = Vec::new();
    for k in places {
        // Each hides those beside it.
        if found.iter().all(|known| known.abs_diff(k) > reach.max(SHORTEST)) {
            found.push(k);
        }
    }
    let explained = |columns: &DMatrix<f64>, i: usize| {
        let along = |column: nalgebra::DVectorView<f64>| {
            column.iter().zip(around(i)).map(|(c, x)| c * x).sum::<f64>().powi(2)
        };
        columns.column_iter().map(along).sum::<f64>()
    };
    let mut found: Vec<usize> = found.into_iter().map(|k| k + reach).collect();
    found.retain(|i| explained(&bent, *i) > explained(&smooth, *i));
    found.sort_unstable();
    found
}

/// Orthonormal columns of a window: polynomials, and what they leave of a power that begins in its middle.
fn columns(reach: usize, terms: usize, power: Option<i32>) -> DMatrix<f64> {
    let place = |k: usize| k as f64 / reach as f64 - 1.0;
    let count = terms + usize::from(power.is_some());
    let columns = DMatrix::from_fn(2 * reach + 1, count, |k, c| match power {
        Some(power) if c == terms => place(k).max(0.0).powi(power),
        _ => chebyshev::<MORE_TERMS>(place(k))[c],
    });
    columns.qr().q()
}

fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::super::from_displacement;

    const RATE: f64 = 200.0;
    const SAMPLES: usize = 1500;
    /// Of the release.
    const AT: f64 = 2.5;

    fn time() -> Vec<f64> {
        (0..SAMPLES).map(|i| i as f64 / RATE).collect()
    }

    /// 5 mm held, and let go to ring at a frequency in Hz.
    fn released(frequency: f64, t: f64) -> [f64; 2] {
        let (turn, decay) = (std::f64::consts::TAU * frequency, 0.6);
        let s = t - AT;
        if s < 0.0 {
            return [5.0, 0.0];
        }
        let size = 5.0 * (-decay * s).exp();
        let slope = -size * (turn + decay * decay / turn) * (turn * s).sin();
        [size * ((turn * s).cos() + decay / turn * (turn * s).sin()), slope]
    }

    fn noise(i: usize, size: f64) -> f64 {
        let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
        12.0_f64.sqrt() * size * (x - x.floor() - 0.5)
    }

    #[test]
    fn a_quick_release_is_a_bend_and_the_velocity_beside_it_is_as_good_as_elsewhere() {
        let time = time();
        for (frequency, size) in [(1.0, 0.001), (1.0, 0.005), (2.0, 0.002), (2.0, 0.01)] {
            let x: Vec<f64> =
                time.iter().enumerate().map(|(i, t)| released(frequency, *t)[0] + noise(i, size)).collect();
            let derived = from_displacement(&time, &x);
            let release = (AT * RATE) as usize;
            let inner = &derived.corners[1..derived.corners.len() - 1];
            assert!(matches!(inner, [one] if one.contains(&release)), "{frequency} {size}: {inner:?}");
            let error = |i: usize| derived.velocity[i] - released(frequency, time[i])[1];
            let kept = |i: &usize| !derived.corners.iter().any(|range| range.contains(i));
            let rms = |near: std::ops::Range<usize>| {
                let errors: Vec<f64> = near.filter(kept).map(error).collect();
                (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
            };
            let (beside, elsewhere) = (rms(release - 30..release + 30), rms(0..SAMPLES));
            assert!(beside < 2.5 * elsewhere, "{frequency} {size}: {beside} beside {elsewhere}");
        }
    }

    #[test]
    fn where_an_exact_triangle_is_rounded_the_velocity_is_not_missed() {
        // The mean over 60 ms of a triangle of 5 mm at 0.5 Hz, and its slope.
        let integral = |t: f64| {
            let s = (t + 0.5).rem_euclid(2.0);
            if s < 1.0 { 5.0 * (s * s - s) } else { 5.0 * (3.0 * s - s * s - 2.0) }
        };
        let triangle = |t: f64| 5.0 - 10.0 * ((t + 0.5).rem_euclid(2.0) - 1.0).abs();
        let time = time();
        let x: Vec<f64> = time.iter().map(|t| (integral(t + 0.03) - integral(t - 0.03)) / 0.06).collect();
        let derived = from_displacement(&time, &x);
        // The last corner is cut off.
        for (i, t) in time.iter().enumerate().take(SAMPLES - 20) {
            let wanted = (triangle(t + 0.03) - triangle(t - 0.03)) / 0.06;
            let known = derived.corners.iter().any(|range| range.contains(&i));
            assert!(known || (derived.velocity[i] - wanted).abs() < 0.02, "{i}: {}", derived.velocity[i]);
        }
        let left_out: usize = derived.corners.iter().map(ExactSizeIterator::len).sum();
        assert!(5 * left_out < SAMPLES, "{left_out} of {SAMPLES} samples");
    }

    #[test]
    fn noise_alone_a_swell_and_a_burst_have_none() {
        let time = time();
        let turn = std::f64::consts::TAU;
        let motions: [&dyn Fn(f64) -> f64; 3] =
            [&|_| 0.0, &|t| 5.0 * (0.5 * turn * t / 7.5).sin().powi(2) * (2.0 * turn * t).sin(), &|t| {
                5.0 * (3.0 * turn * t).sin() * (-4.0 * (t - 3.0).powi(2)).exp()
            }];
        for (k, motion) in motions.iter().enumerate() {
            for size in [0.002, 0.02] {
                let x: Vec<f64> = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i, size)).collect();
                assert_eq!(from_displacement(&time, &x).corners, [], "motion {k} with noise of {size}");
            }
        }
    }
}
