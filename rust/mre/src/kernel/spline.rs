//! Natural cubic splines through evenly spaced values.

/// From here on the elimination of a spline has the same factor, to the last bit.
const SETTLED: usize = 32;

/// Second derivatives, per step squared, of the natural cubic spline through evenly spaced values.
pub(crate) fn second_differences(y: &[f64]) -> Vec<f64> {
    let n = y.len();
    // Tridiagonal: m[i-1] + 4 m[i] + m[i+1] = 6 (y[i-1] - 2 y[i] + y[i+1]). The shares of the elimination soon
    // stay the same.
    let mut shares = [0.0; SETTLED];
    for i in 1..SETTLED {
        shares[i] = 1.0 / (4.0 - shares[i - 1]);
    }
    let share = |i: usize| shares[i.min(SETTLED - 1)];
    let mut bend = vec![0.0; n];
    for i in 1..n - 1 {
        bend[i] = (6.0 * (y[i - 1] - 2.0 * y[i] + y[i + 1]) - bend[i - 1]) * share(i);
    }
    for i in (1..n - 1).rev() {
        bend[i] -= share(i) * bend[i + 1];
    }
    bend
}
