//! Tails of distributions.

/// Tests that decide count a gain this much less: the noise was estimated from the same residuals, and far out in the
/// tail that makes chance gains larger still than on average ([`super::noise::Noise::inflation`]).
pub(super) const CAUTION: f64 = 1.1;

/// `P(X > x)` of a chi-square variable.
pub(super) fn chi_square_tail(x: f64, freedom: usize) -> f64 {
    upper_gamma(0.5 * freedom as f64, 0.5 * x)
}

/// The value that a chi-square variable exceeds with a chance, by bisection.
pub(super) fn chi_square_beyond(chance: f64, freedom: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while chi_square_tail(high, freedom) > chance {
        (low, high) = (high, 2.0 * high);
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if chi_square_tail(middle, freedom) > chance { low = middle } else { high = middle }
    }
    // From above: at least as far out.
    high
}

/// Regularised upper incomplete gamma function, by series and continued fraction (Abramowitz and Stegun
/// 6.5.29 and 6.5.31).
fn upper_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let front = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > 1e-17 * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return (1.0 - front * sum).max(0.0);
    }
    let tiny = 1e-300;
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / tiny, 1.0 / b);
    let mut fraction = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let a_i = -i * (i - a);
        b += 2.0;
        d = 1.0 / (a_i * d + b).abs().max(tiny).copysign(a_i * d + b);
        c = b + a_i / c;
        let factor = c * d;
        fraction *= factor;
        if (factor - 1.0).abs() < 1e-15 {
            break;
        }
    }
    front * fraction
}

/// Logarithm of the gamma function (Lanczos 1964, with seven terms).
fn ln_gamma(x: f64) -> f64 {
    const G: [f64; 9] = [
        0.999_999_999_999_809_9,
        676.520_368_121_885_1,
        -1_259.139_216_722_402_8,
        771.323_428_777_653_1,
        -176.615_029_162_140_6,
        12.507_343_278_686_905,
        -0.138_571_095_265_720_12,
        9.984_369_578_019_572e-6,
        1.505_632_735_149_311_6e-7,
    ];
    let x = x - 1.0;
    let t = x + 7.5;
    let sum: f64 = G[0] + G[1..].iter().enumerate().map(|(i, g)| g / (x + i as f64 + 1.0)).sum::<f64>();
    0.5 * std::f64::consts::TAU.ln() + (x + 0.5) * t.ln() - t + sum.ln()
}

/// Chance that the ratio of mean squares of so many normal values over so many exceeds `x`, by cube roots, which are
/// nearly normal (Paulson, Ann. Math. Stat. 13 (1942) 233).
pub(super) fn f_tail(x: f64, above: usize, below: usize) -> f64 {
    let (a, b) = (2.0 / (9.0 * above as f64), 2.0 / (9.0 * below as f64));
    let root = x.cbrt();
    normal_tail(((1.0 - b) * root - (1.0 - a)) / (b * root * root + a).sqrt())
}

/// `P(X > x)` of a standard normal variable.
pub(super) fn normal_tail(x: f64) -> f64 {
    let beyond = 0.5 * chi_square_tail(x * x, 1);
    if x > 0.0 { beyond } else { 1.0 - beyond }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tails_of_tables() {
        for (x, freedom, p) in [
            (3.841_458_820_694_124, 1, 0.05),
            (6.634_896_601_021_213, 1, 0.01),
            (18.307_038_053_275_146, 10, 0.05),
            (124.342_113_400_407_95, 100, 0.050_000_000_022_697_465),
            (2.705_543_454_095_404, 1, 0.1),
        ] {
            assert!((chi_square_tail(x, freedom) - p).abs() < 1e-12, "{x} {freedom}");
            assert!((chi_square_beyond(p, freedom) / x - 1.0).abs() < 1e-9, "{p} {freedom}");
        }
        assert!((normal_tail(1.959_963_984_540_054) - 0.025).abs() < 1e-12);
        assert!((normal_tail(-1.959_963_984_540_054) - 0.975).abs() < 1e-12);
        for (x, above, below, p) in [(4.965, 1, 10, 0.05), (5.636, 4, 10, 0.012_3), (3.326, 5, 10, 0.05)] {
            assert!((f_tail(x, above, below) / p - 1.0).abs() < 0.05, "{x} {above} {below}");
        }
        assert!((chi_square_tail(200.0, 1) / 2.088_487_583_762_545e-45 - 1.0).abs() < 1e-9);
    }
}
