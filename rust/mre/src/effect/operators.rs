//! Operators on series that several laws share: first-order lag, play, Dahl's element, integrals.

use super::Scene;
pub(super) use crate::kernel::relaxation::lag;
pub(super) use crate::kernel::slope::slope;

/// Exponents that differ by less are one.
const SAME: f64 = 1e-6;

/// Play of half width `r`: follows the input once the slack is taken up.
pub(super) fn play(input: &[f64], r: f64) -> Vec<f64> {
    play_from(input[0], input, r)
}

/// The same, at `start` before the first sample.
pub(super) fn play_from(start: f64, input: &[f64], r: f64) -> Vec<f64> {
    let mut p = start;
    input
        .iter()
        .map(|x| {
            p = p.max(x - r).min(x + r);
            p
        })
        .collect()
}

/// Stop of height `r`, an elastic-perfectly-plastic element of stiffness one: input less its play.
pub(super) fn stop(input: &[f64], r: f64) -> Vec<f64> {
    play(input, r).into_iter().zip(input).map(|(p, x)| x - p).collect()
}

/// Dahl's element, `z' = v (1 - z sgn v) / z_y` from rest: a smooth sign of the velocity.
pub(super) fn dahl(scene: &Scene, z_y: f64) -> Vec<f64> {
    along(scene, |z, dx| {
        let side = sign(dx);
        side + (z - side) * (-dx.abs() / z_y).exp()
    })
}

/// The same with an exponent, `z' = v (1 - z sgn v)^gamma / z_y`: above one it comes to its end slowly, below it sharply.
pub(super) fn dahl_of(scene: &Scene, z_y: f64, gamma: f64) -> Vec<f64> {
    let power = 1.0 - gamma;
    // In the power the solution of the law is a line.
    let reached = |left: f64, moved: f64| {
        if power.abs() < SAME {
            left * (-moved).exp()
        } else {
            (left.powf(power) - power * moved).max(0.0).powf(1.0 / power)
        }
    };
    along(scene, |z, dx| {
        let side = sign(dx);
        if side == 0.0 { z } else { side * (1.0 - reached(1.0 - z * side, dx.abs() / z_y)) }
    })
}

/// An elastic element of unit force that slips, `z' = v / z_y` within -1 and 1, from rest: a [`stop`] that sees where the
/// velocity turns within a step.
pub(super) fn slider(scene: &Scene, z_y: f64) -> Vec<f64> {
    along(scene, |z, dx| (z + dx / z_y).clamp(-1.0, 1.0))
}

/// A state that follows the displacement alone, from rest; `moved` is what it becomes by a monotonic one.
fn along(scene: &Scene, moved: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    at_speed(scene, |z, dx, _| moved(z, dx))
}

/// The same of a state that also sees how fast it is moved, as the mean velocity meanwhile.
pub(super) fn at_speed(scene: &Scene, moved: impl Fn(f64, f64, f64) -> f64) -> Vec<f64> {
    let (time, v) = (scene.time, scene.velocity);
    scene.trace(0.0, |z, i| {
        let (h, a, b) = (0.5 * (time[i] - time[i - 1]), v[i - 1], v[i]);
        if a * b < 0.0 {
            // The velocity turns within the step: both ways count.
            let turn = a / (a - b);
            moved(moved(z, h * a * turn, 0.5 * a), h * b * (1.0 - turn), 0.5 * b)
        } else {
            moved(z, h * (a + b), 0.5 * (a + b))
        }
    })
}

/// -1, 0 or 1.
pub(super) fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

/// Integral of a rate from the first sample, by trapezia.
pub(super) fn integral(scene: &Scene, rate: impl Fn(usize) -> f64) -> Vec<f64> {
    scene.trace(0.0, |sum, i| sum + 0.5 * (scene.time[i] - scene.time[i - 1]) * (rate(i - 1) + rate(i)))
}

/// Every value of a series, changed.
pub(super) fn each(series: &[f64], change: impl Fn(f64) -> f64) -> Vec<f64> {
    series.iter().map(|v| change(*v)).collect()
}
