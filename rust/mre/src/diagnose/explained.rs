//! What a few columns explain of a series.

use nalgebra::{DMatrix, DVector};

use crate::kernel::filter::dot;

/// A series less what columns explain of it by least squares; `ridge` is added to the square of each, which it is
/// told. The series itself where the columns cannot be told apart.
pub(super) fn unexplained(mut series: Vec<f64>, columns: &[&[f64]], ridge: impl Fn(f64) -> f64) -> Vec<f64> {
    let gram = DMatrix::from_fn(columns.len(), columns.len(), |i, j| {
        let product = dot(columns[i], columns[j]);
        product + if i == j { ridge(product) } else { 0.0 }
    });
    let right = DVector::from_fn(columns.len(), |i, _| dot(columns[i], &series));
    if let Some(factor) = gram.cholesky() {
        for (column, coefficient) in columns.iter().zip(factor.solve(&right).iter()) {
            for (left, value) in series.iter_mut().zip(*column) {
                *left -= coefficient * value;
            }
        }
    }
    series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_at_right_angles_to_the_columns() {
        let line: Vec<f64> = (0..50).map(f64::from).collect();
        let wave: Vec<f64> = line.iter().map(|t| (0.3 * t).sin()).collect();
        let series: Vec<f64> = line.iter().map(|t| 2.0 * t + 3.0 + (0.3 * t).sin()).collect();
        let left = unexplained(series.clone(), &[&line, &wave], |_| 0.0);
        assert!(dot(&left, &line).abs() < 1e-9 * dot(&series, &line), "{}", dot(&left, &line));
        assert!(dot(&left, &wave).abs() < 1e-9 * dot(&series, &series), "{}", dot(&left, &wave));
        assert!(dot(&left, &left) > 1.0);
        let alone = unexplained(line.clone(), &[&line], |square| square);
        assert!(alone.iter().zip(&line).all(|(left, t)| (left - 0.5 * t).abs() < 1e-12));
    }

    #[test]
    fn equal_columns_take_nothing() {
        let column = [1.0, 2.0, 3.0];
        assert_eq!(unexplained(vec![1.0, 1.0, 1.0], &[&column, &column], |_| 0.0), [1.0, 1.0, 1.0]);
    }
}
