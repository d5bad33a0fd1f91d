//! First-order lags side by side, summed: the relaxation of many Maxwell branches in one pass.

use super::dispatch::{self, for_every_isa};
use super::elementary::fma;

/// Lags computed side by side.
const WIDE: usize = 8;
/// Steps that differ by less than this share of themselves count as equal.
const SAME_STEP: f64 = 1e-9;
/// Keeps a state that fades away from denormal numbers, which are slow; of no size beside any input.
const NOTHING: f64 = 1e-250;

/// `sum w y` of `y' = (u - y) / tau` from rest for pairs `(tau, w)`: exact for an input that is linear
/// between samples.
pub(crate) fn lags(time: &[f64], input: &[f64], of: &[(f64, f64)]) -> Vec<f64> {
    let mut sum = vec![0.0; input.len()];
    for eight in of.chunks(WIDE) {
        add(dispatch::best(), time, input, eight, &mut sum);
    }
    sum
}

/// `y' = (u - y) / tau` from `start`.
pub(crate) fn lag(time: &[f64], input: &[f64], tau: f64, start: f64) -> Vec<f64> {
    let mut y = start;
    let mut out = Vec::with_capacity(input.len());
    out.push(y);
    for (from, to) in runs(time) {
        let [decay, early, late] = step(time[from] - time[from - 1], tau);
        for i in from..to {
            y = decay * y + (early * input[i - 1] + late * input[i] + NOTHING);
            out.push(y);
        }
    }
    out
}

/// Stretches of samples that follow their predecessors after equal steps.
pub(crate) fn runs(time: &[f64]) -> impl Iterator<Item = (usize, usize)> {
    let mut next = 1;
    std::iter::from_fn(move || {
        let from = next;
        let first = time.get(from)? - time[from - 1];
        let alike = |i: &usize| ((time[*i] - time[*i - 1]) - first).abs() <= SAME_STEP * first;
        next = (from + 1..time.len()).find(|i| !alike(i)).unwrap_or(time.len());
        Some((from, next))
    })
}

/// Weights of the state, of the input before and of the input now, over a step.
fn step(h: f64, tau: f64) -> [f64; 3] {
    let h = h / tau;
    let whole = -(-h).exp_m1();
    let late = 1.0 - whole / h;
    [1.0 - whole, whole - late, late]
}

for_every_isa!(add, add_generic, (time: &[f64], input: &[f64], of: &[(f64, f64)], sum: &mut [f64]) -> ());

#[inline(always)]
fn add_generic<const FUSED: bool>(time: &[f64], input: &[f64], of: &[(f64, f64)], sum: &mut [f64]) {
    let mut y = [0.0; WIDE];
    let mut weight = [0.0; WIDE];
    for (l, (_, w)) in of.iter().enumerate() {
        weight[l] = *w;
    }
    for (from, to) in runs(time) {
        let (mut decay, mut early, mut late) = ([0.0; WIDE], [0.0; WIDE], [0.0; WIDE]);
        for (l, (tau, _)) in of.iter().enumerate() {
            [decay[l], early[l], late[l]] = step(time[from] - time[from - 1], *tau);
        }
        for i in from..to {
            let (before, now) = (input[i - 1], input[i]);
            let mut total = [0.0; WIDE];
            for l in 0..WIDE {
                let entering = fma::<FUSED>(early[l], before, fma::<FUSED>(late[l], now, NOTHING));
                y[l] = fma::<FUSED>(decay[l], y[l], entering);
                total[l] = weight[l] * y[l];
            }
            let [a, b, c, d, e, f, g, h] = total;
            sum[i] += ((a + e) + (b + f)) + ((c + g) + (d + h));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_is_that_of_the_lags() {
        // Two sampling rates in one series.
        let time: Vec<f64> = (0..300)
            .map(|i| if i < 100 { f64::from(i) * 0.01 } else { 1.0 + f64::from(i - 100) * 0.02 })
            .collect();
        let input: Vec<f64> = time.iter().map(|t| (3.0 * t).sin() + 0.2).collect();
        let of: Vec<(f64, f64)> = (0..11).map(|k| (0.01 * 1.7_f64.powi(k), 1.0 + f64::from(k))).collect();
        let found = lags(&time, &input, &of);
        let each: Vec<Vec<f64>> = of.iter().map(|(tau, _)| lag(&time, &input, *tau, 0.0)).collect();
        for i in 0..time.len() {
            let wanted: f64 = each.iter().zip(&of).map(|(y, (_, w))| w * y[i]).sum();
            assert!((found[i] - wanted).abs() < 1e-12 * 100.0, "{i}");
        }
    }

    #[test]
    fn a_constant_input_is_approached_exponentially() {
        let time: Vec<f64> = (0..50).map(|i| f64::from(i) * 0.03).collect();
        let found = lag(&time, &vec![2.0; 50], 0.2, 0.5);
        for (t, y) in time.iter().zip(&found) {
            assert!((y - (2.0 - 1.5 * (-t / 0.2).exp())).abs() < 1e-13);
        }
    }
}
