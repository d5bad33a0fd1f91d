//! Elementary functions that the compiler can spread over SIMD lanes: no branch, no table, no call.

/// `a * b + c`: fused where the kernel was built for it, two roundings elsewhere.
#[inline(always)]
pub(super) fn fma<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}

/// Adding it rounds to an integer, which then stands in the low bits: 1.5 * 2^52.
const ROUND: f64 = 6_755_399_441_055_744.0;
const LN2_HIGH: f64 = 6.931_471_803_691_238e-1; // ln 2 in two parts; the first ends in zero bits
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Largest |x| of the lane version of sinh.
pub(super) const LARGEST: f64 = 700.0;

/// (sinh r / r - 1) / r^2 and (cosh r - 1) / r^2 in powers of r^2, interpolated at the Chebyshev nodes of
/// |r| <= ln 2 / 2.
const SINH: [f64; 5] = [
    0.166_666_666_666_666_7,
    8.333_333_333_330_063e-3,
    1.984_126_986_304_708e-4,
    2.755_726_847_015_456e-6,
    2.510_038_066_379_376_6e-8,
];
const COSH: [f64; 5] = [
    0.5,
    4.166_666_666_662_414e-2,
    1.388_888_891_720_521_7e-3,
    2.480_152_130_916_285_5e-5,
    2.762_008_216_238_176_5e-7,
];

/// sinh for |x| <= [`LARGEST`], relative error below 4e-15.
///
/// With `x = k ln 2 + r`, `sinh x = sinh(k ln 2) cosh r + cosh(k ln 2) sinh r`: nothing cancels for
/// small x, where k is zero.
#[inline(always)]
pub(super) fn sinh_lane<const FUSED: bool>(x: f64) -> f64 {
    // The low bits hold k + 1022, the biased exponent of 2^k / 2.
    const SHIFT: f64 = ROUND + 1022.0;
    let shifted = fma::<FUSED>(x, std::f64::consts::LOG2_E, SHIFT);
    let k = shifted - SHIFT;
    let up = shifted.to_bits() << 52;
    let down = f64::from_bits((2044_u64 << 52).wrapping_sub(up));
    let up = f64::from_bits(up);
    let r = fma::<FUSED>(k, -LN2_LOW, fma::<FUSED>(k, -LN2_HIGH, x));
    let q = r * r;
    let (mut s, mut c) = (SINH[4], COSH[4]);
    for i in [3, 2, 1, 0] {
        s = fma::<FUSED>(s, q, SINH[i]);
        c = fma::<FUSED>(c, q, COSH[i]);
    }
    let sinh_r = fma::<FUSED>(s * q, r, r);
    let cosh_r = fma::<FUSED>(c, q, 1.0);
    fma::<FUSED>(up - down, cosh_r, (up + down) * sinh_r)
}

/// sinh over the whole range of numbers.
pub(crate) fn sinh(x: f64) -> f64 {
    if x.abs() <= LARGEST { sinh_lane::<false>(x) } else { x.sinh() }
}

/// log2(1 + u) / u in powers of u, interpolated at the Chebyshev nodes of sqrt(1/2) <= 1 + u <= sqrt(2).
const LOG2: [f64; 18] = [
    1.442_695_040_888_961,
    -0.721_347_520_444_474_4,
    0.480_898_346_966_351_86,
    -0.360_673_760_229_318_74,
    0.288_539_007_445_984_6,
    -0.240_449_171_765_410_1,
    0.206_099_351_656_608_67,
    -0.180_337_045_607_589_1,
    0.160_297_077_506_528_47,
    -0.144_261_731_585_146_88,
    0.131_202_230_899_538_34,
    -0.120_418_758_911_285_28,
    0.110_514_334_454_355_37,
    -0.100_446_529_340_712_09,
    0.097_046_055_281_226_02,
    -0.107_159_657_047_949_54,
    0.100_976_951_025_871_06,
    -0.046_943_209_524_542_81,
];
/// 2^r in powers of r, interpolated at the Chebyshev nodes of |r| <= 1/2.
const EXP2: [f64; 11] = [
    1.0,
    std::f64::consts::LN_2,
    0.240_226_506_959_100_97,
    5.550_410_866_444_772e-2,
    9.618_129_107_606_888e-3,
    1.333_355_823_016_497_4e-3,
    1.540_353_044_173_605e-4,
    1.525_265_726_020_083_7e-5,
    1.321_544_258_792_169e-6,
    1.020_869_029_995_830_6e-7,
    7.072_585_949_269_223e-9,
];

/// Coefficients `c[i] + c[i + 1] x` (those that there are), for evaluation in pairs.
#[inline(always)]
fn pair<const FUSED: bool>(c: &[f64], i: usize, x: f64) -> f64 {
    if i + 1 < c.len() { fma::<FUSED>(c[i + 1], x, c[i]) } else { c[i] }
}

/// `x^n` for x in [0, 2] and n in [0, 1000]: relative error below 1e-13 for n up to 10 where the result
/// is normal; results below 1e-300 may be 0 or 1e-300.
///
/// The polynomials are evaluated in pairs (Estrin): the lanes wait for each other's results otherwise.
#[inline(always)]
pub(super) fn power_lane<const FUSED: bool>(x: f64, n: f64) -> f64 {
    // x = (1 + u) 2^e with 1 + u in [sqrt(1/2), sqrt(2)).
    let bits = x.to_bits();
    let shift = bits.wrapping_sub(0x3fe6_a09e_667f_3bcd) & 0xfff0_0000_0000_0000;
    let u = f64::from_bits(bits.wrapping_sub(shift)) - 1.0;
    // The exponent as a number: its 12 bits placed in the mantissa of 2^52 (biased to stay positive).
    let biased = (shift ^ (1 << 63)) >> 52;
    let e = f64::from_bits(0x4330_0000_0000_0000 | biased) - 4_503_599_627_372_544.0;
    let c = |i: usize| pair::<FUSED>(&LOG2, i, u);
    let u2 = u * u;
    let u4 = u2 * u2;
    let u8 = u4 * u4;
    let quad = |i: usize| fma::<FUSED>(c(i + 2), u2, c(i));
    let eight = |i: usize| fma::<FUSED>(quad(i + 4), u4, quad(i));
    let upper = fma::<FUSED>(c(16), u8, eight(8));
    let log2_over_u = fma::<FUSED>(upper, u8, eight(0));
    let y = fma::<FUSED>(n * u, log2_over_u, n * e).max(-1000.0);
    let shifted = y + ROUND;
    let r = y - (shifted - ROUND);
    let c = |i: usize| pair::<FUSED>(&EXP2, i, r);
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = fma::<FUSED>(c(2), r2, c(0));
    let middle = fma::<FUSED>(c(6), r2, c(4));
    let high = fma::<FUSED>(c(10), r2, c(8));
    let exp2 = fma::<FUSED>(fma::<FUSED>(high, r4, middle), r4, low);
    // Times 2^k, by its exponent: the low bits of `shifted` are k.
    f64::from_bits(exp2.to_bits().wrapping_add(shifted.to_bits() << 52))
}

/// Error function, to 2e-7 (Abramowitz and Stegun 1964, 7.1.26).
pub(crate) fn erf(x: f64) -> f64 {
    let size = x.abs();
    let t = 1.0 / (1.0 + 0.327_591_1 * size);
    let series = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    (1.0 - series.iter().fold(0.0, |sum, c| (sum + c) * t) * (-size * size).exp()).copysign(x)
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
