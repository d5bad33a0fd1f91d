//! The force of a device in series with something that gives way under that force.

use nalgebra::{Matrix3, Vector3};

use crate::effect::slope;
use crate::kernel::relaxation::lag;
use crate::recording::Recording;

/// The tangent of a device is stiffer than the secant, most of all where its motion turns.
const STIFFER: f64 = 1.3;
/// A time constant below this share of a step needs no filter.
const INSTANT: f64 = 0.01;

/// A better guess of the force in N, from a known one and from what the device gives in the motion that the known
/// one leaves it.
///
/// To put one in the place of the other diverges where the device is stiffer than what it stands on. The difference
/// is passed on as a spring and a dashpot near to the device would pass it: `(1 + f k) e + f c e' = difference`.
pub(super) fn nearer(recording: &Recording, known: &[f64], given: &[f64], flexibility: f64) -> Vec<f64> {
    let time = recording.time();
    let less = |series: &[f64], by: &[f64]| -> Vec<f64> {
        series.iter().zip(by).map(|(s, b)| s - flexibility * b).collect()
    };
    let own = less(recording.displacement(), known);
    let speed = less(recording.velocity(), &slope(time, known));
    let (stiffness, damping) = spring_and_dashpot(&own, &speed, given);
    let whole = 1.0 + flexibility * STIFFER * stiffness;
    let difference: Vec<f64> = given.iter().zip(known).map(|(g, k)| (g - k) / whole).collect();
    let tau = flexibility * damping / whole;
    let slow = tau > INSTANT * (time[1] - time[0]);
    let passed = if slow { lag(time, &difference, tau, difference[0]) } else { difference };
    known.iter().zip(passed).map(|(k, p)| k + p).collect()
}

/// Stiffness in N/mm and damping in N s/mm of the linear device nearest to a force under its motion.
fn spring_and_dashpot(displacement: &[f64], velocity: &[f64], force: &[f64]) -> (f64, f64) {
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for ((x, v), f) in displacement.iter().zip(velocity).zip(force) {
        let row = Vector3::new(*x, *v, 1.0);
        matrix += row * row.transpose();
        right += row * *f;
    }
    let found = matrix.cholesky().map_or_else(Vector3::zeros, |factor| factor.solve(&right));
    let positive = |value: f64| if value.is_finite() { value.max(0.0) } else { 0.0 };
    (positive(found[0]), positive(found[1]))
}
