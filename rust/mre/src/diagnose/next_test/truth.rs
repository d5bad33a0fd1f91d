//! What may be true: models that are in doubt, and how far the recordings leave their shapes open.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use rayon::prelude::*;

use super::view::Held;
use crate::diagnose::candidates::Candidate;
use crate::diagnose::least_squares::Data;
use crate::diagnose::point::Point;

/// Standard deviation in the unit box of a shape that the recordings leave open.
const OPEN: f64 = 0.3;
/// A direction that is held within so much of the box is no other truth.
const HELD: f64 = 0.02;
/// A point whose likelihood is a smaller share of the best one's is nearer to it than the curvature says.
const LIKELY: f64 = 0.2;
/// Times that its distance is halved then.
const HALVINGS: usize = 3;
/// Regularises coefficients that no sample determines, beside their scaled products.
const RIDGE: f64 = 1e-10;

/// A model that may be true, at parameters that may.
pub(super) struct Truth<'a> {
    /// Place among the models in doubt.
    pub(super) model: usize,
    /// The model at these parameters.
    pub(super) candidate: Candidate<'a>,
    /// Share of the likelihood; those of a model together have the model's.
    pub(super) weight: f64,
    /// What it leaves of the recordings more than the best fit, in squared standard deviations.
    pub(super) behind: f64,
}

/// The best fit of a model with a share of the likelihood, and where the recordings leave shapes of its effects open
/// points a standard deviation to both sides along what they hold least.
pub(super) fn truths<'a>(
    place: usize,
    share: f64,
    model: &Candidate<'a>,
    held: &Held,
    data: Data,
) -> Vec<Truth<'a>> {
    let best = Truth { model: place, candidate: model.clone(), weight: 1.0, behind: 0.0 };
    let Some(open) = least_held(held.gram(), model.assembly.base_shapes(), model.fitted.unit.len()) else {
        return vec![Truth { weight: share, ..best }];
    };
    let beside = [-1.0, 1.0].par_iter().filter_map(|side| {
        let far = (0..=HALVINGS).map(|halvings| side * 0.5_f64.powi(halvings as i32));
        far.map(|far| point(model, &open, far, data)).find_map(|found| {
            let (candidate, moved) = found;
            let behind = (candidate.fitted.left - model.fitted.left).max(0.0);
            let likely = (-0.5 * behind).exp();
            let truth = Truth { model: place, candidate, weight: likely, behind };
            (moved > HELD && likely > LIKELY).then_some(truth)
        })
    });
    let beside: Vec<Truth> = beside.collect();
    let all: Vec<Truth> = std::iter::once(best).chain(beside).collect();
    let whole: f64 = all.iter().map(|truth| truth.weight).sum();
    all.into_iter().map(|truth| Truth { weight: share * truth.weight / whole, ..truth }).collect()
}

/// Shapes that the recordings leave open.
struct Open {
    /// Direction of the effects' shapes along which the recordings say least, as long as one standard deviation.
    along: DVector<f64>,
    /// By how much the shapes of the base move with those of the effects.
    follows: DMatrix<f64>,
}

/// What is open where the coefficients and the first shapes, those of the base, follow. `gram` is of the coefficients and
/// then the shapes.
fn least_held(gram: &DMatrix<f64>, base: usize, shapes: usize) -> Option<Open> {
    let (k, first) = (gram.nrows() - shapes, gram.nrows() - shapes + base);
    if shapes == base {
        return None;
    }
    let scale: Vec<f64> =
        (0..first).map(|i| if gram[(i, i)] > 0.0 { gram[(i, i)].sqrt() } else { 1.0 }).collect();
    let prior = |i: usize| if i < k { 0.0 } else { OPEN.powi(-2) };
    let own = DMatrix::from_fn(first, first, |i, j| {
        let missing = f64::from(u8::from(gram[(i, i)] <= 0.0));
        let added = if i == j { RIDGE + missing + prior(i) / scale[i].powi(2) } else { 0.0 };
        gram[(i, j)] / (scale[i] * scale[j]) + added
    });
    let count = shapes - base;
    let cross = DMatrix::from_fn(first, count, |i, j| gram[(i, first + j)] / scale[i]);
    let follows = own.cholesky()?.solve(&cross);
    let shared = cross.transpose() * &follows;
    let alone = DMatrix::from_fn(count, count, |i, j| {
        let known = if i == j { prior(first + i) } else { 0.0 };
        gram[(first + i, first + j)] - 0.5 * (shared[(i, j)] + shared[(j, i)]) + known
    });
    let SymmetricEigen { eigenvalues, eigenvectors } = alone.symmetric_eigen();
    let least = eigenvalues.imin();
    let deviation = eigenvalues[least].max(OPEN.powi(-2)).powf(-0.5);
    let follows = DMatrix::from_fn(base, count, |i, j| -follows[(k + i, j)] / scale[k + i]);
    (deviation > HELD).then(|| Open { along: deviation * eigenvectors.column(least), follows })
}

/// A model so far along a direction, with the best coefficients there, and how far its effects' shapes have moved in the
/// box.
fn point<'a>(model: &Candidate<'a>, open: &Open, far: f64, data: Data) -> (Candidate<'a>, f64) {
    let known = &model.fitted.unit;
    let base = open.follows.nrows();
    let step = DVector::from_fn(open.along.len(), |i, _| {
        let from = known[base + i];
        (from + far * open.along[i]).clamp(0.0, 1.0) - from
    });
    let steps = (&open.follows * &step).iter().chain(step.iter()).copied().collect::<Vec<f64>>();
    let unit: Vec<f64> = known.iter().zip(steps).map(|(u, s)| (u + s).clamp(0.0, 1.0)).collect();
    let moved = step.amax();
    let mut assembly = model.assembly.clone();
    let mut fitted = Point::at(&assembly, data, unit).fitted;
    if assembly.flexibility(&assembly.physical(&fitted.unit)).is_some() {
        assembly = assembly.seeing_its_force(&fitted.unit, &fitted.coefficients);
        fitted = Point::at(&assembly, data, fitted.unit).fitted;
    }
    (Candidate { assembly, fitted }, moved)
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use super::*;

    #[test]
    fn what_the_base_can_make_up_for_is_open_and_the_base_follows() {
        // A coefficient, a shape of the base, two of an effect: the first is held, but for what the base makes up for.
        let mut gram = DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 1e6, 1e6 + 100.0, 1e4]));
        (gram[(1, 2)], gram[(2, 1)]) = (1e6, 1e6);
        let open = least_held(&gram, 1, 3).expect("a direction");
        // The base's own prior holds it a little.
        let left = 100.0 + 2.0 * OPEN.powi(-2);
        let Open { along, follows } = open;
        assert!((along[0].abs() - left.powf(-0.5)).abs() < 1e-5 && along[1].abs() < 1e-9, "{along}");
        assert!((follows[0] + 1.0).abs() < 1e-4 && follows[1].abs() < 1e-9, "{follows}");
        // Every other truth of one that is held is the same truth.
        assert!(least_held(&DMatrix::from_diagonal_element(2, 2, 1e6), 0, 1).is_none());
        assert!(least_held(&gram.view((0, 0), (2, 2)).into_owned(), 1, 1).is_none());
    }
}
