//! Covariance of a weighted least-squares estimate whose noise is correlated.
//!
//! With the tangents J, the weights W and the covariance V of the noise it is
//! `(J'WJ)^-1 J'W V W J (J'WJ)^-1`, the sandwich; V is that of an autoregression for each recording.
//! The estimated V makes the variance of a parameter uncertain: its degrees of freedom follow from the
//! covariance of the autoregression (Satterthwaite 1946, <https://doi.org/10.2307/3002019>).

use std::sync::atomic::AtomicBool;

use nalgebra::{DMatrix, DVector};

use super::noise::Noise;
use crate::error::{Error, Result};

/// Most steps of the correction of the noise.
const CORRECTIONS: usize = 20;
/// Singular values below this share of the largest are taken as that.
const DEPENDENT: f64 = 1e-14;

/// Tangents of all recordings, factored.
#[derive(Debug)]
pub(super) struct Tangents {
    /// Orthonormal columns of the tangents times the root of the weights, one block a recording.
    bases: Vec<DMatrix<f64>>,
    weights: Vec<f64>,
    /// `scaled tangents = basis left singular right'`, columns scaled to unit length.
    left: DMatrix<f64>,
    singular: DVector<f64>,
    right: DMatrix<f64>,
    /// Lengths of the columns.
    lengths: Vec<f64>,
}

impl Tangents {
    /// `columns[r][j]`: derivative by parameter j over recording r. No column is zero.
    pub(super) fn new(columns: &[Vec<&[f64]>], weights: &[f64]) -> Option<Self> {
        let samples: Vec<usize> =
            columns.iter().map(|c| c.first().map_or(0, |column| column.len())).collect();
        let (n, k) = (samples.iter().sum::<usize>(), columns.first().map_or(0, Vec::len));
        let mut matrix = DMatrix::zeros(n, k);
        let mut first = 0;
        for ((recording, weight), count) in columns.iter().zip(weights).zip(&samples) {
            for (j, column) in recording.iter().enumerate() {
                for (i, value) in column.iter().enumerate() {
                    matrix[(first + i, j)] = weight.sqrt() * value;
                }
            }
            first += count;
        }
        let lengths: Vec<f64> = matrix.column_iter().map(|c| c.norm()).collect();
        if n <= k || lengths.iter().any(|l| !l.is_finite() || *l == 0.0) {
            return None;
        }
        for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
            column /= *length;
        }
        let (q, r) = matrix.qr().unpack();
        let svd = r.svd(true, true);
        let mut first = 0;
        let bases = samples
            .iter()
            .map(|count| {
                let block = q.rows(first, *count).into_owned();
                first += count;
                block
            })
            .collect();
        let least = DEPENDENT * svd.singular_values.max();
        Some(Self {
            bases,
            weights: weights.to_vec(),
            left: svd.u?,
            singular: svd.singular_values.map(|s| s.max(least)),
            right: svd.v_t?.transpose(),
            lengths,
        })
    }

    /// Number of parameters.
    pub(super) fn len(&self) -> usize {
        self.lengths.len()
    }

    /// Root mean square of the force that a unit of each parameter makes, weighted, N.
    pub(super) fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// Largest over smallest singular value of the tangents with columns of unit length.
    pub(super) fn condition_number(&self) -> f64 {
        self.singular.max() / self.singular.min()
    }

    /// The direction that the force tells least of, in units in which each parameter alone would
    /// change the force by 1 N rms, and the force it makes, N rms.
    pub(super) fn weakest(&self) -> (Vec<f64>, f64) {
        let place = self.singular.imin();
        (self.right.column(place).iter().copied().collect(), self.singular[place])
    }

    /// Noise of every recording from the residuals of the fit.
    ///
    /// # Errors
    /// [`Error::Stopped`] soon after `cancel` is set.
    pub(super) fn noise(
        &self,
        residuals: &[Vec<f64>],
        rates: &[f64],
        cancel: &AtomicBool,
    ) -> Result<Vec<Noise>> {
        let mut noise: Vec<Noise> =
            residuals.iter().zip(rates).map(|(e, rate)| Noise::of(e, *rate)).collect();
        let found: Vec<Vec<f64>> = noise.iter().zip(residuals).map(|(n, e)| n.products(e)).collect();
        for _ in 0..CORRECTIONS {
            Error::if_stopped(cancel)?;
            let spread = self.spread(&noise, &self.colour(&noise));
            let better: Vec<Noise> = noise
                .iter()
                .enumerate()
                .map(|(r, before)| {
                    Error::if_stopped(cancel)?;
                    Ok(before.corrected(&found[r], &self.bases[r], self.weights[r], &spread))
                })
                .collect::<Result<_>>()?;
            let settled = better.iter().zip(&noise).all(|(now, before)| now.is_near(before));
            noise = better;
            if settled {
                break;
            }
        }
        Ok(noise)
    }

    fn colour(&self, noise: &[Noise]) -> Vec<DMatrix<f64>> {
        noise.iter().zip(&self.bases).map(|(noise, basis)| noise.colour(basis)).collect()
    }

    /// Covariance of the products of basis and weighted noise.
    fn spread(&self, noise: &[Noise], coloured: &[DMatrix<f64>]) -> DMatrix<f64> {
        let k = self.len();
        coloured
            .iter()
            .zip(noise)
            .zip(&self.weights)
            .fold(DMatrix::zeros(k, k), |sum, ((u, noise), weight)| {
                sum + u.tr_mul(u) * (noise.variance * weight)
            })
    }

    /// Parameters by the products of basis and weighted noise.
    fn map(&self) -> DMatrix<f64> {
        let mut map = self.right.clone();
        for (j, mut column) in map.column_iter_mut().enumerate() {
            column /= self.singular[j];
        }
        let mut map = map * self.left.transpose();
        for (i, mut row) in map.row_iter_mut().enumerate() {
            row /= self.lengths[i];
        }
        map
    }

    /// Covariance of the parameters for noise that is known.
    ///
    /// # Errors
    /// [`Error::Stopped`] soon after `cancel` is set.
    pub(super) fn covariance(&self, noise: &[Noise], cancel: &AtomicBool) -> Result<Covariance> {
        let coloured = self.colour(noise);
        let k = self.len();
        let parts = coloured.iter().zip(noise).zip(&self.weights).zip(&self.bases);
        let parts = parts
            .map(|(((u, noise), weight), basis)| {
                Error::if_stopped(cancel)?;
                let scale = noise.variance * weight;
                // The fit takes one sample a parameter, shared by the recordings.
                let taken = basis.norm_squared();
                let samples = (basis.nrows() as f64 - taken).max(1.0);
                Ok(Part {
                    spread: u.tr_mul(u) * scale,
                    sensitivity: noise.sensitivity(u).into_iter().map(|s| s * (2.0 * scale)).collect(),
                    coefficients: noise.coefficient_covariance(samples),
                    samples,
                })
            })
            .collect::<Result<Vec<_>>>()?;
        let spread = parts.iter().fold(DMatrix::zeros(k, k), |sum, part| sum + &part.spread);
        let map = self.map();
        Ok(Covariance { matrix: &map * spread * map.transpose(), naive: &map * map.transpose(), map, parts })
    }
}

