//! Intervals of parameters and of what is derived from them, and whether they mean anything.

use nalgebra::DVector;

use super::covariance::Covariance;
use super::derived::Derived;
use super::local::{LITTLE, Local, fixed};
use super::tangent::difference;
use super::{Estimate, student};

/// Correlation with a parameter that is not determined above which another is not either: the line on
/// which both can move is straight only nearby.
const TIED: f64 = 0.9;

/// The parameters of a fit with their intervals.
pub(super) fn parameters(
    local: &Local<'_>,
    covariance: &Covariance,
    correlation: &[f64],
    level: f64,
) -> Vec<Estimate> {
    let (problem, values, d) = (local.problem, local.values, local.values.len());
    // Standard error, half of the interval, and whether they are small, of every free parameter.
    let mut spreads = vec![None; d];
    for (place, &j) in local.free.iter().enumerate() {
        let unit = DVector::from_fn(local.free.len(), |i, _| if i == place { 1.0 } else { 0.0 });
        let (error, reach) = spread(covariance, &unit, level);
        let little = LITTLE * local.force / local.tangents.lengths()[place];
        let p = &problem.parameters()[j];
        let small = (reach < values[j].abs() || error < little) && 2.0 * reach < p.upper - p.lower;
        spreads[j] = Some((error, reach, small));
    }
    let loose: Vec<bool> =
        (0..d).map(|j| spreads[j].map_or_else(|| !fixed(problem, j), |(_, _, small)| !small)).collect();
    let tied = |j: usize| (0..d).any(|i| loose[i] && correlation[j * d + i].abs() > TIED);
    let sides = problem.bounds().on_bound(values);
    (0..d)
        .map(|j| {
            let (p, value) = (&problem.parameters()[j], values[j]);
            let determined = !loose[j] && !tied(j);
            let at_box = (sides[j] < 0 && p.lower > p.smallest) || (sides[j] > 0 && p.upper < p.largest);
            let shown = spreads[j].filter(|_| determined && !at_box);
            Estimate {
                name: p.name.clone(),
                unit: p.unit,
                value,
                standard_error: spreads[j].map(|(error, ..)| error),
                interval: shown
                    .map(|(_, reach, _)| ((value - reach).max(p.smallest), (value + reach).min(p.largest))),
                determined,
            }
        })
        .collect()
}

/// Standard error of a combination, and half of its interval.
fn spread(covariance: &Covariance, combination: &DVector<f64>, level: f64) -> (f64, f64) {
    let (variance, freedom) = covariance.of(combination);
    let error = variance.max(0.0).sqrt();
    (error, error * student::two_sided(level, freedom))
}

/// Derived quantities by the delta method.
pub(super) fn combinations(
    local: &Local<'_>,
    covariance: &Covariance,
    derived: &Derived<'_>,
    level: f64,
) -> Vec<Estimate> {
    let values = derived.values(local.values);
    let bounds = local.problem.bounds();
    let slopes: Vec<Vec<f64>> = local
        .free
        .iter()
        .map(|&j| {
            let room = bounds.upper()[j] - bounds.lower()[j];
            let size = local.values[j].abs().max(0.01 * room);
            difference(local.values, j, size, |moved| derived.values(moved))
        })
        .collect();
    let names = derived.names(local.values).into_iter().zip(values).enumerate();
    names
        .filter(|(k, (_, value))| value.is_finite() && slopes.iter().all(|slope| slope[*k].is_finite()))
        .map(|(k, ((name, unit), value))| {
            let slope = DVector::from_fn(local.free.len(), |i, _| slopes[i][k]);
            let (error, reach) = spread(covariance, &slope, level);
            let determined = reach < value.abs();
            let meant = determined || reach < derived.size(unit, local.force);
            let interval = meant.then_some((value - reach, value + reach));
            Estimate { name, unit, value, standard_error: Some(error), interval, determined }
        })
        .collect()
}
