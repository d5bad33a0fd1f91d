//! What settles at the start of recordings, told from slow noise: noise is as large at any time.

use super::distribution::f_tail;
use crate::kernel::filter::dot;

/// Time constants that are looked for, as shares of a recording. What settles more slowly is seen as a drift.
const SHARES: [f64; 2] = [0.03, 0.08];
/// Length over which it is looked at, in time constants.
const LENGTH: f64 = 2.0;
/// Chance of that under stationary noise.
const CHANCE: f64 = 1e-4;

/// True where residuals decay exponentially at the start as nowhere later.
pub(super) fn settles(residuals: &[Vec<f64>]) -> bool {
    SHARES.iter().any(|share| {
        // Noise is of another size in each recording.
        let ratios: Vec<(f64, usize)> =
            residuals.iter().filter_map(|e| start_over_later(e, *share)).collect();
        let Some(fewest) = ratios.iter().map(|(_, later)| *later).min() else { return false };
        let mean = ratios.iter().map(|(ratio, _)| ratio).sum::<f64>() / ratios.len() as f64;
        // Of as many as are later in all recordings together the tail would be shorter.
        f_tail(mean, ratios.len(), fewest) < CHANCE
    })
}

/// Square of the decay at the start over the mean of those later, and how many these are.
fn start_over_later(residual: &[f64], share: f64) -> Option<(f64, usize)> {
    let decay = decay(share * residual.len() as f64);
    let squares: Vec<f64> =
        residual.chunks_exact(decay.len()).map(|part| dot(part, &decay).powi(2)).collect();
    let (start, later) = squares.split_first()?;
    let mean = later.iter().sum::<f64>() / later.len() as f64;
    (mean > 0.0).then(|| (start / mean, later.len()))
}

/// An exponential decay over some samples, less its mean.
fn decay(samples: f64) -> Vec<f64> {
    let decay: Vec<f64> =
        (0..(LENGTH * samples).ceil() as usize).map(|i| (-(i as f64) / samples).exp()).collect();
    let mean = decay.iter().sum::<f64>() / decay.len() as f64;
    decay.iter().map(|value| value - mean).collect()
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    /// Recordings of a noise correlated from sample to sample, that settle from a size in a time constant.
    fn recordings(count: usize, correlation: f64, (size, samples): (f64, f64), seed: u64) -> Vec<Vec<f64>> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut state = normal(&mut random);
        let mut next = |i: usize| {
            state = correlation * state + (1.0 - correlation * correlation).sqrt() * normal(&mut random);
            state + size * (-(i as f64) / samples).exp()
        };
        (0..count).map(|_| (0..4_000).map(&mut next).collect()).collect()
    }

    #[test]
    fn noise_hardly_ever_settles() {
        for correlation in [0.0, 0.97, 0.998] {
            let alarms = |count| {
                (0..400).filter(|seed| settles(&recordings(count, correlation, (0.0, 1.0), *seed))).count()
            };
            assert_eq!([alarms(1), alarms(4)], [0, 0], "at {correlation}");
        }
    }

    #[test]
    fn a_loud_recording_does_not_settle_for_all() {
        for seed in 0..400 {
            let mut recordings = recordings(6, 0.0, (0.0, 1.0), seed);
            recordings[0].iter_mut().for_each(|e| *e *= 10.0);
            assert!(!settles(&recordings), "{seed}");
        }
    }

    #[test]
    fn what_is_three_times_the_noise_settles() {
        for samples in [100.0, 250.0, 400.0] {
            assert!((0..20).all(|seed| settles(&recordings(4, 0.0, (3.0, samples), seed))), "{samples}");
        }
    }
}
