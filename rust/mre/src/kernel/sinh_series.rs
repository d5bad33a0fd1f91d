//! sinh of bounded arguments as an odd polynomial: half the operations of the version for all arguments.
//!
//! The power series, shortened by Chebyshev polynomials (economisation): every coefficient is positive, so
//! nothing cancels, and a candidate's alpha and beta are taken into the coefficients.

use std::sync::LazyLock;

/// Fewest and most coefficients; beyond the bound of the longest, powers of two are as fast.
const SHORTEST: usize = 6;
pub(super) const LONGEST: usize = 18;
/// What the terms left out may add up to, relative to sinh, before they change each other: a unit in the last place
/// afterwards.
const ERROR: f64 = 1.1e-16;
/// Terms of the power series that are shortened away; the next one is below the error.
const BEYOND: usize = 8;

/// `sinh x = x (c[0] + c[1] x^2 + ...)` for |x| up to `reach`.
struct Series {
    reach: f64,
    coefficients: Vec<f64>,
}

static SERIES: LazyLock<Vec<Series>> =
    LazyLock::new(|| (SHORTEST..=LONGEST).map(Series::shortened).collect());

impl Series {
    /// The widest series with this many coefficients.
    fn shortened(count: usize) -> Self {
        let terms = count + BEYOND;
        let mut power = vec![1.0];
        for j in 1..terms {
            power.push(power[j - 1] / ((2 * j) * (2 * j + 1)) as f64);
        }
        // Dropping term n of argument u = (x / reach)^2 for a Chebyshev polynomial leaves c_n / 2^(2n - 1).
        let lost = |n: usize, reach: f64| power[n] * reach.powi(2 * n as i32) / 2_f64.powi(2 * n as i32 - 1);
        let (mut reach, mut above) = (0.0, 32.0);
        for _ in 0..60 {
            let middle = 0.5 * (reach + above);
            let all: f64 = (count..terms).map(|n| lost(n, middle)).sum();
            *(if all <= ERROR { &mut reach } else { &mut above }) = middle;
        }
        let mut scaled: Vec<f64> =
            power.iter().enumerate().map(|(j, c)| c * reach.powi(2 * j as i32)).collect();
        let chebyshev = shifted_chebyshev(terms);
        for n in (count..terms).rev() {
            let share = scaled[n] / chebyshev[n][n];
            for (c, t) in scaled.iter_mut().zip(&chebyshev[n]) {
                *c -= share * t;
            }
        }
        let coefficients = (0..count).map(|j| scaled[j] / reach.powi(2 * j as i32)).collect();
        Self { reach, coefficients }
    }
}

/// Coefficients of the Chebyshev polynomials on [0, 1], of degrees 0 to `count - 1`.
fn shifted_chebyshev(count: usize) -> Vec<Vec<f64>> {
    let mut all = vec![vec![1.0], vec![-1.0, 2.0]];
    for n in 2..count {
        let mut next = vec![0.0; n + 1];
        for (i, t) in all[n - 1].iter().enumerate() {
            next[i] -= 2.0 * t;
            next[i + 1] += 4.0 * t;
        }
        for (i, t) in all[n - 2].iter().enumerate() {
            next[i] -= t;
        }
        all.push(next);
    }
    all
}

/// Coefficients of `alpha sinh(beta x) = x (c[0] + c[1] x^2 + ...)` for |x| up to `farthest`, and how many
/// there are; none where |beta x| is too large.
pub(super) fn coefficients(alpha: f64, beta: f64, farthest: f64) -> Option<([f64; LONGEST], usize)> {
    let reach = beta.abs() * farthest;
    let series = SERIES.iter().find(|series| reach <= series.reach)?;
    let mut out = [0.0; LONGEST];
    let mut scale = alpha * beta;
    for (out, c) in out.iter_mut().zip(&series.coefficients) {
        *out = scale * c;
        scale *= beta * beta;
    }
    Some((out, series.coefficients.len()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn value(coefficients: &[f64], x: f64) -> f64 {
        x * coefficients.iter().rev().fold(0.0_f64, |sum, c| sum.mul_add(x * x, *c))
    }

    #[test]
    fn every_series_is_as_accurate_as_a_number() {
        for series in SERIES.iter() {
            assert!(series.coefficients.iter().all(|c| *c > 0.0));
            for i in 1..=4000 {
                let x = series.reach * f64::from(i) / 4000.0;
                let error = (value(&series.coefficients, x) / x.sinh() - 1.0).abs();
                // Rounding x^2 alone moves sinh by half a unit for each unit of x.
                assert!(error < 2e-15, "{error} at {x} with {}", series.coefficients.len());
            }
        }
        assert!(SERIES.last().unwrap().reach > 11.0);
    }

    #[test]
    fn alpha_and_beta_are_in_the_coefficients() {
        for (alpha, beta) in [(3.0, 0.07), (-0.2, 1.3), (1e5, -4.0), (0.0, 2.0), (7.0, 0.0)] {
            for argument in [0.1, 0.9, 2.9, 6.0, 11.0] {
                let farthest = if beta == 0.0 { 1.0 } else { argument / f64::abs(beta) };
                let (c, count) = coefficients(alpha, beta, farthest).unwrap();
                for x in [-farthest, 0.3 * farthest, 0.0, farthest] {
                    let (found, wanted) = (value(&c[..count], x), alpha * (beta * x).sinh());
                    assert!((found - wanted).abs() <= 4e-15 * wanted.abs(), "{alpha} {beta} {x}");
                }
            }
        }
    }

    #[test]
    fn large_arguments_have_no_series() {
        assert!(coefficients(1.0, 14.0, 1.0).is_none());
        assert!(coefficients(1.0, f64::NAN, 1.0).is_none());
    }
}
