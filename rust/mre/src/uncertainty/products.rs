//! What one recording adds to the covariance of a fit that is put together elsewhere.

use nalgebra::DMatrix;

use super::noise::Noise;
use crate::error::{Error, Result};

/// Products of tangents with each other, and with the noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Products {
    /// `J' V J` row by row, with the tangents J and the covariance V of the noise.
    pub noisy: Vec<f64>,
    /// Independent samples whose mean would be as certain as that of the noise; at most those there are.
    pub independent: f64,
}

/// Work in one recording: the tangents as columns, and the residuals of the fit.
///
/// The noise is an autoregression of the residuals as they are, as in [`super::estimate`] but without the
/// correction for what the fit has taken, which needs all recordings at once.
///
/// # Errors
/// A column of another length than the residuals, or numbers that are not finite.
pub fn products(columns: &[Vec<f64>], residual: &[f64], rate: f64) -> Result<Products> {
    let n = residual.len();
    if let Some(column) = columns.iter().find(|c| c.len() != n) {
        return Err(Error::setting(
            "samples of a tangent",
            column.len(),
            format!("{n}, as of the residuals"),
        ));
    }
    if !(rate.is_finite() && columns.iter().flatten().chain(residual).all(|value| value.is_finite())) {
        return Err(Error::setting("tangents and residuals", "not finite", "finite numbers"));
    }
    let noise = Noise::of(residual, rate);
    let coloured = noise.colour(&DMatrix::from_fn(n, columns.len(), |i, j| columns[j][i]));
    let noisy = coloured.tr_mul(&coloured) * noise.variance;
    let gain = 1.0 - noise.phi.iter().sum::<f64>();
    let share =
        if noise.variance > 0.0 { noise.autocovariance[0] * gain * gain / noise.variance } else { 1.0 };
    Ok(Products { noisy: noisy.iter().copied().collect(), independent: n as f64 * share.min(1.0) })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// An autoregression of order one with coefficient 0.8, driven by a fixed sequence.
    fn residual(n: usize) -> Vec<f64> {
        let mut state = 1_u32;
        let mut last = 0.0;
        (0..n)
            .map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                last = 0.8 * last + f64::from(state) / f64::from(u32::MAX) - 0.5;
                last
            })
            .collect()
    }

    #[test]
    fn a_constant_is_as_uncertain_as_the_long_run_says() {
        let n = 20_000;
        let found = products(&[vec![1.0; n]], &residual(n), 100.0).unwrap();
        // Innovations of variance 1/12, and 1 / (1 - 0.8) of them in the long run.
        let wanted = n as f64 / 12.0 / 0.04;
        assert!((found.noisy[0] / wanted - 1.0).abs() < 0.1, "{}", found.noisy[0] / wanted);
        assert!((found.independent / (n as f64 / 9.0) - 1.0).abs() < 0.1, "{}", found.independent);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        assert!(products(&[vec![1.0; 3]], &[0.0; 4], 1.0).is_err());
        assert!(products(&[vec![f64::NAN; 4]], &[0.0; 4], 1.0).is_err());
    }
}
