//! Parameters with names, units and boxes, and the unit box in which the swarms move.

use crate::error::{Error, Result};

/// How a parameter is spread over the unit interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// Evenly in the logarithm; for positive parameters of unknown order of magnitude.
    Log,
}

/// A parameter of a term: what it is called, what it means, where it may lie.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Symbol, as in the equations.
    pub name: String,
    /// Unit, such as `N/mm`; empty for a pure number.
    pub unit: &'static str,
    /// Smallest admissible value, whatever the box (`c0 >= 0`).
    pub smallest: f64,
    /// Largest admissible value.
    pub largest: f64,
    /// Default lower bound, from the recordings.
    pub lower: f64,
    /// Default upper bound, from the recordings.
    pub upper: f64,
    /// Spread over the unit interval.
    pub scale: Scale,
    /// Bounds at which its law is an ideal of its own (a sharp sign, say), and not about to be another's.
    pub ideal: Ideal,
}

/// Squared standard deviations by which a residual plainly goes along a parameter.
const PLAINLY: f64 = 9.0;

impl Parameter {
    /// True where a value stands at a limit of what is physical that a residual would plainly have it pass: its product with
    /// the parameter's column, whitened, is `slope`, and the square of the column `square`. What other parameters could take
    /// off instead is not counted: only what stands without them is plain.
    pub(crate) fn is_pressed(&self, value: f64, slope: f64, square: f64) -> bool {
        let outwards = (value <= self.smallest && slope < 0.0) || (value >= self.largest && slope > 0.0);
        outwards && slope * slope > PLAINLY * square
    }

    /// True where this value in the unit box is an ideal of its law.
    pub(crate) fn is_ideal(&self, unit: f64) -> bool {
        (unit <= 0.0 && self.ideal.lower) || (unit >= 1.0 && self.ideal.upper)
    }
}

/// Which bounds of a parameter are ideals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Ideal {
    /// The lower one.
    pub lower: bool,
    /// The upper one.
    pub upper: bool,
}

/// A bound beyond this could not be squared beside forces and motions that are taken.
const LARGEST_BOUND: f64 = 1e100;

/// A box and its map to the unit box.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    lower: Vec<f64>,
    upper: Vec<f64>,
    scale: Vec<Scale>,
}

/// A number for a message: with an exponent where it would have too many zeros.
pub(crate) fn short(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || !size.is_finite() || (1e-6..1e12).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

impl Bounds {
    /// A box; every parameter is named in the errors.
    ///
    /// # Errors
    /// A bound that is not finite or beyond 1e100, a lower bound that is not below the upper one, or a logarithmic
    /// scale that reaches zero.
    pub fn new(names: &[String], lower: Vec<f64>, upper: Vec<f64>, scale: Vec<Scale>) -> Result<Self> {
        if lower.is_empty() {
            return Err(Error::setting("number of parameters", 0, "at least one bound is needed"));
        }
        for (i, name) in names.iter().enumerate() {
            let (low, high) = (lower[i], upper[i]);
            let wanted = if !low.is_finite() || !high.is_finite() {
                "both bounds have to be finite numbers"
            } else if low.abs().max(high.abs()) > LARGEST_BOUND {
                "both bounds have to be within 1e100"
            } else if low >= high {
                "the lower bound has to be below the upper one"
            } else if scale[i] == Scale::Log && low <= 0.0 {
                "the lower bound has to be above zero"
            } else {
                continue;
            };
            return Err(Error::setting(
                format!("bound of {name}"),
                format!("{}:{}", short(low), short(high)),
                wanted,
            ));
        }
        Ok(Self { lower, upper, scale })
    }

    /// Lower bounds.
    pub fn lower(&self) -> &[f64] {
        &self.lower
    }

    /// Upper bounds.
    pub fn upper(&self) -> &[f64] {
        &self.upper
    }

    /// Number of parameters.
    pub fn len(&self) -> usize {
        self.lower.len()
    }

    /// Never true.
    pub fn is_empty(&self) -> bool {
        self.lower.is_empty()
    }

    /// From rows of the unit box to rows of parameters. Never outside the box, and exact at its ends.
    pub fn to_physical(&self, unit: &[f64], out: &mut [f64]) {
        for i in 0..self.len() {
            let (low, high) = (self.lower[i], self.upper[i]);
            match self.scale[i] {
                Scale::Linear => self.place(i, unit, out, |u| low + u * (high - low)),
                Scale::Log => self.place(i, unit, out, |u| low * (high / low).powf(u)),
            }
        }
    }

    /// One parameter of all rows.
    #[inline]
    fn place(&self, i: usize, unit: &[f64], out: &mut [f64], value: impl Fn(f64) -> f64) {
        let (d, low, high) = (self.len(), self.lower[i], self.upper[i]);
        for (unit, out) in unit.chunks_exact(d).zip(out.chunks_exact_mut(d)) {
            let u = unit[i];
            let wished = if u < 1.0 { value(u) } else { high };
            let above = if wished > low { wished } else { low };
            out[i] = if above < high { above } else { high };
        }
    }

    /// From the parameters to the unit box; values outside are moved to the nearest bound.
    pub fn to_unit(&self, physical: &[f64], out: &mut [f64]) {
        for (i, value) in physical.iter().enumerate() {
            let (low, high) = (self.lower[i], self.upper[i]);
            let value = value.clamp(low, high);
            out[i] = match self.scale[i] {
                Scale::Linear => (value - low) / (high - low),
                Scale::Log => (value / low).ln() / (high / low).ln(),
            }
            .clamp(0.0, 1.0);
        }
    }

    /// Which parameters lie on a bound, to within a millionth of the unit interval: -1 lower, 1 upper.
    pub fn on_bound(&self, physical: &[f64]) -> Vec<i8> {
        let mut unit = vec![0.0; self.len()];
        self.to_unit(physical, &mut unit);
        unit.iter().map(|u| if *u < 1e-6 { -1 } else { i8::from(*u > 1.0 - 1e-6) }).collect()
    }
}
