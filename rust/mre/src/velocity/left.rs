//! What smoothing leaves of the noise of a motion.

use rand_chacha::ChaCha8Rng;

use super::Derived;
use super::octaves::{Calm, Calming};
use super::recorded::{Smoothed, Way};
use super::smoothing::Smoothing;
use super::together::Together;
use crate::deviate::normal;
use crate::kernel::intervals::way;

/// How noise was taken off a motion, of which some is left.
#[derive(Debug, Clone)]
pub(crate) enum Left {
    /// Of one whose velocity is derived.
    Derived(Calming),
    /// The same between corners, and the standard deviation of the noise of its displacement, mm.
    Between(Smoothing, f64),
    /// Of one whose velocity was recorded, with the standard deviation of the noise of that, mm/s.
    Recorded(Way, f64, Together),
}

impl Left {
    /// Of a motion with corners, derived from this displacement in mm.
    pub(crate) fn between_corners(displacement: &[f64], derived: &Derived) -> Self {
        let noise = derived.smoothing.variance(displacement, &derived.displacement).sqrt();
        Self::Between(derived.smoothing.clone(), noise)
    }

    /// Of a recorded velocity and the displacement that was brought together with it.
    pub(crate) fn recorded(velocity: Smoothed, together: Together) -> Self {
        Self::Recorded(velocity.way, velocity.noise, together)
    }

    /// True where there was no noise.
    pub(crate) fn is_none(&self) -> bool {
        match self {
            Self::Derived(calming) => calming.noise <= 0.0,
            Self::Between(_, noise) => *noise <= 0.0,
            Self::Recorded(_, noise, together) => *noise <= 0.0 && together.noise <= 0.0,
        }
    }

    /// What is left of as much noise as there was, drawn anew, of a motion at times in s with a displacement in mm and a
    /// velocity in mm/s.
    pub(crate) fn drawn(&self, [time, displacement, velocity]: [&[f64]; 3], stream: &mut ChaCha8Rng) -> Calm {
        let mut draw = |size: f64| time.iter().map(|_| size * normal(stream)).collect::<Vec<f64>>();
        let calm =
            |[displacement, velocity]: [Vec<f64>; 2]| Calm { displacement, velocity, noisy: Vec::new() };
        match self {
            Self::Derived(calming) => calming.over(time, &draw(calming.noise)),
            Self::Between(smoothing, noise) => {
                let (slope, value) = smoothing.over(time, &draw(*noise));
                calm([value, slope])
            }
            Self::Recorded(way_of_noise, noise, together) => {
                let of_velocity = way_of_noise.over(time, &draw(*noise));
                let of_displacement = draw(together.noise);
                let path = way(time, &of_velocity);
                calm(together.along(
                    [time, &path],
                    [&of_displacement, &of_velocity],
                    [displacement, velocity],
                ))
            }
        }
    }
}
