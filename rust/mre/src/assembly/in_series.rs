//! The force of a device in series with something that gives way under that force.

use nalgebra::{Matrix3, Vector3};

use super::columns::Columns;
use crate::effect::Flexibility;
use crate::kernel::relaxation::lag;
use crate::kernel::slope::slope;
use crate::recording::Recording;

/// The tangent of a device is stiffer than the secant, most of all where its motion turns.
const STIFFER: f64 = 1.3;
/// A time constant below this share of a step needs no filter.
const INSTANT: f64 = 0.01;

/// How a difference from a known force is passed on: to put what a device gives in the motion that the known force
/// leaves it in the place of that force diverges where the device is stiffer than what it stands on.
///
/// As a spring and a dashpot near to the device pass it behind what gives way with the retardation time t:
/// `(1 + f k) e + (t + f c) e' = difference + t difference'`. It is one step of Newton's method: where the known force is
/// that of the device, the model and its slopes are those of both together.
pub(super) struct InSeries<'a> {
    time: &'a [f64],
    whole: f64,
    tau: f64,
    /// What of the difference passes at once.
    direct: f64,
}

impl<'a> InSeries<'a> {
    /// Beside a known force in N; `given` is what the device gives in the motion that it
    /// leaves it, nearly.
    pub(super) fn new(
        recording: &'a Recording,
        known: &[f64],
        given: &[f64],
        flexibility: Flexibility,
    ) -> Self {
        let time = recording.time();
        let less = |series: &[f64], by: &[f64]| -> Vec<f64> {
            series.iter().zip(by).map(|(s, b)| s - flexibility.size * b).collect()
        };
        let slow = flexibility.retardation > INSTANT * (time[1] - time[0]);
        let bent = slow.then(|| lag(time, known, flexibility.retardation, known[0]));
        let bent = bent.as_deref().unwrap_or(known);
        let own = less(recording.displacement(), bent);
        let speed = less(recording.velocity(), &slope(time, bent));
        Self::of(time, spring_and_dashpot(&own, &speed, given), flexibility)
    }

    /// A first guess of the force in N, from that of the device alone in the recorded motion: a soft rig leaves it so
    /// little of that motion that nothing else is near enough.
    pub(super) fn first(recording: &'a Recording, alone: &[f64], flexibility: Flexibility) -> Vec<f64> {
        let near = spring_and_dashpot(recording.displacement(), recording.velocity(), alone);
        Self::of(recording.time(), near, flexibility).passed(alone)
    }

    fn of(time: &'a [f64], (stiffness, damping): (f64, f64), flexibility: Flexibility) -> Self {
        let Flexibility { size, retardation } = flexibility;
        let whole = 1.0 + size * STIFFER * stiffness;
        let tau = (retardation + size * damping) / whole;
        Self { time, whole, tau, direct: if retardation > 0.0 { retardation / tau } else { 0.0 } }
    }

    fn passed(&self, difference: &[f64]) -> Vec<f64> {
        let difference: Vec<f64> = difference.iter().map(|d| d / self.whole).collect();
        let slow = self.tau > INSTANT * (self.time[1] - self.time[0]);
        if !slow {
            return difference;
        }
        let late = lag(self.time, &difference, self.tau, difference[0]);
        difference.iter().zip(late).map(|(now, late)| self.direct * (now - late) + late).collect()
    }

    /// A better guess of the force in N than a known one, from what the device gives in the motion that it leaves it.
    pub(super) fn nearer(&self, known: &[f64], given: &[f64]) -> Vec<f64> {
        let off: Vec<f64> = given.iter().zip(known).map(|(g, k)| g - k).collect();
        known.iter().zip(self.passed(&off)).map(|(k, p)| k + p).collect()
    }

    /// The same of a force that columns give.
    pub(super) fn pass(&self, known: &[f64], columns: &mut Columns) {
        for column in &mut columns.columns {
            *column = self.passed(column);
        }
        let given = columns.given.take().unwrap_or_else(|| vec![0.0; known.len()]);
        columns.given = Some(self.nearer(known, &given));
    }
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

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use nalgebra::Complex;

    use super::*;
    use crate::recording::Series;

    #[test]
    fn a_spring_and_a_dashpot_pass_a_force_on_as_the_filter_that_they_are_behind_a_rig() {
        // k + c s behind k_r, which gives way slowly: (k + c s)/(1 + (k + c s)/(k_r (1 + t s))), here on a sine.
        let (k, c, k_r, w) = (20.0_f64, 1.0, 40.0, 30.0);
        let time: Vec<f64> = (0..4000).map(|i| f64::from(i) * 1e-3).collect();
        let displacement: Vec<f64> = time.iter().map(|t| (w * t).sin()).collect();
        let velocity: Vec<f64> = time.iter().map(|t| w * (w * t).cos()).collect();
        let alone: Vec<f64> = displacement.iter().zip(&velocity).map(|(x, v)| k * x + c * v).collect();
        let recording = Recording::new(Series {
            time: time.clone(),
            displacement,
            velocity: Some(velocity),
            force: None,
            simulated: None,
            current: crate::recording::Condition::Missing,
            temperature: crate::recording::Condition::Missing,
            name: String::new(),
        })
        .expect("a recording");
        for retardation in [0.0, 0.004, 0.05] {
            let first = InSeries::first(&recording, &alone, Flexibility { size: 1.0 / k_r, retardation });
            let device = Complex::new(k, c * w);
            let exact = device / (device / k_r / Complex::new(1.0, retardation * w) + 1.0);
            // Near in size and phase: the tangent is taken to be stiffer than it is.
            let apart = |i: usize| first[i] - exact.re * (w * time[i]).sin() - exact.im * (w * time[i]).cos();
            let worst = (2000..4000).map(|i| apart(i).abs()).fold(0.0, f64::max);
            assert!(worst < 0.15 * exact.norm(), "{worst} of {exact} at {retardation} s");
        }
    }
}
