//! What is left goes on for a while where the force is large, and not where it is small: a stiffness or a gain that comes
//! and goes with time leaves its changes times the force.
//!
//! An autoregression takes such a force for a narrow band of noise and whitens it away, so that this test sees what is left
//! as it is: means over a small part of a cycle, each times the next. White noise of any size has no such products, and
//! those of any steady noise do not know the motion. How far they scatter follows from the autocovariance of the means.

use super::candidates::residuals;
use super::distribution::chi_square_tail;
use super::missing::{MORE_CAUTION, Mismatch};
use super::null::Null;
use crate::kernel::filter::dot;

/// Means in a cycle of the motion.
const IN_A_CYCLE: f64 = 32.0;
/// Fewest means of a recording.
const FEWEST: usize = 32;
/// Longest lag of their autocovariance.
const LONGEST: usize = 4096;

impl Null<'_> {
    /// Test whether what is left goes on where the force is large.
    ///
    /// A noise that a mismatch hides is not known, and of clipped samples nothing is left: there is no test.
    pub(super) fn in_step(&self) -> Mismatch {
        if !self.knows_its_noise() || self.broken_off() {
            return Mismatch::NONE;
        }
        let left = residuals(self.assembly(), self.data(), &self.point.fitted);
        let (mut sum, mut variance) = (0.0, 0.0);
        for (r, (left, local)) in left.iter().zip(&self.point.recordings).enumerate() {
            let recording = &self.assembly().campaign().recordings()[r];
            let force = &local.force[recording.scored()];
            let mean = force.iter().sum::<f64>() / force.len() as f64;
            let strength: Vec<f64> = force.iter().map(|f| (f - mean).powi(2)).collect();
            let cycle = cycle(recording.displacement(), recording.velocity()) * recording.sampling_rate();
            let together = ((cycle / IN_A_CYCLE).round() as usize).max(1);
            if let Some((own, scatter)) = in_step(&means(left, together), &means(&strength, together)) {
                (sum, variance) = (sum + own, variance + scatter);
            }
        }
        if sum <= 0.0 || variance <= 0.0 {
            return Mismatch::NONE;
        }
        let gain = sum * sum / variance / MORE_CAUTION;
        // Of one sign only.
        Mismatch { p_value: 0.5 * chi_square_tail(gain, 1), gain, freedom: 1 }
    }
}

/// Cycle of a motion in s: that of the sine with its root mean squares.
fn cycle(x: &[f64], v: &[f64]) -> f64 {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let squares = dot(x, x) - mean * mean * x.len() as f64;
    let of_velocity = dot(v, v).max(f64::MIN_POSITIVE);
    std::f64::consts::TAU * (squares.max(0.0) / of_velocity).sqrt()
}

/// Means over so many values, one after the other.
fn means(values: &[f64], together: usize) -> Vec<f64> {
    values.chunks_exact(together).map(|some| some.iter().sum::<f64>() / together as f64).collect()
}

/// Sum of the products of neighbours where a strength is above its mean, less those where it is below, and the variance
/// that it has by chance; in variances of the means. `None` where there are too few.
fn in_step(left: &[f64], strength: &[f64]) -> Option<(f64, f64)> {
    if left.len() < FEWEST {
        return None;
    }
    let about = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        values.iter().map(|v| v - mean).collect::<Vec<f64>>()
    };
    let left = about(left);
    let products: Vec<f64> = left.windows(2).map(|pair| pair[0] * pair[1]).collect();
    let strength: Vec<f64> = strength.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let mean = strength.iter().sum::<f64>() / strength.len() as f64;
    if mean <= 0.0 {
        return None;
    }
    let weights: Vec<f64> = about(&strength).iter().map(|w| w / mean).collect();
    let n = products.len();
    let lags = n.min(LONGEST);
    let covariance: Vec<f64> = (0..lags + 2)
        .map(|k| dot(&left[..left.len() - k.min(left.len())], &left[k.min(left.len())..]) / left.len() as f64)
        .collect();
    let power = covariance[0];
    if power <= 0.0 {
        return None;
    }
    let scatter = |k: usize| {
        // Of normal values.
        let of_products = covariance[k].powi(2) + covariance[k + 1] * covariance[k.abs_diff(1)];
        let of_weights = dot(&weights[..n - k], &weights[k..]);
        if k == 0 { of_products * of_weights } else { 2.0 * of_products * of_weights }
    };
    let variance: f64 = (0..lags).map(scatter).sum();
    Some((dot(&about(&products), &weights) / power, variance / (power * power)))
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    /// Sum over its deviation, of a noise that is multiplied by what `size` gives of the force.
    fn score(seed: u64, memory: f64, size: fn(f64) -> f64) -> f64 {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        let mut state = 0.0;
        let noise = (0..1600).map(|_| {
            state = memory * state + (1.0 - memory * memory).sqrt() * normal(&mut stream);
            state
        });
        let force: Vec<f64> =
            (0..1600).map(|i| (std::f64::consts::TAU * f64::from(i) / 32.0).sin()).collect();
        let left: Vec<f64> = noise.zip(&force).map(|(noise, force)| noise * size(*force)).collect();
        let strength: Vec<f64> = force.iter().map(|f| f * f).collect();
        let (sum, variance) = in_step(&left, &strength).unwrap_or_default();
        sum / variance.sqrt()
    }

    #[test]
    fn steady_noise_of_any_memory_is_not_in_step() {
        for memory in [0.0, 0.6, 0.97, 0.995] {
            let scores: Vec<f64> = (0..200).map(|seed| score(seed, memory, |_| 1.0)).collect();
            let deviation = (dot(&scores, &scores) / 200.0).sqrt();
            assert!((0.6..1.2).contains(&deviation), "{memory} {deviation}");
            assert!(scores.iter().all(|z| *z < 4.0), "{memory}");
        }
    }

    #[test]
    fn white_noise_of_another_size_is_not_and_a_slow_strength_is() {
        let white: Vec<f64> = (0..200).map(|seed| score(seed, 0.0, f64::abs)).collect();
        let deviation = (dot(&white, &white) / 200.0).sqrt();
        assert!(deviation < 1.6 && white.iter().all(|z| z.abs() < 5.5), "{deviation}");
        assert!((0..50).all(|seed| score(seed, 0.95, |force| force) > 3.0));
    }
}
