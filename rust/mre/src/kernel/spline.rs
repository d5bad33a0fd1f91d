//! Natural cubic splines through evenly spaced values.

use super::recursion::{backward, forward};

/// From here on the elimination of a spline has the same factor, to the last bit.
const SETTLED: usize = 32;

/// Second derivatives, per step squared, of the natural cubic spline through evenly spaced values.
pub(crate) fn second_differences(y: &[f64]) -> Vec<f64> {
    let n = y.len();
    if n < 3 {
        return vec![0.0; n];
    }
    // Tridiagonal: m[i-1] + 4 m[i] + m[i+1] = 6 (y[i-1] - 2 y[i] + y[i+1]). The shares of the elimination soon
    // stay the same.
    let mut shares = [0.0; SETTLED];
    for i in 1..SETTLED {
        shares[i] = 1.0 / (4.0 - shares[i - 1]);
    }
    let share = shares[SETTLED - 1];
    let mut bend = vec![0.0; n];
    for (bend, y) in bend[1..].iter_mut().zip(y.windows(3)) {
        *bend = 6.0 * (y[0] - 2.0 * y[1] + y[2]);
    }
    let settled = SETTLED.min(n - 1);
    for i in 1..settled {
        bend[i] = (bend[i] - bend[i - 1]) * shares[i];
    }
    let later = &mut bend[settled - 1..n - 1];
    if let Some((before, later)) = later.split_first_mut() {
        for bend in &mut *later {
            *bend *= share;
        }
        forward(-share, *before, later);
        backward(-share, 0.0, later);
    }
    for i in (1..settled).rev() {
        bend[i] -= shares[i] * bend[i + 1];
    }
    bend
}
