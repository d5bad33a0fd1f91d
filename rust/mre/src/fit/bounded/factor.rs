//! The search, on a triangular factor of the columns: no digits are lost to sums of products.

/// Columns with less than this share of their length outside the span of the others depend on them.
const DEPENDENT: f64 = 1e-14;
/// A slope below this share of its terms is rounding.
const FLAT: f64 = 1e-14;

/// The coefficients u within the bounds at which `||R u - g||` is least; R is upper triangular.
///
/// Where R does not decide them all, those stay as near to zero as the search left them.
pub(crate) fn minimise<const N: usize>(
    r: &[[f64; N]; N],
    g: &[f64; N],
    lower: &[f64; N],
    upper: &[f64; N],
) -> [f64; N] {
    let nearest = std::array::from_fn(|j| 0.0_f64.clamp(lower[j], upper[j]));
    let start = solve(r, g, &nearest, &[true; N]);
    let inside: [bool; N] = std::array::from_fn(|j| start[j] >= lower[j] && start[j] <= upper[j]);
    if inside == [true; N] {
        return start;
    }
    let u = std::array::from_fn(|j| start[j].clamp(lower[j], upper[j]));
    let mut search = Search { r, g, lower, upper, u, free: inside };
    // Every pass lowers the cost; the count only guards against rounding.
    for _ in 0..4 * 3_usize.pow(N as u32) {
        search.descend();
        if !search.release() {
            break;
        }
    }
    search.u
}

struct Search<'a, const N: usize> {
    r: &'a [[f64; N]; N],
    g: &'a [f64; N],
    lower: &'a [f64; N],
    upper: &'a [f64; N],
    u: [f64; N],
    /// False for the coefficients that a bound holds.
    free: [bool; N],
}

impl<const N: usize> Search<'_, N> {
    fn solve(&self) -> [f64; N] {
        solve(self.r, self.g, &self.u, &self.free)
    }

    /// Solve for the free coefficients; stop those that would leave their bounds, until none does.
    fn descend(&mut self) {
        loop {
            let z = self.solve();
            let (mut share, mut stopped) = (1.0, None);
            for j in (0..N).filter(|j| self.free[*j]) {
                let bound = z[j].clamp(self.lower[j], self.upper[j]);
                if bound != z[j] {
                    let step = ((bound - self.u[j]) / (z[j] - self.u[j])).max(0.0);
                    if step < share || stopped.is_none() {
                        (share, stopped) = (step, Some((j, bound)));
                    }
                }
            }
            for j in (0..N).filter(|j| self.free[*j]) {
                let u = if stopped.is_some() { self.u[j] + share * (z[j] - self.u[j]) } else { z[j] };
                self.u[j] = u.clamp(self.lower[j], self.upper[j]);
            }
            let Some((j, bound)) = stopped else { return };
            (self.u[j], self.free[j]) = (bound, false);
        }
    }

    /// Free the coefficient whose bound costs most, if that lowers the cost.
    fn release(&mut self) -> bool {
        let mut tried = self.free;
        loop {
            let (mut steepest, mut which) = (0.0, None);
            for j in (0..N).filter(|j| !tried[*j] && self.lower[*j] < self.upper[*j]) {
                let (slope, size, length) = self.slope(j);
                let inward = if self.u[j] <= self.lower[j] { slope } else { -slope };
                if inward > FLAT * size && inward / length > steepest {
                    (steepest, which) = (inward / length, Some(j));
                }
            }
            let Some(j) = which else { return false };
            (tried[j], self.free[j]) = (true, true);
            // Only where it moves inward: by rounding it may not.
            let (u, z) = (self.u[j], self.solve()[j]);
            if (u <= self.lower[j] && z > u) || (u >= self.upper[j] && z < u) {
                return true;
            }
            self.free[j] = false;
        }
    }

    /// Half the slope of the cost downhill along a coefficient, the size of its terms, and the length of
    /// the column.
    fn slope(&self, j: usize) -> (f64, f64, f64) {
        let (mut slope, mut size, mut square) = (0.0, 0.0, 0.0);
        for i in 0..=j {
            let (mut rest, mut terms) = (self.g[i], self.g[i].abs());
            for k in i..N {
                rest -= self.r[i][k] * self.u[k];
                terms += (self.r[i][k] * self.u[k]).abs();
            }
            slope += self.r[i][j] * rest;
            size += (self.r[i][j] * terms).abs();
            square += self.r[i][j] * self.r[i][j];
        }
        (slope, size, f64::sqrt(square))
    }
}

