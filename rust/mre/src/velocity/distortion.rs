//! What a drive distorts: harmonics of a motion that follow from it, each smaller than the noise of its octave.
//!
//! Smoothing takes them off with the noise, and a stiff device shows them. Of what it takes off, the part that is a
//! polynomial of the displacement and the velocity that it leaves is motion: a few coefficients of many samples.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::octaves::Motion;
use crate::kernel::filter::dot;

/// Powers of the displacement and of the velocity: a sine itself, whose loss is none of a distortion, and its second and
/// third harmonic in either phase.
const POWERS: [(i32, i32); 9] = [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2), (3, 0), (2, 1), (1, 2), (0, 3)];
/// Columns of the motion itself.
const ITSELF: usize = 2;
/// Samples for each of them at least.
const SAMPLES_EACH: usize = 50;
/// Squares of the noise's deviation that a distortion stands out by: about seven are those of noise.
const SEEN: f64 = 30.0;
/// What is motion beyond this share is none that noise hides.
const MOTION: f64 = 0.5;
/// Squared mean square over mean fourth power of what is all over a recording: two thirds for a sine.
const EVERYWHERE: f64 = 0.2;
/// Keeps the normal equations solvable, scaled to ones on the diagonal: in a sine some of them are one.
const RIDGE: f64 = 1e-9;

/// How a distortion is told from the noise that smoothing takes off: the same way from everything that is added to it.
#[derive(Debug, Clone)]
pub(super) struct Distortion {
    /// What smoothing takes off each polynomial and its slope, scaled to unit length of the first.
    columns: Vec<Motion>,
    factor: Cholesky<f64, Dyn>,
}

impl Distortion {
    /// Of a smooth motion on an even grid, where `taken` is what smoothing takes off a series and its slope; `None` of few
    /// samples.
    pub(super) fn of(motion: &Motion, step: f64, taken: impl Fn(&Motion) -> Motion) -> Option<Self> {
        if motion[0].len() < SAMPLES_EACH * POWERS.len() {
            return None;
        }
        let [x, v] = motion.each_ref().map(|series| scaled(series));
        let rates = [&x, &v].map(|series| slope(series, step));
        let polynomial = |(a, b): (i32, i32)| {
            let value = |i: usize| x[i].powi(a) * v[i].powi(b);
            let by_x = |i: usize| f64::from(a) * x[i].powi((a - 1).max(0)) * v[i].powi(b) * rates[0][i];
            let by_v = |i: usize| f64::from(b) * x[i].powi(a) * v[i].powi((b - 1).max(0)) * rates[1][i];
            let all = 0..x.len();
            [all.clone().map(value).collect(), all.map(|i| by_x(i) + by_v(i)).collect()]
        };
        let unit = |[value, slope]: Motion| {
            let size = dot(&value, &value).sqrt();
            [value, slope].map(|part| part.into_iter().map(|e| e / size).collect::<Vec<f64>>())
        };
        let columns: Vec<Motion> =
            POWERS.into_iter().map(|powers| unit(taken(&polynomial(powers)))).collect();
        if !columns.iter().flatten().flatten().all(|value| value.is_finite()) {
            return None;
        }
        let count = columns.len();
        let gram = DMatrix::from_fn(count, count, |i, j| {
            dot(&columns[i][0], &columns[j][0]) + if i == j { RIDGE } else { 0.0 }
        });
        Some(Self { factor: gram.cholesky()?, columns })
    }

    /// True where what smoothing took off is mostly noise of a variance, and has more of a distortion than that would, all
    /// over: where a motion has bends, they are what it lost.
    pub(super) fn stands_out(&self, taken: &[f64], variance: f64) -> bool {
        let products = self.products(taken);
        let explained = products.dot(&self.factor.solve(&products));
        let part = &self.part_of(taken)[0];
        let (square, fourth) = (dot(part, part), part.iter().map(|e| e.powi(4)).sum::<f64>());
        let everywhere = square.powi(2) > EVERYWHERE * fourth * part.len() as f64;
        explained < MOTION * dot(taken, taken) && square > SEEN * variance && everywhere
    }

    /// The part of what smoothing took off a displacement in mm that follows the motion, mm, and its slope, mm/s.
    pub(super) fn part_of(&self, taken: &[f64]) -> Motion {
        let sizes = self.factor.solve(&self.products(taken));
        [0, 1].map(|k| {
            let mut part = vec![0.0; taken.len()];
            for (column, size) in self.columns.iter().zip(&sizes).skip(ITSELF) {
                part.iter_mut().zip(&column[k]).for_each(|(sum, value)| *sum += size * value);
            }
            part
        })
    }

    fn products(&self, taken: &[f64]) -> DVector<f64> {
        DVector::from_iterator(self.columns.len(), self.columns.iter().map(|column| dot(&column[0], taken)))
    }
}

/// A series about its mean in units of its largest value.
fn scaled(series: &[f64]) -> Vec<f64> {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    let largest = series.iter().fold(0.0_f64, |most, value| most.max((value - mean).abs()));
    series.iter().map(|value| (value - mean) / largest).collect()
}

/// Slopes of a smooth series on an even grid, of the fourth order but for the samples at its ends.
fn slope(series: &[f64], step: f64) -> Vec<f64> {
    let last = series.len() - 1;
    let difference = |i: usize, reach: usize| {
        let (before, after) = (i.saturating_sub(reach), (i + reach).min(last));
        (series[after] - series[before]) / ((after - before) as f64 * step)
    };
    let at = |i: usize| {
        let near = difference(i, 1);
        if i < 2 || i + 2 > last { near } else { near + (near - difference(i, 2)) / 3.0 }
    };
    (0..=last).map(at).collect()
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
