//! Normal deviates.

use rand_chacha::ChaCha8Rng;
use rand_core::Rng;

/// A standard normal deviate (Box and Muller 1958).
pub(crate) fn normal(stream: &mut ChaCha8Rng) -> f64 {
    let mut uniform = || ((stream.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64;
    (-2.0 * uniform().ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
}
