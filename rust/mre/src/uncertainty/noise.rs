//! The noise of a recording as an autoregression: `e_t = sum_j phi_j e_(t-j) + a_t`.
//!
//! Order by BIC from the Yule-Walker equations. The residuals of a fit are smaller than the noise and
//! less correlated, because the fit takes a part of it: the autocovariances are corrected until those
//! that the autoregression would leave after the fit are the ones found (after Worsley et al. 2002,
//! <https://doi.org/10.1006/nimg.2001.0933>, with the autocovariance of the whole autoregression).
//! Samples are taken as evenly spaced.

use nalgebra::DMatrix;

use super::levinson::{Levinson, limit, products};

/// Longest memory of the autoregression, s.
const MEMORY: f64 = 0.3;
/// At least so many samples for each coefficient.
const SAMPLES_PER_COEFFICIENT: usize = 10;
/// White noise in every autoregression, as a share of its variance: oversampled residuals would
/// otherwise be foretold exactly.
const FLOOR: f64 = 1e-6;
/// Change of the autocovariance at which it is settled.
const NEAR: f64 = 1e-6;
/// Filters run on into the past until less than this is left, or as long again.
const NOTHING: f64 = 1e-9;

/// An autoregression.
#[derive(Debug, Clone)]
pub(super) struct Noise {
    pub(super) phi: Vec<f64>,
    /// Variance of the innovations, N^2.
    pub(super) variance: f64,
    /// Autocovariances up to the order, N^2.
    pub(super) autocovariance: Vec<f64>,
}

impl Noise {
    /// From residuals as they are.
    pub(super) fn of(residual: &[f64], rate: f64) -> Self {
        let n = residual.len();
        let most = ((MEMORY * rate) as usize).min(n / SAMPLES_PER_COEFFICIENT);
        let mut sums: Vec<f64> = products(residual, most).iter().map(|c| c / n as f64).collect();
        sums[0] *= 1.0 + FLOOR;
        if sums[0] <= 0.0 {
            return Self { phi: Vec::new(), variance: 0.0, autocovariance: vec![0.0] };
        }
        let mut best = (f64::INFINITY, 0);
        let mut reflections = Levinson::new(sums[0]);
        for (order, sum) in sums.iter().enumerate() {
            if order > 0 && !reflections.raise(*sum, limit(n)) {
                break;
            }
            let criterion = n as f64 * reflections.variance.ln() + order as f64 * (n as f64).ln();
            if criterion < best.0 {
                best = (criterion, order);
            }
        }
        let white = Self { phi: Vec::new(), variance: sums[0], autocovariance: vec![sums[0]] };
        Self::from_autocovariance(&sums[..=best.1], n).unwrap_or(white)
    }

    /// `None` for values that are no autocovariance of a noise with a memory within the recording.
    fn from_autocovariance(wanted: &[f64], n: usize) -> Option<Self> {
        let mut found = Levinson::new(wanted[0]);
        let stationary = wanted[0] > 0.0 && wanted[1..].iter().all(|next| found.raise(*next, limit(n)));
        stationary.then_some(Self {
            phi: found.phi,
            variance: found.variance,
            autocovariance: found.autocovariance,
        })
    }

