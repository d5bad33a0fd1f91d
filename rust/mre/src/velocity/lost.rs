//! Where smoothing took motion off a displacement with its noise: at turns within fewer samples than a polynomial needs.

use std::ops::Range;

use super::{around, joined};
use crate::recording::mean;
use crate::spread::deviation;

/// By so many standard deviations of what is taken off elsewhere: 6 in 10 million of normal noise.
const NOISE: f64 = 5.0;
/// And by this share of the displacement, rms.
const SHARE: f64 = 1e-4;
/// Of so many samples one at most is lost; more are noise that is larger than elsewhere.
const FEW: usize = 4;

/// Gives a smoothed displacement in mm back what it has lost of the measured one, and says at which samples.
pub(crate) fn give_back(smooth: &mut [f64], measured: &[f64]) -> Vec<Range<usize>> {
    let taken: Vec<f64> = measured.iter().zip(smooth.iter()).map(|(m, s)| m - s).collect();
    let average = mean(measured);
    let size = measured.iter().map(|x| (x - average).powi(2)).sum::<f64>() / measured.len() as f64;
    let least = (NOISE * deviation(&taken)).max(SHARE * size.sqrt());
    let lost: Vec<usize> = (0..taken.len()).filter(|i| taken[*i].abs() > least).collect();
    if FEW * lost.len() > taken.len() {
        return Vec::new();
    }
    for i in &lost {
        smooth[*i] = measured[*i];
    }
    joined(lost.into_iter().map(|i| around(i, taken.len())).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(samples: usize) -> (Vec<f64>, Vec<f64>) {
        // Noise that repeats after 101 samples.
        let noise = |i: usize| 1e-3 * (f64::from((i * 37 % 101) as u32) / 50.0 - 1.0);
        let smooth: Vec<f64> = (0..samples).map(|i| 3.0 * (0.05 * i as f64).sin()).collect();
        let measured = smooth.iter().enumerate().map(|(i, x)| x + noise(i)).collect();
        (smooth, measured)
    }

    #[test]
    fn what_is_far_beyond_the_noise_is_given_back() {
        let (smooth, mut measured) = motion(500);
        let mut kept = smooth.clone();
        assert_eq!(give_back(&mut kept, &measured), []);
        assert_eq!(kept, smooth);
        for (i, off) in [(200, 0.02), (201, -0.03), (300, 0.01)] {
            measured[i] += off;
        }
        assert_eq!(give_back(&mut kept, &measured), [199..203, 299..302]);
        let given_back: Vec<usize> = (0..500).filter(|i| kept[*i] != smooth[*i]).collect();
        assert_eq!(given_back, [200, 201, 300]);
        assert!(given_back.iter().all(|i| kept[*i] == measured[*i]));
    }

    #[test]
    fn noise_that_is_larger_in_a_part_is_none() {
        let (smooth, mut measured) = motion(500);
        for (x, smooth) in measured.iter_mut().zip(&smooth).take(200) {
            *x = smooth + 30.0 * (*x - smooth);
        }
        let mut kept = smooth.clone();
        assert_eq!(give_back(&mut kept, &measured), []);
        assert_eq!(kept, smooth);
    }
}
