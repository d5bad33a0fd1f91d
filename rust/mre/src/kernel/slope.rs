//! Slopes by differences.

/// Slope of a series on an even grid: by five points (Abramowitz and Stegun 25.3.6), by three or two near the ends.
pub(crate) fn slope(time: &[f64], series: &[f64]) -> Vec<f64> {
    let last = series.len() - 1;
    let mut found = vec![0.0; series.len()];
    for ((found, y), t) in found.iter_mut().skip(1).zip(series.windows(3)).zip(time.windows(3)) {
        *found = (y[2] - y[0]) / (t[2] - t[0]);
    }
    for ((found, y), t) in found.iter_mut().skip(2).zip(series.windows(5)).zip(time.windows(5)) {
        *found = (4.0 * *found - (y[4] - y[0]) / (t[4] - t[0])) / 3.0;
    }
    for (i, a, b) in [(0, 0, last.min(1)), (last, last.saturating_sub(1), last)] {
        found[i] = (series[b] - series[a]) / (time[b] - time[a]);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_sine_of_twenty_samples_a_cycle_is_right_to_half_a_thousandth() {
        let w = std::f64::consts::TAU / 20.0;
        let time: Vec<f64> = (0..100).map(f64::from).collect();
        let found = slope(&time, &time.iter().map(|t| (w * t).sin()).collect::<Vec<_>>());
        for (t, slope) in time.iter().zip(&found).skip(2).take(96) {
            assert!((slope / w - (w * t).cos()).abs() < 5e-4, "{t}");
        }
        assert!((found[0] / w - 1.0).abs() < 0.02);
    }
}
