//! A softening law of another file that acts on a part of the base model alone, which is another mechanism: on its
//! dashpot (oil that warms up), or, of a hysteretic model, on its springs or its hysteretic force (a lead core that
//! warms up, cracks that close).
//!
//! Reference: that of the plain law.
//! Known limit: where the other part is small it is the plain law.

use super::{About, Effect, Factors, Scene, Sizes, Stored};
use crate::parameter::Parameter;

/// What a law acts on.
enum Where {
    /// A part of what stores energy.
    Store(Stored),
    /// The dashpot.
    Dashpot,
}

/// A law that scales the stiffness, on a part of the base model.
pub(super) struct OnPart {
    /// The plain law.
    law: &'static dyn Effect,
    /// The part.
    on: Where,
    /// Name among the laws of the effect.
    name: &'static str,
    /// Its equation, where that of the plain law names another part.
    equation: Option<&'static str>,
}

impl OnPart {
    /// A law on the springs alone.
    pub(super) const fn springs(law: &'static dyn Effect, name: &'static str) -> Self {
        Self { law, on: Where::Store(Stored::Springs), name, equation: None }
    }

    /// A law on the hysteretic force alone.
    pub(super) const fn hysteretic(
        law: &'static dyn Effect,
        name: &'static str,
        equation: &'static str,
    ) -> Self {
        Self { law, on: Where::Store(Stored::Hysteretic), name, equation: Some(equation) }
    }

    /// A law on the dashpot alone.
    pub(super) const fn dashpot(
        law: &'static dyn Effect,
        name: &'static str,
        equation: &'static str,
    ) -> Self {
        Self { law, on: Where::Dashpot, name, equation: Some(equation) }
    }
}

impl Effect for OnPart {
    fn about(&self) -> About {
        let plain = self.law.about();
        About { law: self.name, equation: self.equation.unwrap_or(plain.equation), ..plain }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        self.law.applies(sizes)
    }

    fn on_a_part(&self) -> bool {
        !matches!(self.on, Where::Dashpot)
    }

    fn in_one_recording(&self) -> bool {
        self.law.in_one_recording()
    }

    fn moment(&self, shape: &[f64]) -> Option<(f64, f64)> {
        self.law.moment(shape)
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        self.law.shape(sizes)
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        self.law.starts(sizes)
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        self.law.factors(scene, shape).map(|factors| match self.on {
            Where::Store(on) => Factors { on, ..factors },
            Where::Dashpot => factors.of_damping(),
        })
    }
}
