//! A softening law of another file whose damping loses a share of its own: rubber that warms up loses more of its
//! damping than of its stiffness.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | r | share that the damping loses, over that of the stiffness | - | 0 to 3 |
//!
//! Reference: that of the plain law.
//! Known limit: where the motion has one frequency and amplitude, the two shares cannot be told apart.

use super::factors::LEAST_KEPT;
use super::{About, Effect, Factors, Scene, Sizes, ideal_below, within};
use crate::parameter::Parameter;

/// Most that the damping loses, over what the stiffness does.
const MOST: f64 = 3.0;
/// Where a fit starts; nothing and the same as of the stiffness are laws of their own.
const START: f64 = 1.8;

/// A law that scales the stiffness, and the damping by another share.
pub(super) struct OwnShare {
    /// The law of the stiffness.
    pub(super) law: &'static dyn Effect,
    /// Name among the laws of the effect.
    pub(super) name: &'static str,
    /// Its equation.
    pub(super) equation: &'static str,
}

impl Effect for OwnShare {
    fn about(&self) -> About {
        About { law: self.name, equation: self.equation, ..self.law.about() }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        self.law.applies(sizes)
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let mut shape = self.law.shape(sizes);
        shape.push(ideal_below(within("r", "", 0.0, MOST)));
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law.starts(sizes).into_iter().map(|start| start.into_iter().chain([START]).collect()).collect()
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let (of_damping, of_law) = shape.split_last()?;
        let factors = self.law.factors(scene, of_law)?;
        let kept = |k: &f64| (1.0 - of_damping * (1.0 - k)).max(LEAST_KEPT);
        let damping = Some(factors.stiffness.iter().map(kept).collect());
        Some(Factors { damping, ..factors })
    }
}
