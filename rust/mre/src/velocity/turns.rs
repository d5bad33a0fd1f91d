//! Samples at which a motion turns: there a force that jumps with the direction, as friction does, has either sign, and the
//! velocity does not tell which.

use std::ops::Range;

/// Share of the speed of its neighbours below which a sample is at the turn between them: digits of a displacement make as
/// much of a velocity that is nothing.
const NOTHING: f64 = 0.02;

/// These samples, each a range of its own.
pub(crate) fn turns(velocity: &[f64]) -> Vec<Range<usize>> {
    let turns = |v: &[f64]| v[0] * v[2] < 0.0 && v[1].abs() < NOTHING * v[0].abs().min(v[2].abs());
    let between = velocity.windows(3).enumerate();
    between.filter(|(_, three)| turns(three)).map(|(i, _)| i + 1..i + 2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_a_sample_is_at_the_turn_it_is_found() {
        let at =
            |phase: f64| (0..100).map(move |i| (0.05 * std::f64::consts::PI * (f64::from(i) + phase)).cos());
        let found = |phase: f64| turns(&at(phase).collect::<Vec<f64>>());
        let every_twenty: Vec<Range<usize>> = (0..5).map(|k| 10 + 20 * k..11 + 20 * k).collect();
        assert_eq!(found(0.0), every_twenty);
        assert_eq!(found(0.01), every_twenty);
        assert_eq!(found(0.05), []);
        assert_eq!(found(-0.5), []);
    }

    #[test]
    fn at_rest_nothing_turns() {
        assert_eq!(turns(&[0.0; 9]), []);
        assert_eq!(turns(&[3.0, 2.0, 1.0, 0.0, 0.0, -1.0, -2.0]), []);
        // It stops for a moment, and goes on.
        assert_eq!(turns(&[2.0, 1.0, 0.0, 1.0, 2.0]), []);
        assert_eq!(turns(&[]), []);
    }
}
