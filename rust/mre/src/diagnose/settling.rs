//! What settles at the start of recordings, told from slow noise: noise is as large at any time.

use crate::kernel::filter::dot;

/// Time constants that are looked for, as shares of a recording. What settles more slowly is seen as a drift.
const SHARES: [f64; 2] = [0.03, 0.08];
/// Length over which it is looked at, in time constants.
const LENGTH: f64 = 2.0;
/// Squares at the start are so many times as large as later.
const LARGER: f64 = 20.0;

/// True where residuals decay exponentially at the start as nowhere later.
pub(super) fn settles(residuals: &[Vec<f64>]) -> bool {
    SHARES.iter().any(|share| {
        let (mut start, mut later, mut count) = (0.0, 0.0, 0);
        for residual in residuals {
            let decay = decay(share * residual.len() as f64);
            let mut squares = residual.chunks_exact(decay.len()).map(|part| dot(part, &decay).powi(2));
            start += squares.next().unwrap_or(0.0);
            later += squares.clone().sum::<f64>();
            count += squares.count();
        }
        start * count as f64 > LARGER * later * residuals.len() as f64
    })
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
            assert!(alarms(4) == 0 && alarms(1) <= 8, "{} of one recording at {correlation}", alarms(1));
        }
    }

    #[test]
    fn what_is_half_as_large_again_as_the_noise_settles() {
        for samples in [100.0, 250.0, 400.0] {
            assert!((0..20).all(|seed| settles(&recordings(4, 0.0, (1.5, samples), seed))), "{samples}");
        }
    }
}