    /// The noise whose residuals after the fit would have the autocovariances found, one step nearer.
    ///
    /// `found` are the products of the residuals up to the order ([`Self::products`]).
    /// `basis` holds orthonormal columns of the weighted tangents, row by row those of this recording,
    /// `weight` its weight, and `spread` the covariance of the products of basis and weighted noise.
    pub(super) fn corrected(
        &self,
        found: &[f64],
        basis: &DMatrix<f64>,
        weight: f64,
        spread: &DMatrix<f64>,
    ) -> Self {
        let n = basis.nrows();
        let taken = self.times(basis); // V Q
        let pulled = basis * spread / weight;
        let wanted: Vec<f64> = found
            .iter()
            .enumerate()
            .map(|(lag, found)| {
                let m = n - lag;
                let (early, late) = (basis.rows(0, m), basis.rows(lag, m));
                let lost = taken.rows(0, m).dot(&late) + taken.rows(lag, m).dot(&early)
                    - pulled.rows(0, m).dot(&late);
                (found + lost) / m as f64 * if lag == 0 { 1.0 + FLOOR } else { 1.0 }
            })
            .collect();
        let part = |share: f64| {
            let pairs = wanted.iter().zip(&self.autocovariance);
            let mixed: Vec<f64> = pairs.map(|(new, old)| old + share * (new - old)).collect();
            Self::from_autocovariance(&mixed, n)
        };
        [1.0, 0.5, 0.25].into_iter().find_map(part).unwrap_or_else(|| self.clone())
    }

    /// `sum_t e_t e_(t + lag)` of residuals up to the order.
    pub(super) fn products(&self, residual: &[f64]) -> Vec<f64> {
        products(residual, self.phi.len())
    }

