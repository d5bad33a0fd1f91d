//! Factors of laws that scale the terms of the base model.

use crate::physics::Part;

/// Factors on the terms of the base model, one value a sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// On the terms that store energy.
    pub stiffness: Vec<f64>,
    /// Which of them.
    pub on: Stored,
    /// On the viscous terms; `None`: unchanged.
    pub damping: Option<Vec<f64>>,
}

/// Terms that store energy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stored {
    /// Springs and hysteretic terms.
    All,
    /// Springs alone.
    Springs,
    /// Hysteretic terms alone.
    Hysteretic,
}

impl Factors {
    /// Those on a part of the base model, if they change it.
    pub(crate) fn on(&self, part: Part) -> Option<&[f64]> {
        match part {
            Part::Stiffness if self.on != Stored::Hysteretic => Some(&self.stiffness),
            Part::Hysteretic if self.on != Stored::Springs => Some(&self.stiffness),
            Part::Damping => self.damping.as_deref(),
            Part::Stiffness | Part::Hysteretic | Part::Offset => None,
        }
    }
}

/// No factor falls below this.
pub(super) const LEAST_KEPT: f64 = 0.05;

impl Factors {
    /// The factor that is kept of the stiffness, or of the whole force.
    pub(super) fn kept(mut kept: Vec<f64>, whole: bool) -> Self {
        for k in &mut kept {
            *k = k.max(LEAST_KEPT);
        }
        let damping = whole.then(|| kept.clone());
        Self { stiffness: kept, on: Stored::All, damping }
    }

    /// A share that is lost, times a state that goes from zero to about one.
    pub(super) fn losing(share: f64, state: &[f64], whole: bool) -> Self {
        Self::kept(state.iter().map(|z| 1.0 - share * z).collect(), whole)
    }

    /// The same on the viscous terms alone.
    pub(super) fn of_damping(self) -> Self {
        let stiffness = vec![1.0; self.stiffness.len()];
        Self { damping: Some(self.stiffness), stiffness, on: Stored::Springs }
    }
}
