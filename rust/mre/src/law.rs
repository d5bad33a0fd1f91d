//! How the parameters of one problem depend on the coil current.

use std::sync::Arc;

use crate::device::Level;
use crate::error::{Error, Result};
use crate::extent::Extent;
use crate::fitness::Scratch;
use crate::model::Model;
use crate::parameter::Parameter;
use crate::physics::Part;
use crate::recording::{Condition, Recording, extent as range};

/// The law of a problem.
#[derive(Debug, Clone, PartialEq)]
pub enum Law {
    /// The same parameters for all recordings.
    Shared,
    /// The current changes within a recording: coefficients that follow it are affine between their
    /// values at the lowest and the highest current; shapes and offset are constant.
    Affine {
        /// Lowest current, A.
        low: f64,
        /// Highest current, A.
        high: f64,
        /// The model's parameters: true where one has two values.
        split: Vec<bool>,
    },
}

impl Law {
    /// The law that recordings ask for.
    ///
    /// # Errors
    /// The current changes within one recording, and another has none.
    pub(crate) fn of(recordings: &[Arc<Recording>], model: &Model) -> Result<Self> {
        if !recordings.iter().any(|r| r.current().varies()) {
            return Ok(Self::Shared);
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for recording in recordings {
            let (least, most) = match recording.current() {
                Condition::Series(values) => range(values),
                Condition::Constant(value) => (*value, *value),
                Condition::Missing => {
                    let text = "no current, though it changes within another recording: set current=VALUE[A]";
                    return Err(Error::Recording(text.into()).in_recording(recording.name()));
                }
            };
            (low, high) = (low.min(least), high.max(most));
        }
        let split = model
            .terms()
            .iter()
            .flat_map(|term| {
                std::iter::once(term.follows_current())
                    .chain(term.shape(&Extent::UNIT).into_iter().map(|_| false))
            })
            .collect();
        Ok(Self::Affine { low, high, split })
    }

    /// Parameters of a model under the law; those with two values carry their current in the name.
    pub(crate) fn parameters(&self, model: &Model, extent: &Extent) -> Vec<Parameter> {
        let all = model.parameters(extent);
        let Self::Affine { low, high, split } = self else { return all };
        let at = |p: &Parameter, current: &f64| Parameter {
            name: format!("{}({current} A)", p.name),
            ..p.clone()
        };
        all.into_iter()
            .zip(split)
            .flat_map(|(p, two)| if *two { vec![at(&p, low), at(&p, high)] } else { vec![p] })
            .collect()
    }

    /// The levels of the device that these values describe. `current` is that of a shared law.
    pub fn levels(&self, values: &[f64], current: Option<f64>) -> Vec<Level> {
        let Self::Affine { low, high, split } = self else {
            return vec![Level { current, values: values.to_vec() }];
        };
        let (mut first, mut second) = (Vec::new(), Vec::new());
        let mut next = values.iter();
        for two in split {
            let Some(value) = next.next() else { break };
            first.push(*value);
            second.push(if *two { *next.next().unwrap_or(value) } else { *value });
        }
        vec![Level { current: Some(*low), values: first }, Level { current: Some(*high), values: second }]
    }

    /// True for the parameters that are shapes, false for coefficients.
    pub(crate) fn shapes(&self, model: &Model) -> Vec<bool> {
        let plain = model.terms().iter().flat_map(|term| {
            std::iter::once(false).chain(term.shape(&Extent::UNIT).into_iter().map(|_| true))
        });
        match self {
            Self::Shared => plain.collect(),
            Self::Affine { split, .. } => {
                plain.zip(split).flat_map(|(shape, two)| vec![shape; if *two { 2 } else { 1 }]).collect()
            }
        }
    }

    /// The part of every coefficient, in their order among the parameters.
    pub(crate) fn parts(&self, model: &Model) -> Vec<Part> {
        let two = |follows: bool| if follows && matches!(self, Self::Affine { .. }) { 2 } else { 1 };
        let terms = model.terms().iter();
        terms.flat_map(|term| vec![term.part(); two(term.follows_current())]).collect()
    }

    /// Columns of the coefficients, in their order among the parameters, for given shapes.
    pub(crate) fn columns(&self, model: &Model, recording: &Recording, values: &[f64]) -> Vec<Vec<f64>> {
        Self::columns_of(model, &[(self, recording, values)]).pop().unwrap_or_default()
    }

    /// The same for several recordings, each under its law with its own values.
    pub(crate) fn columns_of(model: &Model, of: &[(&Self, &Recording, &[f64])]) -> Vec<Vec<Vec<f64>>> {
        let values: Vec<Vec<f64>> =
            of.iter().map(|(law, _, values)| law.levels(values, None).swap_remove(0).values).collect();
        let (mut found, mut next) = (vec![Vec::new(); of.len()], 0);
        for term in model.terms() {
            let shape = next + 1..next + 1 + term.shape(&Extent::UNIT).len();
            let jobs: Vec<(&Recording, &[f64])> = of
                .iter()
                .zip(&values)
                .map(|((_, recording, _), values)| (*recording, &values[shape.clone()]))
                .collect();
            for ((columns, column), (law, recording, _)) in found.iter_mut().zip(term.columns(&jobs)).zip(of)
            {
                if matches!(law, Self::Affine { .. }) && term.follows_current() {
                    let of_share = |share: Vec<f64>| column.iter().zip(share).map(|(c, s)| c * s).collect();
                    columns.extend(law.shares(recording).map(of_share));
                } else {
                    columns.push(column);
                }
            }
            next = shape.end;
        }
        found
    }

    /// Shares of the lowest and the highest current in every sample.
    fn shares(&self, recording: &Recording) -> [Vec<f64>; 2] {
        let Self::Affine { low, high, .. } = self else { return [vec![1.0; recording.len()], Vec::new()] };
        let share = |i: f64| ((i - low) / (high - low)).clamp(0.0, 1.0);
        let current = recording.current();
        let upper: Vec<f64> = match current.changing() {
            Some(changing) => changing.iter().map(|i| share(*i)).collect(),
            None => vec![share(current.level().unwrap_or(*low)); recording.len()],
        };
        [upper.iter().map(|w| 1.0 - w).collect(), upper]
    }

    /// Add the force of these values to the scratch buffer.
    pub(crate) fn add_force(
        &self,
        model: &Model,
        recording: &Recording,
        values: &[f64],
        scratch: &mut Scratch,
    ) {
        let Scratch { force, column } = scratch;
        if *self == Self::Shared {
            return model.add_force(recording, values, None, column, force);
        }
        for (level, weight) in self.levels(values, None).iter().zip(self.shares(recording)) {
            model.add_force(recording, &level.values, Some(&weight), column, force);
        }
    }
}