    /// True where the autocovariances are those of another noise but for a small share.
    pub(super) fn is_near(&self, other: &Self) -> bool {
        let pairs = self.autocovariance.iter().zip(&other.autocovariance);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) <= NEAR * self.autocovariance[0]
    }

    /// Columns filtered so that their products are those with the noise: `U'U variance = Q' V Q`. The
    /// rows begin before the first sample, as far as the memory reaches.
    pub(super) fn colour(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let n = columns.nrows();
        let filtered: Vec<Vec<f64>> =
            columns.column_iter().map(|c| self.backwards(c.iter().copied())).collect();
        let rows = filtered.iter().map(Vec::len).max().unwrap_or(n);
        // Backwards in time: the last sample comes first.
        DMatrix::from_fn(rows, columns.ncols(), |i, j| filtered[j].get(i).copied().unwrap_or(0.0))
    }

    /// Covariance matrix of the noise times columns.
    fn times(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let (n, coloured) = (columns.nrows(), self.colour(columns));
        let mut out = DMatrix::zeros(n, columns.ncols());
        for (j, column) in coloured.column_iter().enumerate() {
            let mut past: Vec<f64> = Vec::with_capacity(column.len());
            for value in column.iter().rev() {
                let t = past.len();
                past.push(value + self.recall(&past, t));
            }
            let skip = past.len() - n;
            for i in 0..n {
                out[(i, j)] = self.variance * past[skip + i];
            }
        }
        out
    }

    /// Run the autoregression from the last value to the first, and on until it has died away.
    fn backwards(&self, values: impl DoubleEndedIterator<Item = f64>) -> Vec<f64> {
        let mut out: Vec<f64> = Vec::new();
        for value in values.rev() {
            let t = out.len();
            out.push(value + self.recall(&out, t));
        }
        let (n, order) = (out.len(), self.phi.len());
        let largest = out.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        while order > 0 && out.len() < 2 * n {
            if out[out.len() - order..].iter().all(|u| u.abs() <= NOTHING * largest) {
                break;
            }
            let t = out.len();
            out.push(self.recall(&out, t));
        }
        out
    }

    /// What the values before place `t` make of the next one.
    pub(super) fn recall(&self, values: &[f64], t: usize) -> f64 {
        self.phi.iter().take(t).enumerate().map(|(j, phi)| phi * values[t - 1 - j]).sum()
    }

    /// Products of the coloured columns with their change by each coefficient: the derivative of
    /// `U'U` by `phi_lag` is the matrix and its transpose.
    pub(super) fn sensitivity(&self, coloured: &DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let rows = coloured.nrows();
        let mut again = coloured.clone();
        for j in 0..again.ncols() {
            let mut past: Vec<f64> = Vec::with_capacity(rows);
            for i in 0..rows {
                past.push(coloured[(i, j)] + self.recall(&past, i));
            }
            again.column_mut(j).copy_from_slice(&past);
        }
        (1..=self.phi.len())
            .map(|lag| coloured.rows(lag, rows - lag).tr_mul(&again.rows(0, rows - lag)))
            .collect()
    }

    /// Covariance of the coefficients as estimated from `n` samples.
    pub(super) fn coefficient_covariance(&self, n: f64) -> DMatrix<f64> {
        let order = self.phi.len();
        let toeplitz = DMatrix::from_fn(order, order, |i, j| self.autocovariance[i.abs_diff(j)]);
        let inverse = toeplitz.cholesky().map_or_else(|| DMatrix::zeros(order, order), |c| c.inverse());
        inverse * (self.variance / n)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn ar2() -> Noise {
        // Autocovariance by its own recursion from the closed form of order two.
        let (p1, p2) = (1.2, -0.5);
        let g0 = (1.0 - p2) / ((1.0 + p2) * ((1.0 - p2) * (1.0 - p2) - p1 * p1));
        let g1 = p1 * g0 / (1.0 - p2);
        Noise::from_autocovariance(&[g0, g1, p1 * g1 + p2 * g0], 1000).unwrap()
    }

    fn covariance(noise: &Noise, n: usize) -> DMatrix<f64> {
        let mut g = noise.autocovariance.clone();
        while g.len() < n {
            let t = g.len();
            g.push(noise.recall(&g, t));
        }
        DMatrix::from_fn(n, n, |i, j| g[i.abs_diff(j)])
    }

    fn columns(n: usize) -> DMatrix<f64> {
        DMatrix::from_fn(n, 2, |i, j| (0.1 * (i * (j + 1)) as f64).sin() + j as f64)
    }

    #[test]
    fn yule_walker_finds_the_coefficients() {
        let noise = ar2();
        assert!((noise.phi[0] - 1.2).abs() < 1e-12 && (noise.phi[1] + 0.5).abs() < 1e-12);
        assert!((noise.variance - 1.0).abs() < 1e-12);
    }

    #[test]
    fn filters_are_the_covariance_matrix() {
        let (noise, q) = (ar2(), columns(60));
        let v = covariance(&noise, 60);
        assert!((noise.times(&q) - &v * &q).amax() < 1e-7);
        let u = noise.colour(&q);
        assert!((u.tr_mul(&u) * noise.variance - q.tr_mul(&(v * &q))).amax() < 1e-6);
    }

    #[test]
    fn sensitivity_is_the_derivative() {
        let (noise, q) = (ar2(), columns(60));
        let found = noise.sensitivity(&noise.colour(&q));
        for (lag, half) in found.iter().enumerate() {
            let at = |step: f64| {
                let mut moved = noise.clone();
                moved.phi[lag] += step;
                let u = moved.colour(&q);
                u.tr_mul(&u)
            };
            let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
            let both = half + half.transpose();
            assert!((&difference - &both).amax() < 1e-4 * both.amax());
        }
    }

    #[test]
    fn correction_undoes_what_the_fit_takes() {
        // Autocovariances exactly as expected after the fit lead back to the noise.
        let noise = ar2();
        let (n, q) = (80, columns(80).qr().q());
        let v = covariance(&noise, n);
        let m = DMatrix::identity(n, n) - &q * q.transpose();
        let left = &m * &v * &m;
        let expected = |lag: usize| (0..n - lag).map(|i| left[(i, i + lag)]).sum::<f64>();
        let spread = q.tr_mul(&(&v * &q));
        let pulled = &q * &spread;
        let taken = noise.times(&q);
        for lag in 0..3 {
            let k = n - lag;
            let lost = taken.rows(0, k).dot(&q.rows(lag, k)) + taken.rows(lag, k).dot(&q.rows(0, k))
                - pulled.rows(0, k).dot(&q.rows(lag, k));
            let whole = noise.autocovariance[lag] * k as f64;
            assert!((expected(lag) + lost - whole).abs() < 1e-6 * whole.abs());
        }
    }
}
