//! Samples at which a motion turns: there a force that jumps with the direction, as friction does, has either sign, and the
//! velocity does not tell which.

use std::ops::Range;

/// Share of the speed of its neighbours below which a sample is at the turn between them: digits of a displacement make as
/// much of a velocity that is nothing.
const NOTHING: f64 = 0.02;

/// Where more than one of so many samples is at a turn, what is left between them would tell too little.
const FEW: usize = 20;

/// These samples, each a range of its own; none where a cycle has too few.
pub(crate) fn turns(velocity: &[f64]) -> Vec<Range<usize>> {
    let at_a_turn = |v: &[f64]| v[0] * v[2] < 0.0 && v[1].abs() < NOTHING * v[0].abs().min(v[2].abs());
    let between = velocity.windows(3).enumerate();
    let found: Vec<Range<usize>> =
        between.filter(|(_, three)| at_a_turn(three)).map(|(i, _)| i + 1..i + 2).collect();
    if FEW * found.len() > velocity.len() { Vec::new() } else { found }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The velocity of a sine with so many samples to a cycle, the first so much of one after a peak.
    fn sine(cycle: f64, phase: f64) -> Vec<f64> {
        (0..200).map(|i| (std::f64::consts::TAU * (f64::from(i) + phase) / cycle).cos()).collect()
    }

    #[test]
    fn where_a_sample_is_at_the_turn_it_is_found() {
        let every_twenty: Vec<Range<usize>> = (0..10).map(|k| 10 + 20 * k..11 + 20 * k).collect();
        assert_eq!(turns(&sine(40.0, 0.0)), every_twenty);
        assert_eq!(turns(&sine(40.0, 0.01)), every_twenty);
        assert_eq!(turns(&sine(40.0, 0.05)), []);
        assert_eq!(turns(&sine(40.0, -0.5)), []);
        assert_eq!(turns(&sine(20.0, 0.0)), []);
    }

    #[test]
    fn at_rest_nothing_turns() {
        assert_eq!(turns(&[0.0; 9]), []);
        assert_eq!(turns(&[3.0, 2.0, 1.0, 0.0, 0.0, -1.0, -2.0]), []);
        // It stops for a moment, and goes on.
        let stops: Vec<f64> = (-20..20).map(|i| f64::from(i * i)).collect();
        assert_eq!(turns(&stops), []);
        assert_eq!(turns(&[]), []);
    }
}
