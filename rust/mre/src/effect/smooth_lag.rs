//! First-order lag of a series that is smooth between its samples: a lag shorter than a step depends on its slope
//! at the samples, which straight lines between them have not.
//!
//! Between samples stands the monotone cubic of Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238, with the
//! slopes of Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: no overshoot beside a jump.

use nalgebra::{Complex, ComplexField};

use crate::kernel::jumps::jumps_after;
use crate::kernel::relaxation::{runs, weights};

/// `y' = (u - y) / tau` from `start`.
pub(super) fn smooth_lag(time: &[f64], input: &[f64], tau: f64, start: f64) -> Vec<f64> {
    relaxed(time, input, 1.0 / tau, start)
}

/// The same from the first value, where the input jumps after a share of the step in which it does.
pub(super) fn jumping_lag(time: &[f64], input: &[f64], tau: f64, share: f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(input.len());
    let mut from = 0;
    let mut y = input[0];
    for jump in jumps_after(input).into_iter().chain([input.len() - 1]) {
        let part = from..jump + 1;
        out.extend(smooth_lag(&time[part.clone()], &input[part], tau, y));
        let Some(next) = time.get(jump + 1) else { break };
        let step = next - time[jump];
        let held = input[jump] + (out[jump] - input[jump]) * (-share * step / tau).exp();
        y = input[jump + 1] + (held - input[jump + 1]) * (-(1.0 - share) * step / tau).exp();
        from = jump + 1;
    }
    out
}

/// `y'' + 2 zeta w y' + w^2 y = w^2 u` from rest at `start`, `zeta` below one: two lags of conjugate complex rates.
pub(super) fn smooth_ringing(time: &[f64], input: &[f64], w: f64, zeta: f64, start: f64) -> Vec<f64> {
    let rate = Complex::new(zeta, (1.0 - zeta * zeta).sqrt()) * w;
    let share = rate.conj() / (rate.conj() - rate);
    let lagged = relaxed(time, input, rate, Complex::from(start));
    lagged.into_iter().map(|y| 2.0 * (share * y).re).collect()
}

/// `y' = rate (u - y)` from `start`.
fn relaxed<N: ComplexField<RealField = f64> + Copy>(
    time: &[f64],
    input: &[f64],
    rate: N,
    start: N,
) -> Vec<N> {
    let slopes = slopes(time, input);
    let mut y = start;
    let mut out = Vec::with_capacity(input.len());
    out.push(y);
    for (from, to) in runs(time) {
        let h = time[from] - time[from - 1];
        let q = rate.scale(h);
        let (decay, weights) = ((-q).exp(), weights(q));
        for i in from..to {
            let (a, b) = (input[i - 1], input[i]);
            let (m, n) = (h * slopes[i - 1], h * slopes[i]);
            let cubic = [a, m, 3.0 * (b - a) - 2.0 * m - n, m + n - 2.0 * (b - a)];
            y = cubic.iter().zip(weights).fold(decay * y, |sum, (c, w)| sum + w.scale(*c));
            out.push(y);
        }
    }
    out
}

/// Slopes at the samples: harmonic means of those on both sides, zero where these differ in sign.
fn slopes(time: &[f64], input: &[f64]) -> Vec<f64> {
    let n = input.len();
    let of = |i: usize| (input[i + 1] - input[i]) / (time[i + 1] - time[i]);
    let at = |i: usize| {
        if i == 0 || i + 1 == n {
            return if n > 1 { of(i.min(n - 2)) } else { 0.0 };
        }
        let (before, after) = (of(i - 1), of(i));
        if before * after <= 0.0 {
            return 0.0;
        }
        let (h, k) = (time[i] - time[i - 1], time[i + 1] - time[i]);
        let (a, b) = (2.0 * k + h, k + 2.0 * h);
        (a + b) / (a / before + b / after)
    };
    (0..n).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lag_shorter_than_a_step_is_that_of_a_smooth_series() {
        let time: Vec<f64> = (0..400).map(|i| 0.005 * f64::from(i)).collect();
        let w = 30.0;
        let input: Vec<f64> = time.iter().map(|t| (w * t).sin()).collect();
        for tau in [2e-4_f64, 1.4e-3, 0.02, 0.8] {
            let lagged = smooth_lag(&time, &input, tau, 0.0);
            let size = 1.0 / (1.0 + (w * tau).powi(2));
            for (t, y) in time.iter().zip(&lagged) {
                let steady = (w * t).sin() - w * tau * (w * t).cos() + w * tau * (-t / tau).exp();
                assert!((y - size * steady).abs() < 2e-3, "tau {tau}, t {t}: {y} {}", size * steady);
            }
        }
    }

    #[test]
    fn a_ringing_lag_rises_as_its_closed_form() {
        let time: Vec<f64> = (0..400).map(|i| 0.005 * f64::from(i)).collect();
        for (w, zeta) in [(800.0, 0.5), (30.0, 0.9), (5.0, 0.3)] {
            let lagged = smooth_ringing(&time, &vec![1.0; time.len()], w, zeta, 0.0);
            let ring: f64 = (1.0_f64 - zeta * zeta).sqrt();
            for (t, y) in time.iter().zip(&lagged) {
                let phase = w * ring * t;
                let closed = 1.0 - (-zeta * w * t).exp() * (phase.cos() + zeta / ring * phase.sin());
                assert!((y - closed).abs() < 1e-12, "w {w}, t {t}: {y} {closed}");
            }
        }
    }

    #[test]
    fn a_jump_is_met_where_it_is() {
        let time: Vec<f64> = (0..60).map(|i| 0.01 * f64::from(i)).collect();
        let (tau, share) = (0.02, 0.3);
        let input: Vec<f64> = (0..60).map(|i| f64::from(u8::from((20..40).contains(&i)))).collect();
        let since = |t: f64, jump: f64| if t > jump { 1.0 - (-(t - jump) / tau).exp() } else { 0.0 };
        let closed = |t: f64| since(t, 0.193) - since(t, 0.393);
        for (t, y) in time.iter().zip(jumping_lag(&time, &input, tau, share)) {
            assert!((y - closed(*t)).abs() < 1e-12, "t {t}: {y} {}", closed(*t));
        }
    }

    #[test]
    fn a_jump_leaves_what_lies_before_it_alone() {
        let time: Vec<f64> = (0..20).map(|i| 0.01 * f64::from(i)).collect();
        let input: Vec<f64> = (0..20).map(|i| if i < 10 { 1.0 } else { 3.0 }).collect();
        let lagged = smooth_lag(&time, &input, 0.004, 1.0);
        assert!(lagged[..10].iter().all(|y| (y - 1.0).abs() < 1e-15));
        assert!(lagged[10..].windows(2).all(|pair| pair[1] >= pair[0] && pair[1] <= 3.0));
    }
}
