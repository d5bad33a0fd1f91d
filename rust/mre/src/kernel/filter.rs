//! Prediction-error filter and inner products: the inner loops of whitened least squares.

use super::dispatch::{self, for_every_isa};
use super::elementary::fma;

/// Values computed side by side.
const WIDE: usize = 32;

/// `out[t - p] = scale (y[t] - sum_k a[k] y[t - 1 - k])` for `t` from `p = a.len()` on.
pub(crate) fn prediction_error(y: &[f64], a: &[f64], scale: f64) -> Vec<f64> {
    let mut out = vec![0.0; y.len().saturating_sub(a.len())];
    filter(dispatch::best(), y, a, scale, &mut out);
    out
}

/// `sum a b`.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    product(dispatch::best(), a, b)
}

/// Third differences: of what is smooth little is left, of white noise 20 times the mean square.
pub(crate) fn third_differences(values: &[f64]) -> Vec<f64> {
    values.windows(4).map(|v| v[3] - 3.0 * v[2] + 3.0 * v[1] - v[0]).collect()
}

for_every_isa!(filter, filter_generic, (y: &[f64], a: &[f64], scale: f64, out: &mut [f64]) -> ());
for_every_isa!(product, product_generic, (a: &[f64], b: &[f64]) -> f64);

#[inline(always)]
fn filter_generic<const FUSED: bool>(y: &[f64], a: &[f64], scale: f64, out: &mut [f64]) {
    let p = a.len();
    let (blocks, rest) = out.as_chunks_mut::<WIDE>();
    let done = blocks.len() * WIDE;
    for (b, block) in blocks.iter_mut().enumerate() {
        let start = b * WIDE + p;
        let mut sum = [0.0; WIDE];
        sum.copy_from_slice(&y[start..start + WIDE]);
        for (k, a) in a.iter().enumerate() {
            let past = &y[start - 1 - k..start - 1 - k + WIDE];
            for j in 0..WIDE {
                sum[j] = fma::<FUSED>(-*a, past[j], sum[j]);
            }
        }
        for j in 0..WIDE {
            block[j] = scale * sum[j];
        }
    }
    for (j, value) in rest.iter_mut().enumerate() {
        let t = done + j + p;
        let mut sum = y[t];
        for (k, a) in a.iter().enumerate() {
            sum = fma::<FUSED>(-*a, y[t - 1 - k], sum);
        }
        *value = scale * sum;
    }
}

#[inline(always)]
fn product_generic<const FUSED: bool>(a: &[f64], b: &[f64]) -> f64 {
    let mut sum = [0.0; WIDE];
    let ((a, ra), (b, rb)) = (a.as_chunks::<WIDE>(), b.as_chunks::<WIDE>());
    for (a, b) in a.iter().zip(b) {
        for j in 0..WIDE {
            sum[j] = fma::<FUSED>(a[j], b[j], sum[j]);
        }
    }
    let rest: f64 = ra.iter().zip(rb).map(|(a, b)| a * b).sum();
    sum.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_the_definition() {
        let y: Vec<f64> = (0..101).map(|i| f64::from(i * i % 17) - 8.0).collect();
        let a = [0.5, -0.25, 0.125];
        let out = prediction_error(&y, &a, 2.0);
        assert_eq!(out.len(), 98);
        for (j, value) in out.iter().enumerate() {
            let t = j + 3;
            let wanted = 2.0 * (y[t] - 0.5 * y[t - 1] + 0.25 * y[t - 2] - 0.125 * y[t - 3]);
            assert!((value - wanted).abs() < 1e-12);
        }
        let plain: f64 = y.iter().map(|v| v * v).sum();
        assert!((dot(&y, &y) - plain).abs() < 1e-9);
        assert!(prediction_error(&y[..2], &a, 1.0).is_empty());
    }
}
