//! Every law of every effect.

use super::{Effect, delay, maxwell, payne};

/// The catalogue: the laws of an effect stand together, its plainest law first.
pub const CATALOGUE: &[&dyn Effect] =
    &[&maxwell::Maxwell, &delay::TimeDelay, &payne::Payne { whole: false }, &payne::Payne { whole: true }];

/// The law of this name of an effect.
pub fn named(effect: &str, law: &str) -> Option<&'static dyn Effect> {
    CATALOGUE.iter().copied().find(|known| known.about().effect == effect && known.about().law == law)
}
