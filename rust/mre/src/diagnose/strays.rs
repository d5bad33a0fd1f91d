//! How far the noise of the motions scatters products with the residual.
//!
//! The residual has what the noise of a motion makes of the force of the model, more where the motion is fast or the device stiff. An
//! autoregression takes it for noise of even size: where products scatter further than that, they tell less.

use nalgebra::DMatrix;

/// Products of some columns, in rows, with what the noise of the motions leaves of the residual, in some draws.
pub(super) struct Strays {
    products: DMatrix<f64>,
    /// Share of the noise that it is: so much of it the noise's model has.
    share: f64,
}

impl Strays {
    /// Without noise of the motions.
    pub(super) fn none(columns: usize) -> Self {
        Self { products: DMatrix::zeros(columns, 0), share: 0.0 }
    }

    /// Where that noise is a share of all.
    pub(super) fn new(products: DMatrix<f64>, share: f64) -> Self {
        Self { products, share }
    }

    /// Of other columns with these products, projected off combinations of these columns, one for each row.
    pub(super) fn beside(&self, combinations: &DMatrix<f64>, products: DMatrix<f64>) -> Self {
        Self { products: products - combinations * &self.products, ..*self }
    }

    /// Of some of the columns, each times a factor.
    pub(super) fn of(&self, chosen: &[usize], scale: &[f64]) -> Self {
        let products = DMatrix::from_fn(chosen.len(), self.products.ncols(), |a, k| {
            self.products[(chosen[a], k)] * scale[a]
        });
        Self { products, ..*self }
    }

    /// Of combinations of the columns, one for each row.
    pub(super) fn combined(&self, rows: &DMatrix<f64>) -> Self {
        Self { products: rows * &self.products, ..*self }
    }

    /// Covariance of products that have the identity's under even noise.
    pub(super) fn covariance(&self) -> DMatrix<f64> {
        let size = self.products.nrows();
        DMatrix::identity(size, size) + self.beyond()
    }

    /// What it has beyond that.
    ///
    /// Of few draws it is drawn to a multiple of the identity (Ledoit and Wolf 2004,
    /// <https://doi.org/10.1016/S0047-259X(03)00096-4>); nothing scatters less than the even noise.
    pub(super) fn beyond(&self) -> DMatrix<f64> {
        let (size, draws) = (self.products.nrows(), self.products.ncols() as f64);
        if self.products.is_empty() {
            return DMatrix::zeros(size, size);
        }
        let even = DMatrix::identity(size, size);
        let sample = &self.products * self.products.transpose() / draws;
        let mean = sample.trace() / size as f64;
        let apart = (&sample - &even * mean).norm_squared();
        let within = |p: nalgebra::DVectorView<f64>| {
            p.norm_squared().powi(2) - 2.0 * p.dot(&(&sample * p)) + sample.norm_squared()
        };
        let scatter: f64 = self.products.column_iter().map(within).sum::<f64>() / draws.powi(2);
        let drawn = if apart > 0.0 { (scatter / apart).clamp(0.0, 1.0) } else { 0.0 };
        let beyond = sample * (1.0 - drawn) + &even * (drawn * mean - self.share);
        let eigen = beyond.symmetric_eigen();
        let kept = DMatrix::from_diagonal(&eigen.eigenvalues.map(|value| value.max(0.0)));
        &eigen.eigenvectors * kept * eigen.eigenvectors.transpose()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    const DRAWS: usize = 16;

    fn drawn(sizes: &[f64], share: f64) -> DMatrix<f64> {
        let mut stream = ChaCha8Rng::seed_from_u64(3);
        let products = DMatrix::from_fn(sizes.len(), DRAWS, |i, _| sizes[i] * normal(&mut stream));
        Strays::new(products, share).covariance()
    }

    #[test]
    fn what_the_noise_has_already_is_not_counted_twice() {
        let covariance = drawn(&[0.5_f64.sqrt(); 40], 0.5);
        let largest = covariance.symmetric_eigenvalues().max();
        assert!(largest < 1.3, "{largest}");
    }

    #[test]
    fn a_direction_in_which_products_scatter_far_counts_less_and_others_as_before() {
        let mut sizes = [0.1; 40];
        sizes[7] = 5.0;
        let covariance = drawn(&sizes, 0.1);
        assert!((8.0..45.0).contains(&covariance[(7, 7)]), "{}", covariance[(7, 7)]);
        let others: Vec<f64> = (0..40).filter(|i| *i != 7).map(|i| covariance[(i, i)]).collect();
        let mean = DVector::from_vec(others).mean();
        assert!((1.0..1.5).contains(&mean), "{mean}");
        assert_eq!(Strays::none(3).covariance(), DMatrix::identity(3, 3));
    }
}
