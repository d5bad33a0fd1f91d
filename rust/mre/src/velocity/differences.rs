//! Where a derived velocity is not the slope of the displacement: next to a corner a polynomial may swing far from it.

use super::stencil::grid;

/// Weights of the differences over two, four and six steps: exact for polynomials up to the sixth degree.
const WEIGHTS: [f64; 3] = [0.75, -0.15, 1.0 / 60.0];
/// Standard deviation of their noise, over that of the displacement a step.
const CARRIED: f64 = 1.082;
/// They may differ by so many standard deviations of their noise.
const NOISE: f64 = 5.0;
/// Of so many samples one at most is missed. More are no corners or turns: the noise is larger than it seems, as of a rounded
/// displacement that mostly rests.
const FEW: usize = 4;

/// Samples whose velocity in mm/s is further from such differences than they err, and than a `share` of the largest
/// velocity, with the differences. The displacement in mm has `noise` of this size, rms; none where the times are not even.
pub(super) fn missed(
    time: &[f64],
    displacement: &[f64],
    velocity: &[f64],
    noise: f64,
    share: f64,
) -> Vec<(usize, f64)> {
    let Some(step) = grid(time) else { return Vec::new() };
    let tolerance = NOISE * CARRIED * noise / step + share * largest(velocity);
    let mut found = differences(step, displacement);
    found.retain(|(i, difference)| (velocity[*i] - difference).abs() > tolerance);
    if FEW * found.len() > time.len() {
        found.clear();
    }
    found
}

/// The differences at the samples that have enough on either side.
fn differences(step: f64, displacement: &[f64]) -> Vec<(usize, f64)> {
    let reach = WEIGHTS.len();
    let difference = |i: usize| {
        let parts = WEIGHTS.iter().zip(1..).map(|(w, k)| w * (displacement[i + k] - displacement[i - k]));
        parts.sum::<f64>() / step
    };
    (reach..displacement.len().saturating_sub(reach)).map(|i| (i, difference(i))).collect()
}

fn largest(velocity: &[f64]) -> f64 {
    velocity.iter().map(|v| v.abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_of_a_smooth_motion_is_not_missed_and_a_swing_is() {
        let turn = std::f64::consts::TAU;
        let time: Vec<f64> = (0..400).map(|i| f64::from(i) / 20.0).collect();
        let x: Vec<f64> = time.iter().map(|t| 3.0 * (2.0 * turn * t).sin()).collect();
        let mut v: Vec<f64> = time.iter().map(|t| 6.0 * turn * (2.0 * turn * t).cos()).collect();
        assert_eq!(missed(&time, &x, &v, 0.0, 2.5e-3), []);
        v[200] += 0.5;
        let found = missed(&time, &x, &v, 0.0, 2.5e-3);
        assert!(
            matches!(found[..], [(200, slope)] if (slope + 0.5 - v[200]).abs() < 0.02 * v[200]),
            "{found:?}"
        );
        // Noise of a tenth of a millimetre hides it.
        assert_eq!(missed(&time, &x, &v, 0.1, 2.5e-3), []);
    }
}
