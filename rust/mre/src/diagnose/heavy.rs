//! Noise of heavy tails: tests expect a normal one, and a feature of few samples would take a single wild sample for a
//! mismatch. Where the samples of all recordings together show such tails, tests hear the smaller of what they tell as they
//! are and winsorised (Huber 1964, <https://doi.org/10.1214/aos/1177703732>). Fits keep them as they are: least squares
//! compares laws that are sharp.

use nalgebra::DVector;

use super::point::Local;
use super::tangents::products;
use crate::kernel::filter::dot;

/// Standard deviations beyond which a sample is rare in a normal noise.
const RARE: f64 = 4.0;
/// Share of its samples that are beyond.
const OF_NORMAL: f64 = 6.3e-5;
/// Tails are heavy where so many times as many are,
const TIMES: f64 = 10.0;
/// and so many more: a few are the moments of a device.
const FEW: f64 = 8.0;
/// Standard deviations of the others that a sample of heavy noise counts at most.
const MOST: f64 = 3.0;
/// So often that deviation is taken anew, without what was beyond the last.
const ROUNDS: usize = 20;

/// Whitened residuals of heavy tails, winsorised.
pub(super) struct Tame {
    /// By recording.
    pub(super) residuals: Vec<Vec<f64>>,
    /// Their products with the tangents of the model.
    pub(super) right: DVector<f64>,
}

impl Tame {
    /// Of recordings at a point, beside so many tangents; `None` where the tails are not heavy.
    pub(super) fn of(
        recordings: &[Local],
        tangents: &[Vec<(usize, Vec<f64>)>],
        count: usize,
    ) -> Option<Self> {
        let residuals = tame(recordings.iter().map(|local| local.residual.as_slice()))?;
        let right = products(tangents, residuals.iter().map(Vec::as_slice), count);
        Some(Self { residuals, right })
    }
}

/// Residuals of which no sample counts for much, of the size that they had, by recording; `None` where the tails are not
/// heavy.
fn tame<'r>(residuals: impl Iterator<Item = &'r [f64]> + Clone) -> Option<Vec<Vec<f64>>> {
    let samples: usize = residuals.clone().map(<[f64]>::len).sum();
    let squares: f64 = residuals.clone().flatten().map(|e| e * e).sum();
    let deviation = (squares / samples.max(1) as f64).sqrt();
    let rare = residuals.clone().flatten().filter(|e| e.abs() > RARE * deviation).count() as f64;
    if rare <= FEW + TIMES * OF_NORMAL * samples as f64 {
        return None;
    }
    // Of the samples that are not wild: these make the deviation of all, and would count by it.
    let most = (0..ROUNDS).fold(MOST * deviation, |most, _| {
        let kept: f64 = residuals.clone().flatten().map(|e| e.clamp(-most, most).powi(2)).sum();
        MOST * (kept / samples as f64).sqrt()
    });
    // Tests know the size of each noise by what it is with its wild samples.
    let of_its_size = |own: &[f64]| {
        let kept: Vec<f64> = own.iter().map(|e| e.clamp(-most, most)).collect();
        let size = (dot(own, own) / dot(&kept, &kept).max(f64::MIN_POSITIVE)).sqrt();
        kept.into_iter().map(|e| size * e).collect()
    };
    Some(residuals.map(of_its_size).collect())
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_core::SeedableRng;

    use super::*;
    use crate::deviate::normal;

    fn noise(seed: u64) -> Vec<f64> {
        let mut stream = ChaCha8Rng::seed_from_u64(seed);
        (0..10_000).map(|_| normal(&mut stream)).collect()
    }

    #[test]
    fn normal_noise_is_left_and_so_are_a_few_moments_of_a_device() {
        let mut own = noise(1);
        for at in [100, 2_000, 7_000] {
            own[at] = 20.0;
        }
        assert_eq!(tame([own.as_slice(), &noise(2)].into_iter()), None);
        assert_eq!(tame(std::iter::empty()), None);
    }

    #[test]
    fn wild_samples_count_for_little() {
        // A normal variable over the root of the mean of three squares: Student's.
        let parts: Vec<Vec<f64>> = (1..=4).map(noise).collect();
        let student = |i: usize| {
            let squares: f64 = parts[1..].iter().map(|part| part[i] * part[i]).sum();
            parts[0][i] / (squares / 3.0).sqrt()
        };
        let own: Vec<f64> = (0..10_000).map(student).collect();
        let tamed = tame(std::iter::once(own.as_slice())).unwrap_or_default();
        let square = |series: &[f64]| series.iter().map(|e| e * e).sum::<f64>();
        assert!((square(&tamed[0]) / square(&own) - 1.0).abs() < 1e-9);
        let most = tamed[0].iter().copied().fold(0.0, f64::max);
        let wild: Vec<f64> =
            own.iter().zip(&tamed[0]).filter(|(_, e)| **e == most).map(|(own, _)| *own).collect();
        let share = wild.len() as f64 / 5_000.0;
        assert!((0.005..0.05).contains(&share), "{share}");
        let deviation = (square(&own) / 10_000.0).sqrt();
        assert!(most < 4.0 * deviation, "{most}");
    }

    #[test]
    fn spikes_count_as_the_others_however_large_they_are() {
        for size in [50.0, 1000.0] {
            let mut own = noise(7);
            (0..20).for_each(|k| own[450 * k + 3] = size);
            let tamed = tame(std::iter::once(own.as_slice())).unwrap_or_default();
            let others = tamed[0].iter().map(|e| e * e).sum::<f64>() / 10_000.0;
            let most = tamed[0].iter().copied().fold(0.0, f64::max);
            assert!(most < 3.1 * others.sqrt(), "{most} of {}", others.sqrt());
        }
    }
}
