//! Force clipping: the channel of the force does not show more than a level.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | L | level | N | 30 % to 100 % of the largest measured force |
//!
//! Of the measurement, not of the device: a simulation leaves it out.
//! Known limit: at one amplitude it is close to a softening spring.

use super::{About, Effect, Sizes, within};
use crate::parameter::Parameter;

/// A level on one side only is this many times as far on the other: beyond every measured force.
const FAR: f64 = 4.0;

/// On which side the force is clipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Clipping {
    /// On both, at the same level.
    Both,
    /// From above.
    Upper,
    /// From below.
    Lower,
}

impl Effect for Clipping {
    fn about(&self) -> About {
        let both = About {
            effect: "force_clipping",
            law: "both sides",
            plain: "the measured force is cut off at a level",
            equation: "F_measured = min(max(F, -L), L)",
            reference: "general",
            limit: "at one amplitude it is close to a softening spring",
        };
        match self {
            Self::Both => both,
            Self::Upper => About { law: "from above", equation: "F_measured = min(F, L)", ..both },
            Self::Lower => About { law: "from below", equation: "F_measured = max(F, -L)", ..both },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        vec![within("L", "N", 0.3 * sizes.force, sizes.force)]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        [0.5, 0.6, 0.7, 0.8, 0.88, 0.94, 0.98].iter().map(|share| vec![share * sizes.force]).collect()
    }

    fn clip(&self, shape: &[f64]) -> Option<(f64, f64)> {
        let level = shape[0];
        Some(match self {
            Self::Both => (-level, level),
            Self::Upper => (-FAR * level, level),
            Self::Lower => (-level, FAR * level),
        })
    }
}
