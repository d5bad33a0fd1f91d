//! The search for columns of which only sums of products are known.

use nalgebra::{DMatrix, DVector};

use super::factor;

/// Most columns: every coefficient of a model at two currents.
const MOST: usize = 8;
/// Columns with less than this share of their square outside the span of those before depend on them:
/// below it the sums of products know nothing.
const DEPENDENT: f64 = 1e-14;

/// Coefficients within `lower..=upper` that minimise `b' G b - 2 b' r`, for a Gram matrix `G` of at most
/// eight columns and their products `r` with the target.
///
/// Columns that are no columns (zero, or dependent on others) keep the coefficient nearest to zero that
/// the box allows.
pub(crate) fn minimise(gram: &DMatrix<f64>, right: &DVector<f64>, lower: &[f64], upper: &[f64]) -> Vec<f64> {
    if right.len() <= 4 {
        padded::<4>(gram, right, lower, upper)
    } else {
        padded::<MOST>(gram, right, lower, upper)
    }
}

/// With zero columns up to `N`, which decide nothing.
fn padded<const N: usize>(
    gram: &DMatrix<f64>,
    right: &DVector<f64>,
    lower: &[f64],
    upper: &[f64],
) -> Vec<f64> {
    let (r, g) = cholesky::<N>(gram, right);
    let pad = |bound: &[f64]| std::array::from_fn(|i| bound.get(i).copied().unwrap_or(0.0));
    factor::minimise(&r, &g, &pad(lower), &pad(upper))[..right.len()].to_vec()
}

/// The triangular factor R of the columns, and the target in its coordinates: `R' R = G`, `R' g = r`.
fn cholesky<const N: usize>(gram: &DMatrix<f64>, right: &DVector<f64>) -> ([[f64; N]; N], [f64; N]) {
    let (mut r, mut g) = ([[0.0; N]; N], [0.0; N]);
    for i in 0..right.len() {
        let known = |j: usize, r: &[[f64; N]; N]| (0..i).map(|m| r[m][i] * r[m][j]).sum::<f64>();
        let pivot = gram[(i, i)] - known(i, &r);
        if pivot <= DEPENDENT * gram[(i, i)] {
            continue;
        }
        let height = pivot.sqrt();
        g[i] = (right[i] - (0..i).map(|m| r[m][i] * g[m]).sum::<f64>()) / height;
        for j in i + 1..right.len() {
            r[i][j] = (gram[(i, j)] - known(j, &r)) / height;
        }
        r[i][i] = height;
    }
    (r, g)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]

        #[test]
        fn no_point_of_the_box_is_better(
            k in prop_oneof![Just(1_usize), Just(4), Just(7)],
            columns in prop::collection::vec(-1.0..1.0_f64, 70),
            target in prop::collection::vec(-2.0..2.0_f64, 10),
            lower in prop::collection::vec(-1.0..0.2_f64, 7),
            width in prop::collection::vec(0.0..1.0_f64, 7),
            trial in prop::collection::vec(0.0..1.0_f64, 7),
        ) {
            let a = DMatrix::from_column_slice(10, k, &columns[..10 * k]);
            let f = DVector::from_column_slice(&target);
            let upper: Vec<f64> = lower.iter().zip(&width).map(|(l, w)| l + w).collect();
            let found = minimise(&(a.transpose() * &a), &(a.transpose() * &f), &lower[..k], &upper[..k]);
            let cost = |b: &[f64]| (&a * DVector::from_column_slice(b) - &f).norm_squared();
            for i in 0..k {
                prop_assert!(found[i] >= lower[i] && found[i] <= upper[i]);
            }
            let other: Vec<f64> = (0..k).map(|i| lower[i] + trial[i] * width[i]).collect();
            prop_assert!(cost(&found) <= cost(&other) + 1e-12);
            // Nor one near by.
            for i in 0..k {
                for step in [-1e-4, 1e-4] {
                    let mut near = found.clone();
                    near[i] = (near[i] + step).clamp(lower[i], upper[i]);
                    prop_assert!(cost(&found) <= cost(&near) + 1e-12);
                }
            }
        }
    }

    #[test]
    fn dependent_and_zero_columns_stay_near_zero() {
        let a = DMatrix::from_row_slice(3, 3, &[1.0, 2.0, 0.0, 2.0, 4.0, 0.0, 3.0, 6.0, 0.0]);
        let f = DVector::from_row_slice(&[1.0, 2.0, 3.0]);
        let (gram, right) = (a.transpose() * &a, a.transpose() * &f);
        let found = minimise(&gram, &right, &[-5.0, -5.0, 2.0], &[5.0, 5.0, 3.0]);
        assert!((found[0] - 1.0).abs() < 1e-12 && found[1..] == [0.0, 2.0], "{found:?}");
        // With the first on its bound the second explains the rest.
        let found = minimise(&gram, &right, &[-5.0, -5.0, 2.0], &[0.4, 5.0, 3.0]);
        assert!((found[0] - 0.4).abs() < 1e-12 && (found[1] - 0.3).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn every_model_fits_in() {
        for name in crate::model::names() {
            let Ok(model) = crate::model::Model::named(name) else { continue };
            assert!(2 * model.terms().len() <= MOST, "{name}");
        }
    }
}
