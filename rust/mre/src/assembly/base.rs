//! The base of an assembly: a model that is fitted, a device that is kept as it is, or a given force.

use std::sync::Arc;

use super::kept::Kept;
use crate::error::Result;
use crate::extent::Extent;
use crate::fitness::{Problem, Weights};
use crate::model::Model;
use crate::physics::Part;
use crate::recording::Recording;

/// Recordings that share the parameters of the base model.
#[derive(Debug)]
pub struct Group {
    /// Their places in the campaign.
    pub members: Vec<usize>,
    /// Model, law and box.
    pub problem: Problem,
    /// Places of the coefficients among the problem's parameters.
    pub coefficients: Vec<usize>,
    /// Places of the shapes.
    pub shapes: Vec<usize>,
}

/// What the effects are added to.
#[derive(Debug)]
pub enum Base {
    /// A model that is fitted, in groups that share parameters.
    Fitted(Vec<Group>),
    /// A device whose parameters are kept as they are.
    Held(Kept),
    /// A force in N for every recording, such as a user's own simulation.
    Given(Vec<Vec<f64>>),
}

impl Base {
    /// A model whose parameters are shared within groups of recordings.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub fn fitted(recordings: &[Arc<Recording>], model: &str, groups: &[Vec<usize>]) -> Result<Self> {
        let groups = groups.iter().map(|members| {
            let own: Vec<Arc<Recording>> = members.iter().map(|i| recordings[*i].clone()).collect();
            let model = Model::named(model)?;
            let far = model.far(&Extent::of(&own)?);
            let problem = Problem::new(own, model, &far, &Weights::Samples)?;
            let is_shape = problem.law().shapes(problem.model());
            let places = |wanted: bool| (0..is_shape.len()).filter(|i| is_shape[*i] == wanted).collect();
            Ok(Group { members: members.clone(), coefficients: places(false), shapes: places(true), problem })
        });
        Ok(Self::Fitted(groups.collect::<Result<_>>()?))
    }

    /// True where a term is hysteretic.
    pub(crate) fn is_hysteretic(&self) -> bool {
        let model = match self {
            Self::Fitted(groups) => groups.first().map(|g| g.problem.model()),
            Self::Held(kept) => Some(kept.model()),
            Self::Given(_) => None,
        };
        model.is_some_and(|m| m.terms().iter().any(|term| term.part() == Part::Hysteretic))
    }

    /// The same base on other recordings; `members` are the places of those that share parameters, group by
    /// group, where it is fitted.
    ///
    /// # Errors
    /// As [`Problem::new`].
    pub(crate) fn again(&self, recordings: &[Arc<Recording>], members: &[Vec<usize>]) -> Result<Self> {
        match self {
            Self::Fitted(groups) => {
                let model = groups.first().map_or("", |g| g.problem.model().name());
                Self::fitted(recordings, model, members)
            }
            Self::Held(kept) => Ok(Self::Held(kept.again()?)),
            Self::Given(force) => Ok(Self::Given(force.clone())),
        }
    }

    /// The same with parameters that are fitted, in groups of recordings that share them; `None` for a base that is
    /// fitted or given, or has effects, and where no problem can be made of the recordings.
    pub(crate) fn unkept(&self, recordings: &[Arc<Recording>], groups: &[Vec<usize>]) -> Option<Self> {
        let Self::Held(kept) = self else { return None };
        if kept.has_effects() {
            return None;
        }
        Self::fitted(recordings, kept.model().name(), groups).ok()
    }

    /// Places of the recordings that share parameters, group by group.
    pub(crate) fn members(&self) -> Vec<Vec<usize>> {
        self.groups().iter().map(|g| g.members.clone()).collect()
    }

    /// The groups of a fitted base.
    pub fn groups(&self) -> &[Group] {
        match self {
            Self::Fitted(groups) => groups,
            Self::Held(_) | Self::Given(_) => &[],
        }
    }
}
