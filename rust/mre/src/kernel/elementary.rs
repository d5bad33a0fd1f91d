//! Elementary functions that the compiler can spread over SIMD lanes: no branch, no table, no call.

/// `a * b + c`: fused where the kernel was built for it, two roundings elsewhere.
#[inline(always)]
pub(super) fn fma<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

const ROUND: f64 = 6_755_399_441_055_744.0; // 1.5 * 2^52: adding it rounds to an integer
const LN2_HIGH: f64 = 6.931_471_803_691_238e-1; // ln 2 in two parts; the first ends in zero bits
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// The integer nearest to `x` (|x| < 2^51), as a number and as the bits of its two's complement.
#[inline(always)]
fn round(x: f64) -> (f64, u64) {
    let shifted = x + ROUND;
    (shifted - ROUND, shifted.to_bits().wrapping_sub(ROUND.to_bits()))
}

/// 2^k for an integer k in [-1022, 1023], given by its bits.
#[inline(always)]
fn power_of_two(k: u64) -> f64 {
    f64::from_bits(k.wrapping_add(1023) << 52)
}

/// sinh for |x| <= 700, relative error below 4e-15.
///
/// With `x = k ln 2 + r`, `sinh x = sinh(k ln 2) cosh r + cosh(k ln 2) sinh r`: nothing cancels for
/// small x, where k is zero.
#[inline(always)]
pub(super) fn sinh_lane<const FUSED: bool>(x: f64) -> f64 {
    let (k, bits) = round(x * std::f64::consts::LOG2_E);
    let r = fma::<FUSED>(k, -LN2_LOW, fma::<FUSED>(k, -LN2_HIGH, x));
    let q = r * r;
    let mut s = 1.0 / 6_227_020_800.0;
    let mut c = 1.0 / 479_001_600.0;
    for (odd, even) in [
        (1.0 / 39_916_800.0, 1.0 / 3_628_800.0),
        (1.0 / 362_880.0, 1.0 / 40_320.0),
        (1.0 / 5_040.0, 1.0 / 720.0),
        (1.0 / 120.0, 1.0 / 24.0),
        (1.0 / 6.0, 0.5),
    ] {
        s = fma::<FUSED>(s, q, odd);
        c = fma::<FUSED>(c, q, even);
    }
    let sinh_r = fma::<FUSED>(s * q, r, r);
    let cosh_r = fma::<FUSED>(c, q, 1.0);
    let (up, down) = (0.5 * power_of_two(bits), 0.5 * power_of_two(bits.wrapping_neg()));
    fma::<FUSED>(up - down, cosh_r, (up + down) * sinh_r)
}

/// sinh over the whole range of numbers.
pub(crate) fn sinh(x: f64) -> f64 {
    if x.abs() <= 700.0 { sinh_lane::<false>(x) } else { x.sinh() }
}

/// 1 / d for d in [1.7, 2.5]: a line and three steps of Newton, cheaper than a division.
#[inline(always)]
fn reciprocal<const FUSED: bool>(d: f64) -> f64 {
    let mut y = fma::<FUSED>(d, -0.242_640_687, 0.994_821_5);
    for _ in 0..3 {
        y = fma::<FUSED>(y, fma::<FUSED>(-d, y, 1.0), y);
    }
    y
}

/// `x^n` for x in [0, 2] and n in [0, 1000]: relative error below 1e-13 for n up to 10 where the result
/// is normal; results below 1e-300 may be 0 or 1e-300.
///
/// The polynomials are evaluated in pairs (Estrin): the lanes wait for each other's results otherwise.
#[inline(always)]
pub(super) fn power_lane<const FUSED: bool>(x: f64, n: f64) -> f64 {
    // x = m 2^e with m in [sqrt(1/2), sqrt(2)).
    let bits = x.to_bits();
    let shift = bits.wrapping_sub(0x3fe6_a09e_667f_3bcd) & 0xfff0_0000_0000_0000;
    let m = f64::from_bits(bits.wrapping_sub(shift));
    // The exponent as a number: its 12 bits placed in the mantissa of 2^52 (biased to stay positive).
    let biased = (shift >> 52).wrapping_add(0x800) & 0xfff;
    let e = f64::from_bits(0x4330_0000_0000_0000 | biased) - 4_503_599_627_372_544.0;
    // log2 m = 2 / ln 2 artanh t.
    let t = (m - 1.0) * reciprocal::<FUSED>(m + 1.0);
    let q = t * t;
    let c = [1.0, 1.0 / 3.0, 0.2, 1.0 / 7.0, 1.0 / 9.0, 1.0 / 11.0, 1.0 / 13.0, 1.0 / 15.0, 1.0 / 17.0];
    let q2 = q * q;
    let q4 = q2 * q2;
    let low = fma::<FUSED>(fma::<FUSED>(c[3], q, c[2]), q2, fma::<FUSED>(c[1], q, c[0]));
    let high = fma::<FUSED>(fma::<FUSED>(c[7], q, c[6]), q2, fma::<FUSED>(c[5], q, c[4]));
    let artanh = t * fma::<FUSED>(fma::<FUSED>(c[8], q4, high), q4, low);
    let log2 = fma::<FUSED>(artanh, 2.0 * std::f64::consts::LOG2_E, e);
    let y = (n * log2).max(-1000.0);
    let (k, bits) = round(y);
    let r = (y - k) * std::f64::consts::LN_2;
    let r2 = r * r;
    let r4 = r2 * r2;
    let pair = |odd: f64, even: f64| fma::<FUSED>(odd, r, even);
    let low = fma::<FUSED>(pair(1.0 / 6.0, 0.5), r2, pair(1.0, 1.0));
    let middle = fma::<FUSED>(pair(1.0 / 5_040.0, 1.0 / 720.0), r2, pair(1.0 / 120.0, 1.0 / 24.0));
    let high =
        fma::<FUSED>(pair(1.0 / 39_916_800.0, 1.0 / 3_628_800.0), r2, pair(1.0 / 362_880.0, 1.0 / 40_320.0));
    fma::<FUSED>(fma::<FUSED>(high, r4, middle), r4, low) * power_of_two(bits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn relative(got: f64, wanted: f64) -> f64 {
        if got == wanted { 0.0 } else { ((got - wanted) / wanted).abs() }
    }

    #[test]
    fn sinh_is_right_at_the_ends() {
        assert_eq!(sinh(0.0), 0.0);
        assert_eq!(sinh(5e-324), 5e-324);
        assert!(sinh(710.4).is_finite());
        assert_eq!(sinh(711.0), f64::INFINITY);
        assert_eq!(sinh(-711.0), f64::NEG_INFINITY);
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]

        #[test]
        fn sinh_is_accurate(x in prop_oneof![-700.0..700.0, -2.0..2.0, -1e-8..1e-8_f64]) {
            prop_assert!(relative(sinh_lane::<true>(x), x.sinh()) < 4e-15);
            prop_assert!(relative(sinh_lane::<false>(x), x.sinh()) < 4e-15);
        }

        #[test]
        fn power_is_accurate(x in 1e-9..2.0_f64, n in 1.0..10.0_f64) {
            let wanted = x.powf(n);
            prop_assert!(relative(power_lane::<true>(x, n), wanted) < 1e-13, "{x} ^ {n}");
            prop_assert!(relative(power_lane::<false>(x, n), wanted) < 1e-13, "{x} ^ {n}");
        }
    }

    #[test]
    fn power_of_nothing_is_nothing() {
        assert!(power_lane::<true>(0.0, 1.0) < 1e-300);
        assert_eq!(power_lane::<true>(1.0, 7.3), 1.0);
    }
}
