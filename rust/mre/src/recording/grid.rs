//! The even grid that the times of a recording are on, and rounding that hides it.

use crate::kernel::relaxation::runs;

/// Share of a step by which a time is off an even grid.
const OFF_THE_GRID: f64 = 0.75;
/// Decimals that files round times to, at most.
const MOST_DECIMALS: i32 = 9;
/// Share of a decimal by which a multiple of it may be off: what binary numbers cost.
const BINARY: f64 = 1e-5;
/// Times kept in single precision are off by this share of the largest.
const SINGLE: f64 = f32::EPSILON as f64;

/// Step in s of the even grid that times are on, as rounded ones are: within three quarters of a step.
///
/// # Errors
/// The first sample that is off the grid.
pub(crate) fn even_step(time: &[f64]) -> std::result::Result<f64, usize> {
    let step = (time[time.len() - 1] - time[0]) / (time.len() - 1) as f64;
    let off = |i: usize| (time[i] - time[0] - step * i as f64).abs() > OFF_THE_GRID * step;
    (0..time.len()).find(|i| off(*i)).map_or(Ok(step), Err)
}

/// Times put back on the even grid where no more than their rounding takes them off it: 1/128 s to four decimals
/// is 0.0078 s, then 0.0156 s.
///
/// What is exact between evenly spaced samples would else take every step for the end of a stretch.
pub(super) fn unrounded(time: Vec<f64>) -> Vec<f64> {
    if runs(&time).count() < 2 {
        return time;
    }
    let Ok(step) = even_step(&time) else { return time };
    let on_grid = |i: usize| time[0] + step * i as f64;
    let off = time.iter().enumerate().map(|(i, t)| (t - on_grid(i)).abs()).fold(0.0, f64::max);
    // The step is between two rounded times: each is off by half a decimal.
    if off <= rounding(&time) { (0..time.len()).map(on_grid).collect() } else { time }
}

/// The decimal that all times are multiples of, or what single precision takes from the largest where all are kept so.
fn rounding(time: &[f64]) -> f64 {
    let multiple = |decimal: f64| {
        time.iter().all(|t| {
            let count = t * decimal;
            (count - count.round()).abs() <= BINARY
        })
    };
    let decimal = (0..=MOST_DECIMALS).map(|k| 10_f64.powi(k)).find(|decimal| multiple(*decimal));
    let largest = time[0].abs().max(time[time.len() - 1].abs());
    let single = time.iter().all(|t| f64::from(*t as f32) == *t);
    let binary = if single { SINGLE * largest } else { 0.0 };
    decimal.map_or(0.0, |decimal| (1.0 + BINARY) / decimal).max(binary)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(of: &[f64]) -> f64 {
        of.windows(2).map(|pair| (pair[1] - pair[0] - 1.0 / 128.0).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn rounded_times_go_back_to_their_grid() {
        let even: Vec<f64> = (0..3000).map(|i| 2.5 + f64::from(i) / 128.0).collect();
        for decimals in [3, 4, 5, 6] {
            let places = 10_f64.powi(decimals);
            let rounded: Vec<f64> = even.iter().map(|t| (t * places).round() / places).collect();
            let back = unrounded(rounded.clone());
            assert!(spread(&back) < 1e-6 && spread(&rounded) > 1e-7, "{decimals}: {}", spread(&back));
            assert_eq!(unrounded(back.clone()), back);
        }
        let single: Vec<f64> = even.iter().map(|t| f64::from((*t / 0.7) as f32)).collect();
        assert_eq!(runs(&unrounded(single)).count(), 1);
    }

    #[test]
    fn times_that_truly_differ_are_left_alone() {
        let shaken: Vec<f64> =
            (0..400).map(|i| f64::from(i) * 0.01 + 0.002 * (1.7 * f64::from(i)).sin()).collect();
        assert_eq!(unrounded(shaken.clone()), shaken);
        let late: Vec<f64> = shaken.iter().map(|t| 1e6 + t).collect();
        assert_eq!(unrounded(late.clone()), late);
        let two_rates: Vec<f64> =
            (0..300).map(|i| 0.01 * f64::from(if i < 100 { i } else { 2 * i - 100 })).collect();
        assert_eq!(unrounded(two_rates.clone()), two_rates);
    }
}
