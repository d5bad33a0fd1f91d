//! First-order lags side by side, summed: the relaxation of many Maxwell branches in one pass.

use nalgebra::ComplexField;

use super::dispatch::{self, for_every_isa};
use super::elementary::fma;
use super::recursion::forward;
use super::spline::second_differences;

/// Lags computed side by side.
const WIDE: usize = 8;
/// Terms of the series for a short step.
const TERMS: usize = 16;
/// Steps that differ by less than this share of themselves count as equal.
const SAME_STEP: f64 = 1e-9;
/// Or by so many of the last binary digit of the time.
const ROUNDED: f64 = 4.0;
/// Keeps a state that fades away from denormal numbers, which are slow; of no size beside any input.
const NOTHING: f64 = 1e-250;

/// One of many lags, `y' = (u - y) / tau`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lag {
    /// s.
    pub(crate) tau: f64,
    /// Of `y` in the sum.
    pub(crate) weight: f64,
    /// `y` at the first sample.
    pub(crate) start: f64,
}

/// Weighted sum of lags: exact for the cubic spline through evenly spaced
/// samples. A line between them would cost a fast branch a hundredth of its force at twenty samples a cycle.
pub(crate) fn lags(time: &[f64], input: &[f64], of: &[Lag]) -> Vec<f64> {
    let mut sum = vec![0.0; input.len()];
    let bend = bends(time, input);
    for eight in of.chunks(WIDE) {
        add(dispatch::best(), time, input, &bend, eight, &mut sum);
    }
    sum
}

/// `y' = (u - y) / tau` from `start`.
pub(crate) fn lag(time: &[f64], input: &[f64], tau: f64, start: f64) -> Vec<f64> {
    let bend = bends(time, input);
    let mut out = vec![start; input.len()];
    for (from, to) in runs(time) {
        let Step { decay, early, late, bent } = Step::over((time[from] - time[from - 1]) / tau);
        let before = out[from - 1];
        let ends = input[from - 1..to].windows(2).zip(bend[from - 1..to].windows(2));
        for (out, (u, bend)) in out[from..to].iter_mut().zip(ends) {
            let curved = bent[0] * bend[0] + bent[1] * bend[1];
            *out = early * u[0] + late * u[1] + curved + NOTHING;
        }
        forward(decay, before, &mut out[from..to]);
    }
    out
}

/// Second derivatives, per step squared, of the splines through even stretches.
pub(crate) fn bends(time: &[f64], input: &[f64]) -> Vec<f64> {
    let mut found = vec![0.0; input.len()];
    for (from, to) in runs(time) {
        // A sample where the step changes belongs to both stretches: a spline ends there without a bend.
        if to - from > 1 {
            found[from - 1..to].copy_from_slice(&second_differences(&input[from - 1..to]));
        }
    }
    found
}

/// Stretches of samples that follow their predecessors after equal steps.
pub(crate) fn runs(time: &[f64]) -> impl Iterator<Item = (usize, usize)> {
    let mut next = 1;
    std::iter::from_fn(move || {
        let from = next;
        let first = time.get(from)? - time[from - 1];
        let alike = |i: &usize| {
            let kept = ROUNDED * f64::EPSILON * time[*i].abs();
            ((time[*i] - time[*i - 1]) - first).abs() <= SAME_STEP * first + kept
        };
        next = (from + 1..time.len()).find(|i| !alike(i)).unwrap_or(time.len());
        Some((from, next))
    })
}

/// Weights of the powers 0 to 3 of the share of a step, over a step of so many time constants `q`: the integral of
/// `q exp(-q (1 - s)) s^k`.
pub(crate) fn weights<N: ComplexField<RealField = f64> + Copy>(q: N) -> [N; 4] {
    if q.modulus() > 1.0 {
        let mut weights = [-(-q).exp_m1(); 4];
        for k in 1..4 {
            weights[k] = N::one() - weights[k - 1].scale(k as f64) / q;
        }
        return weights;
    }
    std::array::from_fn(|k| {
        let mut term = q.unscale((k + 1) as f64);
        let mut sum = term;
        for j in 1..TERMS {
            term *= -q.unscale((k + 1 + j) as f64);
            sum += term;
        }
        sum
    })
}

