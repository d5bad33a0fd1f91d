//! Chebyshev series of sinh: `sinh(b t) = sum_k 2 I_(2k+1)(b) T_(2k+1)(t)` for t in [-1, 1], and the
//! number of terms it needs.
//!
//! **Bound.** After K terms the rest is at most `I_2K(b) |sinh(b t)|`, for every t. Proof: with
//! `|T_n(t)| <= n |t|` the rest is at most `|t| sum_(k >= K) 2 (2k+1) I_(2k+1)(b)`. The recurrence
//! `2 n I_n(b) = b (I_(n-1)(b) - I_(n+1)(b))` turns the sum into `b sum (I_2k - I_(2k+2)) = b I_2K(b)`,
//! because `I_n(b)` falls to zero with n; and `b |t| <= |sinh(b t)|`.
//! From the power series, with `(n+1)(n+2)...(n+j) >= (n+1)^j`,
//! `I_n(b) <= (b/2)^n / n! exp(b^2 / (4 (n+1)))`, which grows with b: the largest b of a box decides.
//!
//! **Values.** `I_n(b) = (b/2)^n / n! g_n` with `g_(n-1) = g_n + y g_(n+1) / (n (n+1))`, `y = b^2 / 4`:
//! downward from a short power series, everything is positive, nothing cancels, divides or overflows.

use super::elementary::fma;

/// Most terms of the series: b up to [`LARGEST`]. Wider boxes are left to the direct kernel.
pub(crate) const MOST_NODES: usize = 32;
/// Largest b for which they are surely enough.
pub(crate) const LARGEST: f64 = 25.0;
/// Largest relative error of the series that is cut: that of one rounding.
const TOLERANCE: f64 = f64::EPSILON / 2.0;

/// Terms after which the series of sinh is exact to rounding for all |b| up to `largest`; `None` above
/// [`MOST_NODES`].
pub(crate) fn nodes(largest: f64) -> Option<usize> {
    let (b, mut term) = (largest.abs(), 1.0);
    for k in 1..=MOST_NODES {
        let n = 2.0 * k as f64;
        term *= 0.25 * b * b / (n * (n - 1.0));
        if k > 1 && term * (0.25 * b * b / (n + 1.0)).exp() <= TOLERANCE {
            return Some(k);
        }
    }
    None
}

/// The functions of orders 0 to `2 nodes`, for arguments up to a largest one.
#[derive(Debug, Clone)]
pub(crate) struct Bessel {
    /// Largest order.
    top: usize,
    /// `1 / (n (n+1))`.
    step: [f64; 2 * MOST_NODES + 2],
    /// Power series in y of g at orders `top` and `top - 1`, from the highest power to the lowest.
    start: Vec<[f64; 2]>,
}

impl Bessel {
    pub(crate) fn new(nodes: usize, largest: f64) -> Self {
        let top = 2 * nodes;
        let step = std::array::from_fn(|n| if n == 0 { 0.0 } else { 1.0 / (n * (n + 1)) as f64 });
        let y = 0.25 * largest * largest;
        let mut start = vec![[1.0; 2]];
        let (mut term, mut value): ([f64; 2], f64) = ([1.0; 2], 1.0);
        while value > 0.01 * TOLERANCE {
            let j = start.len();
            term[0] /= (j * (top + j)) as f64;
            term[1] /= (j * (top - 1 + j)) as f64;
            value *= y / (j * (top - 1 + j)) as f64;
            start.push(term);
        }
        start.reverse();
        Self { top, step, start }
    }

    /// g of orders `top` and `top - 1`.
    #[inline(always)]
    fn start<const FUSED: bool, const L: usize>(&self, y: &[f64; L]) -> [[f64; L]; 2] {
        let mut g = [[0.0; L]; 2];
        for c in &self.start {
            for l in 0..L {
                g[0][l] = fma::<FUSED>(g[0][l], y[l], c[0]);
                g[1][l] = fma::<FUSED>(g[1][l], y[l], c[1]);
            }
        }
        g
    }

