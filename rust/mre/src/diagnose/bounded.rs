//! Linear least squares in a box from normal equations, for any number of columns, of which most have no
//! bounds.
//!
//! Active-set method of Stark and Parker 1995 (BVLS), <https://doi.org/10.1007/bf02187725>.

use nalgebra::{DMatrix, DVector};

/// Coefficients within `lower..=upper` that minimise `b' G b - 2 b' r`, for a Gram matrix `G` of the
/// columns and their products `r` with the target.
///
/// Columns that are no columns (zero, or dependent on others) keep the coefficient nearest to zero that
/// the box allows.
pub(crate) fn minimise(gram: &DMatrix<f64>, right: &DVector<f64>, lower: &[f64], upper: &[f64]) -> Vec<f64> {
    let k = right.len();
    let scale: Vec<f64> = (0..k).map(|i| gram[(i, i)].sqrt()).collect();
    let mut value: Vec<f64> = (0..k).map(|i| 0.0_f64.clamp(lower[i], upper[i])).collect();
    // Columns without length stay; the others start free.
    let mut free: Vec<bool> = scale.iter().map(|s| *s > 0.0).collect();
    for _ in 0..20 * k + 20 {
        settle(gram, right, (lower, upper), &scale, &mut value, &mut free);
        // Free the bound whose gradient points most strongly into the box.
        let mut strongest = (1e-13, None);
        for i in (0..k).filter(|&i| !free[i] && scale[i] > 0.0 && lower[i] < upper[i]) {
            let slope = (right[i] - (0..k).map(|j| gram[(i, j)] * value[j]).sum::<f64>()) / scale[i];
            let size = (0..k).map(|j| (gram[(i, j)] * value[j]).abs()).sum::<f64>() + right[i].abs();
            let inward =
                if value[i] <= lower[i] { slope } else { -slope } / (size / scale[i]).max(f64::MIN_POSITIVE);
            if inward > strongest.0 {
                strongest = (inward, Some(i));
            }
        }
        match strongest.1 {
            Some(i) => free[i] = true,
            None => break,
        }
    }
    value
}

/// Solve for the free coefficients, fixing those that would leave the box on the way.
fn settle(
    gram: &DMatrix<f64>,
    right: &DVector<f64>,
    (lower, upper): (&[f64], &[f64]),
    scale: &[f64],
    value: &mut [f64],
    free: &mut [bool],
) {
    loop {
        let open: Vec<usize> = (0..value.len()).filter(|i| free[*i]).collect();
        if open.is_empty() {
            return;
        }
        let matrix = DMatrix::from_fn(open.len(), open.len(), |r, c| {
            let ridge = if r == c { 1e-15 } else { 0.0 };
            gram[(open[r], open[c])] / (scale[open[r]] * scale[open[c]]) + ridge
        });
        let rhs = DVector::from_fn(open.len(), |r, _| {
            let fixed: f64 =
                (0..value.len()).filter(|j| !free[*j]).map(|j| gram[(open[r], j)] * value[j]).sum();
            (right[open[r]] - fixed) / scale[open[r]]
        });
        let Some(factor) = matrix.cholesky() else {
            free[open[open.len() - 1]] = false; // dependent columns: the last one stays where it is
            continue;
        };
        let solution = factor.solve(&rhs);
        // The longest step towards the solution that stays in the box.
        let mut step = (1.0, None);
        for (r, &i) in open.iter().enumerate() {
            let wished = solution[r] / scale[i];
            let bound = wished.clamp(lower[i], upper[i]);
            if bound != wished {
                let share = ((bound - value[i]) / (wished - value[i])).clamp(0.0, 1.0);
                if share < step.0 || step.1.is_none() {
                    step = (share, Some((i, bound)));
                }
            }
        }
        for (r, &i) in open.iter().enumerate() {
            value[i] = (value[i] + step.0 * (solution[r] / scale[i] - value[i])).clamp(lower[i], upper[i]);
        }
        match step.1 {
            Some((i, bound)) => (value[i], free[i]) = (bound, false),
            None => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]

        #[test]
        fn no_point_of_the_box_is_better(
            columns in prop::collection::vec(-1.0..1.0_f64, 24),
            target in prop::collection::vec(-2.0..2.0_f64, 6),
            lower in prop::collection::vec(-1.0..0.2_f64, 4),
            width in prop::collection::vec(0.0..1.0_f64, 4),
            trial in prop::collection::vec(0.0..1.0_f64, 4),
        ) {
            let a = DMatrix::from_column_slice(6, 4, &columns);
            let f = DVector::from_column_slice(&target);
            let upper: Vec<f64> = lower.iter().zip(&width).map(|(l, w)| l + w).collect();
            let found = minimise(&(a.transpose() * &a), &(a.transpose() * &f), &lower, &upper);
            let cost = |b: &[f64]| (&a * DVector::from_column_slice(b) - &f).norm_squared();
            for i in 0..4 {
                prop_assert!(found[i] >= lower[i] && found[i] <= upper[i]);
            }
            let other: Vec<f64> = (0..4).map(|i| lower[i] + trial[i] * width[i]).collect();
            prop_assert!(cost(&found) <= cost(&other) + 1e-12);
            // Nor one near by.
            for i in 0..4 {
                for step in [-1e-4, 1e-4] {
                    let mut near = found.clone();
                    near[i] = (near[i] + step).clamp(lower[i], upper[i]);
                    prop_assert!(cost(&found) <= cost(&near) + 1e-12);
                }
            }
        }
    }
}