/// Covariance of the parameters, and how well it is known.
#[derive(Debug)]
pub(super) struct Covariance {
    pub(super) matrix: DMatrix<f64>,
    /// `(J'WJ)^-1`: how fast the cost grows with the parameters.
    pub(super) naive: DMatrix<f64>,
    map: DMatrix<f64>,
    parts: Vec<Part>,
}

/// What one recording adds.
#[derive(Debug)]
struct Part {
    spread: DMatrix<f64>,
    sensitivity: Vec<DMatrix<f64>>,
    coefficients: DMatrix<f64>,
    samples: f64,
}

impl Covariance {
    /// Variance of a linear combination of the parameters, and its degrees of freedom.
    pub(super) fn of(&self, combination: &DVector<f64>) -> (f64, f64) {
        let c = self.map.tr_mul(combination);
        let square = |matrix: &DMatrix<f64>| c.dot(&(matrix * &c));
        let (mut variance, mut uncertain) = (0.0, 0.0);
        for part in &self.parts {
            let share = square(&part.spread);
            let slope = DVector::from_iterator(part.sensitivity.len(), part.sensitivity.iter().map(square));
            variance += share;
            uncertain += 2.0 * share * share / part.samples + slope.dot(&(&part.coefficients * &slope));
        }
        let freedom = if uncertain > 0.0 { 2.0 * variance * variance / uncertain } else { f64::MAX };
        (variance, freedom.max(1.0))
    }
}
