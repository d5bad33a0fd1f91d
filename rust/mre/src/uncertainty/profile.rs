//! Profile-likelihood intervals: a parameter is held at one value after the other, the others are
//! fitted again exactly, and the interval ends where the cost has risen too much.
//!
//! With independent noise of variance s^2 the rise that ends the interval is `t^2 s^2 / n`; correlated
//! noise makes it larger by the ratio of the sandwich variance of the parameter to the plain one.

use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::DVector;
use rayon::prelude::*;

use super::local::Local;
use super::{check_level, student};
use crate::error::Result;
use crate::fit::refit;
use crate::fitness::Problem;

/// Most fits on each side.
const FITS: usize = 40;
/// Share of an interval's half to which its end is found.
const TOLERANCE: f64 = 1e-3;

/// Interval of one parameter by its profile.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Name of the parameter.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// Value at the fit.
    pub value: f64,
    /// Lower end; `None` where the cost stays low down to the bound.
    pub low: Option<f64>,
    /// Upper end; `None` where the cost stays low up to the bound.
    pub high: Option<f64>,
    /// Values at which the others were fitted again, with their cost in N^2, in rising order.
    pub points: Vec<(f64, f64)>,
}

/// Profiles of all parameters that the box does not fix.
///
/// After `cancel` is set it ends soon, with intervals that mean nothing.
///
/// # Errors
/// As [`super::estimate`].
pub fn profile(problem: &Problem, values: &[f64], level: f64, cancel: &AtomicBool) -> Result<Vec<Profile>> {
    check_level(level)?;
    let local = Local::new(problem, values, cancel)?;
    let covariance = local.tangents.covariance(&local.noise, cancel)?;
    let best = cost(problem, values);
    (0..local.free.len())
        .into_par_iter()
        .map(|place| {
            let unit = DVector::from_fn(local.free.len(), |i, _| if i == place { 1.0 } else { 0.0 });
            let (variance, freedom) = covariance.of(&unit);
            let noise = variance / covariance.naive[(place, place)];
            let t = student::two_sided(level, freedom);
            let j = local.free[place];
            let walk = Walk { problem, j, values, best, rise: t * t * noise, cancel };
            let step = t * variance.sqrt();
            let (low, mut points) = walk.end(-step)?;
            let (high, upward) = walk.end(step)?;
            points.reverse();
            points.push((values[j], best));
            points.extend(upward);
            let p = &problem.parameters()[j];
            Ok(Profile { name: p.name.clone(), unit: p.unit, value: values[j], low, high, points })
        })
        .collect()
}

fn cost(problem: &Problem, values: &[f64]) -> f64 {
    let mut cost = [0.0];
    problem.fitness(values, &mut cost, &AtomicBool::new(false));
    cost[0]
}

/// Values and their cost.
type Points = Vec<(f64, f64)>;

/// One side of a profile.
struct Walk<'a> {
    problem: &'a Problem,
    j: usize,
    values: &'a [f64],
    best: f64,
    /// Rise of the cost that ends the interval, N^2.
    rise: f64,
    cancel: &'a AtomicBool,
}

impl Walk<'_> {
    /// Where the cost has risen enough, and the points on the way outward; the first step is as the
    /// tangents say.
    fn end(&self, step: f64) -> Result<(Option<f64>, Points)> {
        let (lower, upper) = (self.problem.bounds().lower()[self.j], self.problem.bounds().upper()[self.j]);
        let (start, wall) = (self.values[self.j], if step < 0.0 { lower } else { upper });
        let mut points = Vec::new();
        // Roots of the rise, which are nearly linear in the distance.
        let (mut inside, mut outside) = ((start, 0.0), None);
        let mut near = self.values.to_vec();
        let mut next = (start + step).clamp(lower, upper);
        for _ in 0..FITS {
            if next == inside.0 || self.cancel.load(Ordering::Relaxed) {
                break;
            }
            let pinned = self.problem.pinned(self.j, next)?;
            let found = refit(&pinned, &near, self.cancel);
            let at = cost(&pinned, &found);
            points.push((next, at));
            let root = ((at - self.best).max(0.0) / self.rise).sqrt();
            if root < 1.0 {
                (inside, near) = ((next, root), found);
                if next == wall {
                    break;
                }
            } else {
                outside = Some((next, root));
            }
            next = match outside {
                None if root < 0.1 => start + 4.0 * (inside.0 - start),
                None => start + (inside.0 - start) * (1.1 / root).min(4.0),
                Some((far, _)) if (far - inside.0).abs() <= TOLERANCE * (far - start).abs() => break,
                Some((far, above)) if above.is_finite() => {
                    // Secant, a little to the side that has not moved.
                    let share = (1.0 - inside.1) / (above - inside.1);
                    inside.0 + (far - inside.0) * share.clamp(0.05, 0.95)
                }
                Some((far, _)) => 0.5 * (inside.0 + far),
            }
            .clamp(lower, upper);
        }
        points.sort_by(|a, b| (a.0 - start).abs().total_cmp(&(b.0 - start).abs()));
        let end = outside.map(|(far, above)| {
            if above.is_finite() {
                inside.0 + (far - inside.0) * (1.0 - inside.1) / (above - inside.1)
            } else {
                inside.0
            }
        });
        Ok((end, points))
    }
}
