//! Random numbers, one stream a fish, and the random behaviour.

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

/// The stream of one fish: `ChaCha` with eight rounds, the fish as its stream number.
#[derive(Debug, Clone)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// Stream `fish` of a seed.
    pub fn new(seed: u64, fish: usize) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(fish as u64);
        Self(rng)
    }

    /// Uniform in [0, 1), 53 bits.
    pub fn uniform(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
    }

    /// Uniform in [-1, 1).
    pub(super) fn symmetric(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }
}

/// A point around `from`, each coordinate within `range`, moved into the unit box.
///
/// With the step as range this is the random behaviour; with the visual range it is a look of the
/// searching behaviour.
pub(super) fn around(from: &[f64], range: f64, stream: &mut Stream, out: &mut Vec<f64>) {
    out.extend(from.iter().map(|x| (x + range * stream.symmetric()).clamp(0.0, 1.0)));
}

/// A point a random share of a step towards `target`, moved into the unit box.
pub(super) fn towards(from: &[f64], target: &[f64], step: f64, stream: &mut Stream, out: &mut Vec<f64>) {
    let distance = super::view::distance(from, target);
    let share = if distance > 0.0 { stream.uniform() * step / distance } else { 0.0 };
    out.extend(from.iter().zip(target).map(|(x, t)| (x + share * (t - x)).clamp(0.0, 1.0)));
}
