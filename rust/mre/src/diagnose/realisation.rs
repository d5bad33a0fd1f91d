//! Realisations of an autoregression.

use rand_chacha::ChaCha8Rng;

use crate::deviate::normal;

/// `count` samples of an autoregression driven by normal shocks, after as many to forget its start.
///
/// Least squares may find one that grows: its memory is made no longer than the series.
pub(super) fn realisation(
    coefficients: &[f64],
    deviation: f64,
    count: usize,
    stream: &mut ChaCha8Rng,
) -> Vec<f64> {
    let coefficients = forgetful(coefficients, 1.0 - 1.0 / count as f64);
    let mut series: Vec<f64> = Vec::with_capacity(2 * count);
    for _ in 0..2 * count {
        let past = series.iter().rev().zip(&coefficients);
        let value = past.map(|(y, a)| a * y).sum::<f64>() + deviation * normal(stream);
        series.push(value);
    }
    series.split_off(count)
}

/// The coefficients, shrunk until every pole lies within a radius below one.
fn forgetful(coefficients: &[f64], radius: f64) -> Vec<f64> {
    let scaled = |factor: f64| -> Vec<f64> {
        coefficients.iter().enumerate().map(|(k, a)| a * factor.powi(k as i32 + 1)).collect()
    };
    let mut factor = 1.0;
    while !decays(scaled(factor / radius)) {
        factor *= radius;
    }
    scaled(factor)
}

/// True where all poles lie within the unit circle: every partial autocorrelation is below one.
///
/// By the step-down recursion (Levinson 1946).
fn decays(mut a: Vec<f64>) -> bool {
    while let Some(last) = a.pop() {
        if last.abs() >= 1.0 || !last.is_finite() {
            return false;
        }
        let count = a.len();
        a = (0..count).map(|k| (a[k] + last * a[count - 1 - k]) / (1.0 - last * last)).collect();
    }
    true
}

#[cfg(test)]
mod tests {
    use rand_core::SeedableRng;

    use super::*;

    #[test]
    fn a_process_decays_where_its_poles_lie_inside() {
        // Poles 0.9 and -0.5, then 1.1 and -0.5: the sum is the first coefficient, minus the product the second.
        assert!(decays(vec![0.4, 0.45]));
        assert!(!decays(vec![0.6, 0.55]));
        assert!(decays(Vec::new()));
        assert!(!decays(vec![1.0]));
    }

    #[test]
    fn a_growing_process_is_tamed_and_a_decaying_one_kept() {
        assert_eq!(forgetful(&[0.4, 0.45], 0.99), [0.4, 0.45]);
        let tamed = forgetful(&[0.6, 0.55], 0.99);
        let pole = 0.5 * (tamed[0] + (tamed[0].powi(2) + 4.0 * tamed[1]).sqrt());
        assert!((0.97..=0.99 + 1e-12).contains(&pole), "{pole}");
    }

    #[test]
    fn a_realisation_has_the_variance_of_its_process() {
        let mut stream = ChaCha8Rng::seed_from_u64(3);
        let y = realisation(&[0.8], 0.6, 40_000, &mut stream);
        let mean_square = y.iter().map(|y| y * y).sum::<f64>() / y.len() as f64;
        assert!((mean_square - 1.0).abs() < 0.05, "{mean_square}");
        let next: f64 = y.windows(2).map(|p| p[0] * p[1]).sum::<f64>() / y.len() as f64;
        assert!((next / mean_square - 0.8).abs() < 0.01, "{next}");
    }
}
