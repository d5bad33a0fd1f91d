//! Models: sums of terms, by name.

use crate::error::{Error, Result};
use crate::extent::Extent;
use crate::parameter::Parameter;
use crate::physics::{BoucWen, Dashpot, Offset, Sinh, Spring, Term};
use crate::recording::Recording;

type Terms = Vec<Box<dyn Term>>;
type MakeTerms = fn() -> Terms;

/// The models that can be identified. A new one is one line here and its terms in `physics/`.
const MODELS: [(&str, MakeTerms); 3] = [
    ("kelvin_voigt", || vec![Box::new(Dashpot), Box::new(Spring { name: "k0" }), Box::new(Offset)]),
    ("sinh", || vec![Box::new(Dashpot), Box::new(Spring { name: "k0" }), Box::new(Sinh), Box::new(Offset)]),
    ("bouc_wen", || {
        vec![Box::new(Dashpot), Box::new(Spring { name: "kx" }), Box::new(BoucWen), Box::new(Offset)]
    }),
];

/// Names of the models.
pub fn names() -> Vec<&'static str> {
    MODELS.iter().map(|(name, _)| *name).collect()
}

/// A sum of terms.
pub struct Model {
    name: &'static str,
    terms: Terms,
}

impl std::fmt::Debug for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Model({})", self.name)
    }
}

impl Model {
    /// The model of this name.
    ///
    /// # Errors
    /// A name that no model has.
    pub fn named(name: &str) -> Result<Self> {
        match MODELS.iter().find(|(known, _)| *known == name) {
            Some((name, terms)) => Ok(Self { name, terms: terms() }),
            None => {
                Err(Error::setting("model", format!("'{name}'"), format!("one of {}", names().join(", "))))
            }
        }
    }

    /// The name it is known by.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Its terms, in the order of the equation.
    pub fn terms(&self) -> &[Box<dyn Term>] {
        &self.terms
    }

    /// Parameters with default boxes: term by term, coefficient before shape.
    pub fn parameters(&self, extent: &Extent) -> Vec<Parameter> {
        self.terms
            .iter()
            .flat_map(|term| std::iter::once(term.coefficient(extent)).chain(term.shape(extent)))
            .collect()
    }

    /// Bounds of shape parameters that a device may have outside their default boxes.
    pub(crate) fn far(&self, extent: &Extent) -> Vec<(String, f64, f64)> {
        self.terms.iter().flat_map(|term| term.far(extent)).collect()
    }

    /// Add the force in N of these parameters to `out`, times a weight for every sample if given.
    ///
    /// `column` is scratch space. Lengths: `parameters` as [`Model::parameters`], the others as the
    /// recording.
    pub fn add_force(
        &self,
        recording: &Recording,
        parameters: &[f64],
        weight: Option<&[f64]>,
        column: &mut [f64],
        out: &mut [f64],
    ) {
        let mut next = 0;
        for term in &self.terms {
            let shape = next + 1..next + 1 + term.shape(&Extent::UNIT).len();
            term.column(recording, &parameters[shape.clone()], column);
            for (i, value) in column.iter().enumerate() {
                out[i] += parameters[next] * value * weight.map_or(1.0, |w| w[i]);
            }
            next = shape.end;
        }
    }
}
