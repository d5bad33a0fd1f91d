//! Sum over the lanes.

/// Sum in pairs. A call, because the compiler would give the loop before it the narrow lanes of the
/// last pairs.
#[inline(never)]
pub(super) fn total<const N: usize>(sums: &mut [f64; N]) -> f64 {
    let mut width = N / 2;
    while width > 0 {
        for l in 0..width {
            sums[l] += sums[l + width];
        }
        width /= 2;
    }
    sums[0]
}
