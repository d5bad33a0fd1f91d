//! What is left goes on for a while where the force is large, and not where it is small: a stiffness or a gain that comes
//! and goes with time leaves its changes times the force.
//!
//! An autoregression takes such a force for a narrow band of noise and whitens it away, so that this test sees what is left
//! as it is: means over a small part of a cycle, each times the next. White noise of any size has no such products, and
//! those of any steady noise do not know the motion. How far they scatter follows from the autocovariance of the means. A noise
//! with memory that is larger where the force is cannot be told from what is missing.

use super::above::frequency;
use super::candidates::residuals;
use super::distribution::chi_square_tail;
use super::gaps::LeftOut;
use super::missing::{MORE_CAUTION, Mismatch};
use super::null::Null;
use super::projection::View;
use super::resolution::step_of;
use super::shaken;
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
        let views: Vec<View> = self.shaken_views().collect();
        let (mut sum, mut variance) = (0.0, 0.0);
        for (r, (left, local)) in left.iter().zip(&self.point.recordings).enumerate() {
            let campaign = self.assembly().campaign();
            let recording = &campaign.recordings()[r];
            let scored = recording.scored();
            // A derived velocity is wrong near corners, and steps of the force as large as what is left come with the motion.
            let step = step_of(&recording.force().unwrap_or_default()[scored.clone()]);
            if campaign.doubts()[r].cornered || step.powi(2) * left.len() as f64 > dot(left, left) {
                continue;
            }
            let force = &local.force[scored.clone()];
            let mean = force.iter().sum::<f64>() / force.len() as f64;
            let strength: Vec<f64> = force.iter().map(|f| (f - mean).powi(2)).collect();
            let cycle = recording.sampling_rate() / frequency(recording);
            let together = ((cycle / IN_A_CYCLE).round() as usize).max(1);
            let telling = LeftOut::of(campaign, r).telling(scored.clone(), 0);
            let counts: Vec<bool> =
                telling.chunks_exact(together).map(|some| some.iter().all(|c| *c)).collect();
            // The force does not follow the noise of its motion, which is correlated where it was smoothed.
            let noise = |there: &View| {
                let change = there.force[r][scored.clone()].iter().zip(force).map(|(a, b)| a - b);
                means(&change.collect::<Vec<f64>>(), together)
            };
            let noise: Vec<Vec<f64>> = views.iter().map(noise).collect();
            if let Some((own, scatter)) =
                in_step(&means(left, together), &means(&strength, together), &counts, &noise)
            {
                (sum, variance) = (sum + own, variance + scatter);
            }
        }
        let gain = sum * sum / variance / MORE_CAUTION;
        if sum <= 0.0 || !gain.is_finite() {
            return Mismatch::NONE;
        }
        // Of one sign only.
        Mismatch { p_value: 0.5 * chi_square_tail(gain, 1), gain, freedom: 1 }
    }
}

/// Means over so many values, one after the other.
fn means(values: &[f64], together: usize) -> Vec<f64> {
    values.chunks_exact(together).map(|some| some.iter().sum::<f64>() / together as f64).collect()
}

/// Values about the mean of those that count; zero where they do not.
fn about(values: &[f64], counts: &[bool]) -> Vec<f64> {
    let counted = counts.iter().filter(|counts| **counts).count().max(1) as f64;
    let mean =
        values.iter().zip(counts).filter(|(_, counts)| **counts).map(|(v, _)| v).sum::<f64>() / counted;
    values.iter().zip(counts).map(|(v, counts)| if *counts { v - mean } else { 0.0 }).collect()
}

/// Sum of the products of neighbours where a strength is above its mean, less those where it is below and what noise of
/// the motion gives of them; and the variance that it has by chance; in variances of the means. `None` where there are
/// too few.
fn in_step(left: &[f64], strength: &[f64], counts: &[bool], noise: &[Vec<f64>]) -> Option<(f64, f64)> {
    let pairs: Vec<bool> = counts.windows(2).map(|pair| pair[0] && pair[1]).collect();
    let counted = pairs.iter().filter(|counts| **counts).count();
    if counted < FEWEST {
        return None;
    }
    let products = |values: &[f64]| {
        let own = about(values, counts);
        let products: Vec<f64> = own.windows(2).map(|pair| pair[0] * pair[1]).collect();
        about(&products, &pairs)
    };
    let strength: Vec<f64> = strength.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let mean = strength.iter().sum::<f64>() / strength.len() as f64;
    let weights: Vec<f64> = about(&strength, &pairs).iter().map(|w| w / mean).collect();
    let own = products(left);
    let left = about(left, counts);
    let (n, lags) = (own.len(), own.len().min(LONGEST));
    let covariance = |k: usize| {
        let later = k.min(left.len());
        dot(&left[..left.len() - later], &left[later..]) / counted as f64
    };
    let covariances: Vec<f64> = (0..lags + 2).map(covariance).collect();
    let power = covariances[0];
    if !(power > 0.0 && mean > 0.0) {
        return None;
    }
    let scatter = |k: usize| {
        // Of normal values.
        let of_products = covariances[k].powi(2) + covariances[k + 1] * covariances[k.abs_diff(1)];
        let of_weights = dot(&weights[..n - k], &weights[k..]);
        if k == 0 { of_products * of_weights } else { 2.0 * of_products * of_weights }
    };
    // And of independent ones of any size.
    let of_any_size: f64 = own.iter().zip(&weights).map(|(p, w)| (p * w).powi(2)).sum();
    let variance = (0..lags).map(scatter).sum::<f64>().max(of_any_size);
    let of_noise = noise.iter().map(|noise| dot(&products(noise), &weights)).sum::<f64>();
    let of_noise = shaken::MOST * of_noise.max(0.0) / noise.len().max(1) as f64;
    Some(((dot(&own, &weights) - of_noise) / power, variance / (power * power)))
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
        let (sum, variance) = in_step(&left, &strength, &vec![true; left.len()], &[]).unwrap_or_default();
        sum / variance.sqrt()
    }

    #[test]
    fn steady_noise_of_any_memory_is_not_in_step() {
        for memory in [0.0, 0.6, 0.97, 0.995] {
            let scores: Vec<f64> = (0..200).map(|seed| score(seed, memory, |_| 1.0)).collect();
            let deviation = (dot(&scores, &scores) / 200.0).sqrt();
            assert!((0.5..1.2).contains(&deviation), "{memory} {deviation}");
            assert!(scores.iter().all(|z| *z < 4.0), "{memory}");
        }
    }

    #[test]
    fn white_noise_of_another_size_is_not_and_a_slow_strength_is() {
        let white: Vec<f64> = (0..200).map(|seed| score(seed, 0.0, f64::abs)).collect();
        let deviation = (dot(&white, &white) / 200.0).sqrt();
        assert!(deviation < 1.2 && white.iter().all(|z| *z < 4.0), "{deviation}");
        assert!((0..50).all(|seed| score(seed, 0.95, |force| force) > 3.0));
    }
}
