//! What a drive distorts: harmonics of a motion that follow from it, each smaller than the noise of its octave.
//!
//! Smoothing takes them off with the noise, and a stiff device shows them. Of what it takes off, the part that is a
//! polynomial of the displacement and the velocity that it leaves is motion: a few coefficients of many samples.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn, Matrix2, Vector2};

use super::octaves::{Motion, each, less};
use crate::kernel::filter::dot;
use crate::kernel::slope::slope;
use crate::recording::mean;

/// Powers of the displacement and of the velocity: the second and the third harmonic of a sine in either phase.
const POWERS: [(i32, i32); 7] = [(2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];
/// Samples for each of them at least.
const SAMPLES_EACH: usize = 50;
/// Squares of the noise's deviation that a distortion stands out by: seven are those of noise.
const SEEN: f64 = 30.0;
/// What is motion beyond this share is none that noise hides.
const MOTION: f64 = 0.5;
/// Squared mean square over mean fourth power of what is all over a recording: two thirds for a sine.
const EVERYWHERE: f64 = 0.2;
/// Share of its square that a polynomial has to have beside the motion itself.
const LEAST: f64 = 1e-6;
/// Keeps the normal equations solvable, scaled to ones on the diagonal: in a sine some of them are one.
const RIDGE: f64 = 1e-9;

/// How a distortion is told from the noise that smoothing takes off: the same way from everything that is added to it.
#[derive(Debug, Clone)]
pub(super) struct Distortion {
    /// What smoothing takes off each polynomial and its slope, beside the motion itself; of unit length.
    columns: Arc<[Motion]>,
    /// What it takes off the displacement and the velocity, with the slopes.
    itself: Arc<[Motion; 2]>,
    factor: Cholesky<f64, Dyn>,
}

impl Distortion {
    /// Of a smooth motion, where `taken` is what smoothing takes off a series and its slope; `None` of few samples.
    pub(super) fn of(motion: &Motion, time: &[f64], taken: impl Fn(&Motion) -> Motion) -> Option<Self> {
        if time.len() < SAMPLES_EACH * POWERS.len() {
            return None;
        }
        let [x, v] = motion.each_ref().map(|series| scaled(series));
        let rates = [&x, &v].map(|series| slope(time, series));
        let polynomial = |(a, b): (i32, i32)| {
            let value = |i: usize| x[i].powi(a) * v[i].powi(b);
            let by_x = |i: usize| f64::from(a) * x[i].powi((a - 1).max(0)) * v[i].powi(b) * rates[0][i];
            let by_v = |i: usize| f64::from(b) * x[i].powi(a) * v[i].powi((b - 1).max(0)) * rates[1][i];
            let all = 0..x.len();
            [all.clone().map(value).collect(), all.map(|i| by_x(i) + by_v(i)).collect()]
        };
        let lost = |powers| taken(&polynomial(powers));
        // What smoothing takes off the motion itself is no distortion of it.
        let itself = [(1, 0), (0, 1)].map(lost);
        let columns: Vec<Motion> = POWERS.into_iter().filter_map(|p| own_of(&lost(p), &itself)).collect();
        if columns.is_empty() {
            return None;
        }
        let count = columns.len();
        let gram = DMatrix::from_fn(count, count, |i, j| {
            dot(&columns[i][0], &columns[j][0]) + if i == j { RIDGE } else { 0.0 }
        });
        Some(Self { factor: gram.cholesky()?, columns: columns.into(), itself: itself.into() })
    }

    /// True where what smoothing took off is mostly noise of a variance, and has more of a distortion than that would, all
    /// over: where a motion has bends, they are what it lost.
    pub(super) fn stands_out(&self, taken: &[f64], variance: f64) -> bool {
        let part = &self.part_of(taken)[0];
        let (square, fourth) = (dot(part, part), part.iter().map(|e| e.powi(4)).sum::<f64>());
        let everywhere = square.powi(2) > EVERYWHERE * fourth * part.len() as f64;
        let rest = each(taken, &nearest(taken, &self.itself)[0], |all, part| all - part);
        let noisy = dot(&rest, &rest) - square > (1.0 - MOTION) * dot(taken, taken);
        noisy && square > SEEN * variance && everywhere
    }

    /// The part of what smoothing took off a displacement in mm that follows the motion, mm, and its slope, mm/s.
    pub(super) fn part_of(&self, taken: &[f64]) -> Motion {
        let products = self.columns.iter().map(|column| dot(&column[0], taken));
        let sizes = self.factor.solve(&DVector::from_iterator(self.columns.len(), products));
        [0, 1].map(|k| {
            let mut part = vec![0.0; taken.len()];
            for (column, size) in self.columns.iter().zip(&sizes) {
                part.iter_mut().zip(&column[k]).for_each(|(sum, value)| *sum += size * value);
            }
            part
        })
    }
}

/// A series about its mean in units of its largest value.
fn scaled(series: &[f64]) -> Vec<f64> {
    let mean = mean(series);
    let largest = series.iter().fold(0.0_f64, |most, value| most.max((value - mean).abs()));
    series.iter().map(|value| (value - mean) / largest).collect()
}

/// The combination of two others that is nearest to some values, with its slope.
fn nearest(values: &[f64], others: &[Motion; 2]) -> Motion {
    let gram = Matrix2::from_fn(|i, j| dot(&others[i][0], &others[j][0]));
    let right = Vector2::from_fn(|i, _| dot(&others[i][0], values));
    let sizes = gram.try_inverse().map_or_else(Vector2::zeros, |inverse| inverse * right);
    [0, 1].map(|k| each(&others[0][k], &others[1][k], |a, b| sizes[0] * a + sizes[1] * b))
}

/// A column beside two others at a length of one; `None` of a column that is a combination of the others.
fn own_of(column: &Motion, others: &[Motion; 2]) -> Option<Motion> {
    let whole = dot(&column[0], &column[0]);
    let left = less(column, &nearest(&column[0], others));
    let square = dot(&left[0], &left[0]);
    let unit = |part: Vec<f64>| part.into_iter().map(|value| value / square.sqrt()).collect();
    (square > LEAST * whole).then(|| left.map(unit))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use crate::deviate::normal;
    use crate::velocity::from_displacement;

    #[test]
    fn a_harmonic_below_the_noise_is_kept() {
        let mut stream = ChaCha8Rng::seed_from_u64(4);
        let (step, turn) = (0.005, TAU * 7.19);
        let time: Vec<f64> = (0..6000).map(|i| f64::from(i) * step).collect();
        let (size, third) = (1.7, 0.001);
        let motion = |t: &f64| {
            let x = size * (turn * t).sin() + third * (3.0 * turn * t + 0.7).sin();
            let v = turn * (size * (turn * t).cos() + 3.0 * third * (3.0 * turn * t + 0.7).cos());
            [x, v]
        };
        let measured: Vec<f64> = time.iter().map(|t| motion(t)[0] + 0.003 * normal(&mut stream)).collect();
        let calm = from_displacement(&time, &measured).calming(&time, &measured).over(&time, &measured);
        let series = [&calm.displacement, &calm.velocity];
        for (k, (calm, harmonic)) in series.into_iter().zip([third, 3.0 * turn * third]).enumerate() {
            // Of the error, what is at the third harmonic.
            let error: Vec<f64> = time.iter().zip(calm).map(|(t, calm)| calm - motion(t)[k]).collect();
            let part = |of: fn(f64) -> f64| {
                let sum: f64 = time.iter().zip(&error).map(|(t, error)| of(3.0 * turn * t) * error).sum();
                2.0 * sum / time.len() as f64
            };
            let missed = part(f64::sin).hypot(part(f64::cos));
            assert!(missed < 0.25 * harmonic, "{k}: {missed} of {harmonic}");
        }
    }
}
