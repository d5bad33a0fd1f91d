//! The middle of values, which few that are far off do not move.

/// Median of the size of a normal variable of variance one.
pub(crate) const GAUSSIAN: f64 = 0.6745;

/// The larger of the two in the middle of an even count; zero of none.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return 0.0;
    }
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// Standard deviation of most of the values that are not zero, as those of a rounded displacement at rest are.
pub(crate) fn deviation(values: &[f64]) -> f64 {
    median(values.iter().map(|value| value.abs()).filter(|size| *size > 0.0).collect()) / GAUSSIAN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_that_are_far_off_and_rests_do_not_count() {
        assert_eq!(
            (median(Vec::new()), median(vec![3.0, 1.0, 2.0]), median(vec![4.0, 1.0])),
            (0.0, 2.0, 4.0)
        );
        let quantiles = [-1.645, -0.842, -0.385, 0.0, 0.126, 0.524, 1.036, 100.0, 0.0, 0.0, 0.0];
        assert!((deviation(&quantiles) - 1.0).abs() < 0.25, "{}", deviation(&quantiles));
    }
}