/// Weights over a step of the state, of the input before and now, and of its second differences before and now: exact for
/// a cubic spline.
pub(crate) struct Step<N> {
    pub(crate) decay: N,
    pub(crate) early: N,
    pub(crate) late: N,
    pub(crate) bent: [N; 2],
}

impl<N: ComplexField<RealField = f64> + Copy> Step<N> {
    /// Of `y' = rate (u - y)`, over so many time constants.
    pub(crate) fn over(q: N) -> Self {
        let [whole, late, square, cube] = weights(q);
        let before = square.scale(3.0) - late.scale(2.0) - cube;
        let bent = [before, cube - late].map(|weight| weight.unscale(6.0));
        Self { decay: (-q).exp(), early: whole - late, late, bent }
    }
}

for_every_isa!(
    add,
    add_generic,
    (time: &[f64], input: &[f64], bend: &[f64], of: &[Lag], sum: &mut [f64]) -> ()
);

#[inline(always)]
fn add_generic<const FUSED: bool>(time: &[f64], input: &[f64], bend: &[f64], of: &[Lag], sum: &mut [f64]) {
    let mut y = [0.0; WIDE];
    let mut weight = [0.0; WIDE];
    for (l, lag) in of.iter().enumerate() {
        (weight[l], y[l]) = (lag.weight, lag.start);
        sum[0] += lag.weight * lag.start;
    }
    for (from, to) in runs(time) {
        let (mut decay, mut early, mut late) = ([0.0; WIDE], [0.0; WIDE], [0.0; WIDE]);
        let mut bent = [[0.0; WIDE]; 2];
        for (l, lag) in of.iter().enumerate() {
            let step = Step::over((time[from] - time[from - 1]) / lag.tau);
            (decay[l], early[l], late[l]) = (step.decay, step.early, step.late);
            (bent[0][l], bent[1][l]) = (step.bent[0], step.bent[1]);
        }
        for i in from..to {
            let (before, now) = (input[i - 1], input[i]);
            let (bend_before, bend_now) = (bend[i - 1], bend[i]);
            let mut total = [0.0; WIDE];
            for l in 0..WIDE {
                let curved =
                    fma::<FUSED>(bent[0][l], bend_before, fma::<FUSED>(bent[1][l], bend_now, NOTHING));
                let entering = fma::<FUSED>(early[l], before, fma::<FUSED>(late[l], now, curved));
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
        let of: Vec<Lag> = (0..11)
            .map(|k| Lag {
                tau: 0.01 * 1.7_f64.powi(k),
                weight: 1.0 + f64::from(k),
                start: 0.1 * f64::from(k),
            })
            .collect();
        let found = lags(&time, &input, &of);
        let each: Vec<Vec<f64>> = of.iter().map(|l| lag(&time, &input, l.tau, l.start)).collect();
        for i in 0..time.len() {
            let wanted: f64 = each.iter().zip(&of).map(|(y, l)| l.weight * y[i]).sum();
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

    #[test]
    fn a_sine_of_twenty_samples_a_cycle_is_lagged_to_a_ten_thousandth() {
        let w = std::f64::consts::TAU / 20.0;
        let time: Vec<f64> = (0..400).map(f64::from).collect();
        let input: Vec<f64> = time.iter().map(|t| (w * t).sin()).collect();
        for tau in [0.3, 0.99, 1.01, 5.0, 80.0] {
            let found = lag(&time, &input, tau, 0.0);
            let share = 1.0 / (1.0 + (w * tau).powi(2));
            for (t, y) in time.iter().zip(&found).skip(5).take(390) {
                let steady = share * ((w * t).sin() - w * tau * (w * t).cos());
                let exact = steady + share * w * tau * (-t / tau).exp();
                assert!((y - exact).abs() < 1e-4, "{tau} {t}: {y} for {exact}");
            }
        }
    }

    #[test]
    fn both_ways_to_the_weights_agree() {
        let (short, long) = (weights(1.0_f64), weights(1.0_f64 + 1e-12));
        for (a, b) in short.iter().zip(long) {
            assert!((a - b).abs() < 1e-11);
        }
    }
}
