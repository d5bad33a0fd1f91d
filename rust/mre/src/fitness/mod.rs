//! Fitness of candidate parameters on recordings: eq. 5 (mean squared error, N^2), of which eq. 9 is
//! the root; over several recordings together, each with its weight.

mod bounds;
mod changed;
mod evaluate;
mod stream;
mod weights;

use std::sync::Arc;

pub use evaluate::Scratch;
pub(crate) use evaluate::finite_or_infinite;
pub use stream::Stream;
pub use weights::Weights;

use crate::error::Result;
use crate::extent::Extent;
use crate::kernel::{BoucWenRk4, Sinh, SinhCompressed, sinh_compressed};
use crate::law::Law;
use crate::model::Model;
use crate::parameter::{Bounds, Parameter};
use crate::recording::Recording;

/// Recordings, a model, and the box of its parameters.
#[derive(Debug)]
pub struct Problem {
    recordings: Vec<Arc<Recording>>,
    model: Model,
    law: Law,
    parameters: Vec<Parameter>,
    bounds: Bounds,
    weights: Vec<f64>,
    /// Shared by problems on the same samples.
    kernel: Arc<Kernel>,
}

#[derive(Debug)]
enum Kernel {
    Sinh(Box<Sinh>),
    BoucWen(Vec<BoucWenRk4>),
    /// Any model, term by term.
    Terms,
}

impl Kernel {
    fn new(
        recordings: &[Arc<Recording>],
        model: &Model,
        law: &Law,
        bounds: &Bounds,
        weights: &[f64],
    ) -> Self {
        match (model.name(), law) {
            ("sinh", Law::Shared) => {
                let largest_beta = bounds.lower()[3].abs().max(bounds.upper()[3].abs());
                Self::Sinh(Box::new(Sinh::new(recordings, weights, largest_beta)))
            }
            ("bouc_wen", Law::Shared) => {
                Self::BoucWen(recordings.iter().cloned().map(BoucWenRk4::new).collect())
            }
            _ => Self::Terms,
        }
    }
}

/// True for so few samples that [`Problem::new`] makes them ready on the calling thread alone.
pub fn is_small(recordings: &[Arc<Recording>]) -> bool {
    sinh_compressed::is_one_leaf(recordings)
}

impl Problem {
    /// A problem with the default box, in which named parameters have other bounds.
    ///
    /// All recordings share the parameters, whatever their current, unless the current changes within
    /// one of them: then the coefficients are affine in the current.
    ///
    /// # Errors
    /// No recording, a recording without force or with less motion than the model needs, an unknown
    /// parameter, bounds that are reversed, not admissible or so wide that sinh overflows, or weights
    /// that are not positive.
    pub fn new(
        recordings: Vec<Arc<Recording>>,
        model: Model,
        bounds: &[(String, f64, f64)],
        weights: &Weights,
    ) -> Result<Self> {
        let extent = Extent::of(&recordings)?;
        let law = Law::of(&recordings, &model)?;
        let mut parameters = law.parameters(&model, &extent);
        let bounds = bounds::choose(&mut parameters, bounds, extent.displacement)?;
        let weights = weights.scaled(&recordings)?;
        let kernel = Arc::new(Kernel::new(&recordings, &model, &law, &bounds, &weights));
        Ok(Self { recordings, model, law, parameters, bounds, weights, kernel })
    }

    /// The recordings; none where the samples were streamed.
    pub fn recordings(&self) -> &[Arc<Recording>] {
        &self.recordings
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// How the parameters depend on the current.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// Parameters with the bounds in force.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Weight of the sum of squares of each recording; the fitness is the weighted sum.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The box.
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Number of samples that count.
    pub fn samples(&self) -> usize {
        match &*self.kernel {
            Kernel::Sinh(kernel) => kernel.samples(),
            _ => self.recordings.iter().map(|r| r.scored().len()).sum(),
        }
    }

    /// True where one thread goes through the samples before another one would have started.
    pub(crate) fn is_small(&self) -> bool {
        is_small(&self.recordings)
    }

    /// The samples as a triangular factor, where the model and the box allow one.
    pub(crate) fn compressed(&self) -> Option<&SinhCompressed> {
        if let Kernel::Sinh(kernel) = &*self.kernel { kernel.compressed() } else { None }
    }
}
