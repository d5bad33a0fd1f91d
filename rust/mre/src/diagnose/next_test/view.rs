//! What a model says of an imagined test to first order: its parameters bend to a force as far as the recordings let
//! them.

use nalgebra::{DMatrix, DVector};

use super::world::{moved, widened};
use crate::assembly::Assembly;
use crate::diagnose::candidates::Candidate;
use crate::diagnose::least_squares::{Data, Fitted};
use crate::diagnose::moves::Moves;
use crate::diagnose::noise::Noise;
use crate::diagnose::normal::Normal;
use crate::diagnose::point::Point;
use crate::diagnose::step::{Ridge, step};
use crate::kernel::filter::dot;

const RIDGE: Ridge = Ridge { coefficients: 1e-12, shapes: 1e-9 };

/// How firmly the recordings hold the parameters of a model.
pub(super) struct Held(Normal);

impl Held {
    pub(super) fn of(model: &Candidate, data: Data) -> Self {
        let point = Point::at(&model.assembly, data, model.fitted.unit.clone());
        Self(point.with_tangents(&model.assembly, data))
    }

    /// Products of the coefficients and then the shapes.
    pub(super) fn gram(&self) -> &DMatrix<f64> {
        &self.0.gram
    }
}

/// A model on an imagined test.
pub(super) struct View {
    /// Force in N at the parameters that the recordings have.
    pub(super) force: Vec<f64>,
    /// Whitened columns and tangents on the test, by place.
    columns: Vec<(usize, Vec<f64>)>,
    /// Products of these, and of those on the recordings.
    gram: DMatrix<f64>,
    /// Shapes in the unit box.
    unit: Vec<f64>,
    /// Place of the test.
    place: usize,
}

impl View {
    /// Of an assembly whose last recording is the test; `noise` is that of the recordings and of the test.
    pub(super) fn new(assembly: &Assembly, model: &Candidate, held: &Held, noise: &Noise) -> Self {
        let place = assembly.campaign().recordings().len() - 1;
        let fitted = Fitted { coefficients: widened(model), ..model.fitted.clone() };
        let moves = Moves::of(assembly, &fitted);
        let bearing: Vec<usize> = moves.bearing(assembly, place).collect();
        let here = assembly.physical(&fitted.unit);
        let shapes = std::iter::once(here.as_slice()).chain(bearing.iter().map(|j| moves.shapes(*j)));
        let jobs: Vec<(usize, &[f64])> = shapes.map(|shapes| (place, shapes)).collect();
        let mut made = assembly.columns_of(&jobs).into_iter();
        let own = made.next().unwrap_or_default();
        let force = own.measured(&fitted.coefficients);
        let slopes = bearing.iter().zip(made).map(|(j, columns)| {
            let (i, change) = moves.slope(*j, &columns, &fitted.coefficients, &force);
            (i, noise.whiten(place, &change))
        });
        let linear = own.places.iter().zip(&own.columns);
        let linear = linear.map(|(i, column)| (*i, noise.whiten(place, column)));
        let columns: Vec<(usize, Vec<f64>)> = linear.chain(slopes).collect();
        let gram = gram(model, held, &columns, &assembly.known_of_coefficients());
        Self { columns, gram, unit: fitted.unit, place, force }
    }

    /// Whitened sum of squares that the model adds where the test shows a force in N, and the model has another.
    pub(super) fn lack(&self, force: &[f64], of_the_model: &[f64], noise: &Noise) -> f64 {
        let off: Vec<f64> = force.iter().zip(of_the_model).map(|(f, model)| f - model).collect();
        let off = noise.whiten(self.place, &off);
        let all = dot(&off, &off);
        if !all.is_finite() {
            return f64::INFINITY;
        }
        let mut right = DVector::zeros(self.gram.nrows());
        for (place, column) in &self.columns {
            right[*place] += dot(column, &off);
        }
        (all - step(&self.gram, &right, RIDGE, &self.unit).1).max(0.0)
    }
}

/// Products of all parameters: on the recordings, on the test, and what is known of those of the test's measurement.
fn gram(model: &Candidate, Held(held): &Held, columns: &[(usize, Vec<f64>)], known: &[f64]) -> DMatrix<f64> {
    let (mut places, count) = moved(&model.assembly);
    let mut gram = DMatrix::zeros(count + model.fitted.unit.len(), count + model.fitted.unit.len());
    let added = (0..count).filter(|i| !places.contains(i));
    for i in added {
        gram[(i, i)] = known[i];
    }
    places.extend(count..gram.nrows());
    for (i, a) in places.iter().enumerate() {
        for (j, b) in places.iter().enumerate() {
            gram[(*a, *b)] = held.gram[(i, j)];
        }
    }
    for (i, a) in columns {
        for (j, b) in columns {
            gram[(*i, *j)] += dot(a, b);
        }
    }
    gram
}
