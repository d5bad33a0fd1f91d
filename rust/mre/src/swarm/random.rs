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
        share(self.0.next_u64())
    }

    /// The next of [`Stream::uniform`], many at once.
    pub(super) fn fill(&mut self, out: &mut [f64]) {
        let mut bytes = [[0; 8]; 128];
        for out in out.chunks_mut(bytes.len()) {
            let bytes = &mut bytes[..out.len()];
            self.0.fill_bytes(bytes.as_flattened_mut());
            for (x, bytes) in out.iter_mut().zip(bytes) {
                *x = share(u64::from_le_bytes(*bytes));
            }
        }
    }

    /// Uniform in [-1, 1).
    pub(super) fn symmetric(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }
}

fn share(bits: u64) -> f64 {
    (bits >> 11) as f64 * (1.0 / 9_007_199_254_740_992.0)
}

/// Points around `from`, each coordinate within `range`, moved into the unit box; as many as there is room
/// for.
///
/// With the step as range this is the random behaviour; with the visual range these are looks of the
/// searching behaviour.
pub(super) fn around(from: &[f64], range: f64, stream: &mut Stream, out: &mut [f64]) {
    stream.fill(out);
    for point in out.chunks_exact_mut(from.len()) {
        for (to, x) in point.iter_mut().zip(from) {
            *to = (x + range * (2.0 * *to - 1.0)).clamp(0.0, 1.0);
        }
    }
}

/// A point a random share of a step towards `target`, moved into the unit box.
pub(super) fn towards(from: &[f64], target: &[f64], step: f64, stream: &mut Stream, out: &mut [f64]) {
    let distance = super::view::distance(from, target);
    let share = if distance > 0.0 { stream.uniform() * step / distance } else { 0.0 };
    for ((to, x), target) in out.iter_mut().zip(from).zip(target) {
        *to = (x + share * (target - x)).clamp(0.0, 1.0);
    }
}