/// Least squares over the free coefficients, the others as they are in `u`.
fn solve<const N: usize>(r: &[[f64; N]; N], g: &[f64; N], u: &[f64; N], free: &[bool; N]) -> [f64; N] {
    let mut basis = [[0.0; N]; N];
    let mut upper = [[0.0; N]; N];
    let mut rest = *g;
    let mut out = *u;
    let mut kept = [false; N];
    // Orthogonalise twice: exact to rounding for any condition.
    for j in (0..N).filter(|j| free[*j]) {
        let mut column: [f64; N] = std::array::from_fn(|i| if i <= j { r[i][j] } else { 0.0 });
        let length = norm(&column);
        for _ in 0..2 {
            for k in (0..j).filter(|k| kept[*k]) {
                let share = dot(&basis[k], &column);
                upper[k][j] += share;
                subtract(&mut column, share, &basis[k]);
            }
        }
        let height = norm(&column);
        kept[j] = height > DEPENDENT * length;
        if kept[j] {
            upper[j][j] = height;
            basis[j] = column.map(|c| c / height);
        }
    }
    for j in (0..N).filter(|j| !kept[*j]) {
        let column = std::array::from_fn(|i| if i <= j { r[i][j] } else { 0.0 });
        subtract(&mut rest, u[j], &column);
    }
    let mut right = [0.0; N];
    for k in (0..N).filter(|k| kept[*k]) {
        right[k] = dot(&basis[k], &rest);
        subtract(&mut rest, right[k], &basis[k]);
    }
    for j in (0..N).rev().filter(|j| kept[*j]) {
        let known: f64 = (j + 1..N).filter(|k| kept[*k]).map(|k| upper[j][k] * out[k]).sum();
        out[j] = (right[j] - known) / upper[j][j];
    }
    out
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm<const N: usize>(a: &[f64; N]) -> f64 {
    dot(a, a).sqrt()
}

fn subtract<const N: usize>(from: &mut [f64; N], share: f64, what: &[f64; N]) {
    for (from, what) in from.iter_mut().zip(what) {
        *from -= share * what;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const N: usize = 4;
    type Matrix = [[f64; N]; N];

    fn cost(r: &Matrix, g: &[f64; N], u: &[f64; N]) -> f64 {
        (0..N).map(|i| (g[i] - (i..N).map(|k| r[i][k] * u[k]).sum::<f64>()).powi(2)).sum()
    }

    /// The best of all faces of the box.
    fn by_faces(r: &Matrix, g: &[f64; N], lower: &[f64; N], upper: &[f64; N]) -> f64 {
        let mut best = f64::INFINITY;
        for face in 0..3_usize.pow(N as u32) {
            let state: [usize; N] = std::array::from_fn(|j| face / 3_usize.pow(j as u32) % 3);
            let u = std::array::from_fn(|j| if state[j] == 2 { upper[j] } else { lower[j] });
            let z = solve(r, g, &u, &state.map(|s| s == 0));
            if (0..N).all(|j| z[j] >= lower[j] && z[j] <= upper[j]) {
                best = best.min(cost(r, g, &z));
            }
        }
        best
    }

    fn triangle(entries: &[f64]) -> Matrix {
        std::array::from_fn(|i| std::array::from_fn(|j| if i <= j { entries[i * N + j] } else { 0.0 }))
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, rng_seed: proptest::test_runner::RngSeed::Fixed(1), ..ProptestConfig::default() })]
        #[test]
        fn no_face_of_the_box_is_better(
            entries in prop::array::uniform16(-1.0..1.0_f64),
            g in prop::array::uniform4(-3.0..3.0_f64),
            low in prop::array::uniform4(-2.0..1.0_f64),
            width in prop::array::uniform4(0.01..3.0_f64),
            squeeze in prop_oneof![Just(1.0), 1e-9..1e-3_f64],
            dependent in prop::bool::ANY,
        ) {
            let mut r = triangle(&entries);
            r[3][3] *= squeeze;
            if dependent {
                r[2] = [0.0, 0.0, 0.0, r[2][3]];
            }
            let high = std::array::from_fn(|j| low[j] + width[j]);
            let u = minimise(&r, &g, &low, &high);
            prop_assert!((0..N).all(|j| u[j] >= low[j] && u[j] <= high[j]));
            let (got, wanted) = (cost(&r, &g, &u), by_faces(&r, &g, &low, &high));
            prop_assert!(got <= wanted * (1.0 + 1e-10) + 1e-20, "{got} {wanted}");
        }
    }

    #[test]
    fn inside_the_box_it_is_the_solution() {
        let r = triangle(&[2.0, 1.0, 0.5, 0.1, 0.0, 3.0, 1.0, 0.2, 0.0, 0.0, 1.0, 0.3, 0.0, 0.0, 0.0, 0.7]);
        let truth = [0.3, -0.2, 0.9, -0.5];
        let g = std::array::from_fn(|i| (0..N).map(|k| r[i][k] * truth[k]).sum());
        let u = minimise(&r, &g, &[-1.0; N], &[1.0; N]);
        assert!((0..N).all(|j| (u[j] - truth[j]).abs() < 1e-15));
    }

    #[test]
    fn nothing_is_decided_by_a_zero_column() {
        let u = minimise(&[[1.0, 0.0], [0.0, 0.0]], &[0.5, 2.0], &[0.0, 3.0], &[1.0, 4.0]);
        assert_eq!(u, [0.5, 3.0]);
    }
}