    /// `factor 2 I_(2k+1)(b)` for k below the number of nodes, lane by lane.
    #[inline(always)]
    pub(super) fn odd<const FUSED: bool, const L: usize>(
        &self,
        b: &[f64; L],
        factor: &[f64; L],
        out: &mut [[f64; L]],
    ) {
        let (mut y, mut power) = ([0.0; L], [0.0; L]);
        for l in 0..L {
            y[l] = 0.25 * b[l] * b[l];
            power[l] = factor[l] * b[l];
        }
        let count = out.len().min(MOST_NODES);
        for k in 0..count {
            out[k] = power;
            let step = self.step[2 * k + 2];
            for l in 0..L {
                power[l] *= step * y[l];
            }
        }
        let [mut above, mut g] = self.start::<FUSED, L>(&y);
        for k in (0..count).rev() {
            let (first, second) = (self.step[2 * k + 1], self.step[2 * k]);
            let out = &mut out[k];
            for l in 0..L {
                out[l] *= g[l];
            }
            for l in 0..L {
                above[l] = fma::<FUSED>(first * y[l], above[l], g[l]);
            }
            for l in 0..L {
                g[l] = fma::<FUSED>(second * y[l], g[l], above[l]);
            }
        }
    }

    /// `I_n(b)` for n from 0 to twice the number of nodes.
    pub(crate) fn all(&self, b: f64) -> [f64; 2 * MOST_NODES + 1] {
        let y = 0.25 * b * b;
        let [[mut above], [mut g]] = self.start::<false, 1>(&[y]);
        let mut out = [0.0; 2 * MOST_NODES + 1];
        out[self.top] = above;
        for n in (0..self.top).rev() {
            out[n] = g;
            (above, g) = (g, g + self.step[n] * y * above);
        }
        let mut power = 1.0;
        for (n, value) in out.iter_mut().enumerate() {
            *value *= power;
            power *= 0.5 * b / (n + 1) as f64;
        }
        out
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Power series, term by term.
    fn series(n: usize, b: f64) -> f64 {
        let mut term = (1..=n).fold(1.0, |t, i| t * 0.5 * b / i as f64);
        let mut sum = term;
        for j in 1..200 {
            term *= 0.25 * b * b / (j * (n + j)) as f64;
            sum += term;
        }
        sum
    }

    #[test]
    fn the_default_box_needs_eleven_nodes() {
        assert_eq!(nodes(3.0), Some(11));
        assert_eq!(nodes(0.0), Some(2));
        assert!(nodes(25.0).is_some());
        assert_eq!(nodes(27.0), None);
        assert_eq!(nodes(f64::INFINITY), None);
        assert_eq!(nodes(f64::NAN), None);
    }

    proptest! {
        #![proptest_config(ProptestConfig { rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]

        #[test]
        fn values_equal_the_series(share in 0.0..1.0_f64, largest in 0.01..25.0_f64, sign in prop::bool::ANY) {
            let count = nodes(largest).unwrap();
            let bessel = Bessel::new(count, largest);
            let b = share * largest * if sign { 1.0 } else { -1.0 };
            let all = bessel.all(b);
            let mut odd = vec![[0.0; 4]; count];
            bessel.odd::<false, 4>(&[0.0, b, 0.5 * b, b], &[1.0; 4], &mut odd);
            let mut fused = odd.clone();
            bessel.odd::<true, 4>(&[0.0, b, 0.5 * b, b], &[1.0; 4], &mut fused);
            for n in 0..=2 * count {
                let wanted = series(n, b);
                prop_assert!((all[n] - wanted).abs() <= 1e-14 * wanted.abs(), "I_{n}({b})");
            }
            for (k, lanes) in odd.iter().enumerate() {
                let wanted = 2.0 * series(2 * k + 1, b);
                prop_assert!((lanes[1] - wanted).abs() <= 1e-14 * wanted.abs() + 1e-300);
                prop_assert_eq!(lanes[1].to_bits(), lanes[3].to_bits());
                prop_assert_eq!(lanes[0], 0.0);
                prop_assert!((lanes[1] - fused[k][1]).abs() <= 1e-14 * wanted.abs() + 1e-300);
            }
        }

        #[test]
        fn the_cut_series_is_sinh(t in -1.0..1.0_f64, b in 0.01..25.0_f64) {
            let count = nodes(b).unwrap();
            let all = Bessel::new(count, b).all(b);
            let angle = t.acos();
            let (mut sum, mut size) = (0.0, 0.0);
            for n in (1..2 * count).step_by(2) {
                sum += 2.0 * all[n] * (n as f64 * angle).cos();
                size += 2.0 * all[n] * n as f64; // the angle is rounded
            }
            let error = (sum - (b * t).sinh()).abs();
            prop_assert!(error <= 1e-15 * size, "{error} of {size}");
        }

        #[test]
        fn the_bound_holds(b in 0.01..25.0_f64) {
            let count = nodes(b).unwrap();
            let rest: f64 = (count..count + 40).map(|k| 2.0 * series(2 * k + 1, b)).sum();
            prop_assert!(series(2 * count, b) <= TOLERANCE);
            prop_assert!(rest <= b * TOLERANCE);
        }
    }
}
