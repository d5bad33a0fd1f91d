//! Intervals of fitted parameters, from the curvature of the whitened sum of squares.

use nalgebra::DMatrix;

use super::least_squares::Data;
use super::point::Point;
use crate::assembly::Assembly;
use crate::parameter::{Parameter, Scale};

/// Share of a box by which a parameter is moved off its end to see what that costs.
const INWARD: f64 = 0.1;

/// Added to the squares of columns of length one.
const RIDGE: f64 = 1e-12;
/// A column of length one whose variance is inflated by more is those of others (an offset of every recording beside one of
/// them all): nothing but the ridge holds its coefficient.
const REDUNDANT: f64 = 0.01 / RIDGE;

/// 95 % of a normal variable lie within so many standard deviations.
const WIDTH: f64 = 1.959_963_984_540_054;

/// A fitted parameter with its 95 % interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Symbol.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// Value.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end; infinite ends mean that the recordings do not determine the parameter.
    pub high: f64,
    /// True where it lies on an end of its box that is no ideal of its law, and the recordings press it there.
    pub at_an_end: bool,
    /// True where it stands at a limit of what is physical that the recordings would plainly have it pass.
    pub pressed: bool,
}

/// Coefficients and shapes with their intervals.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimates {
    /// In the order of [`Assembly::coefficients`].
    pub coefficients: Vec<Estimate>,
    /// In the order of [`Assembly::shapes`].
    pub shapes: Vec<Estimate>,
}

/// Intervals at a fitted point of the unit box.
pub(super) fn estimates(assembly: &Assembly, data: Data, unit: &[f64]) -> Estimates {
    let point = Point::at(assembly, data, unit.to_vec());
    let fitted = point.fitted.clone();
    let system = point.with_tangents(assembly, data);
    let count = system.right.len();
    let scale: Vec<f64> = (0..count)
        .map(|i| if system.gram[(i, i)] > 0.0 { system.gram[(i, i)].sqrt() } else { 0.0 })
        .collect();
    let matrix = DMatrix::from_fn(count, count, |i, j| {
        let size = scale[i] * scale[j];
        let own = if i == j { RIDGE } else { 0.0 };
        if size > 0.0 { system.gram[(i, j)] / size + own } else { f64::from(u8::from(i == j)) }
    });
    let inverse = matrix.try_inverse();
    let deviation = |i: usize| match &inverse {
        Some(inverse) if scale[i] > 0.0 && inverse[(i, i)] < REDUNDANT => {
            inverse[(i, i)].max(0.0).sqrt() / scale[i]
        }
        _ => f64::INFINITY,
    };
    let pressed =
        |i: usize, p: &Parameter, value: f64| p.is_pressed(value, system.right[i], system.gram[(i, i)]);
    let coefficients: Vec<Estimate> = assembly
        .coefficients()
        .into_iter()
        .zip(&fitted.coefficients)
        .enumerate()
        .map(|(i, (p, value))| {
            let half = WIDTH * deviation(i);
            let (low, high) = ((value - half).max(p.smallest), (value + half).min(p.largest));
            let pressed = pressed(i, &p, *value);
            Estimate { name: p.name, unit: p.unit, value: *value, low, high, at_an_end: false, pressed }
        })
        .collect();
    let first = coefficients.len();
    let shapes = assembly
        .shapes()
        .iter()
        .zip(assembly.physical(unit))
        .enumerate()
        .map(|(j, (p, value))| {
            let half = WIDTH * deviation(first + j);
            let at_box = [p.lower, p.upper].contains(&value) && ![p.smallest, p.largest].contains(&value);
            // Wider than its box, or where only the box ends it, a parameter is not determined.
            let half = if half < 1.0 && !at_box { half } else { f64::INFINITY };
            let (low, high) = match p.scale {
                Scale::Linear => {
                    let half = half * (p.upper - p.lower);
                    (value - half, value + half)
                }
                Scale::Log => {
                    let factor = (half * (p.upper / p.lower).ln()).exp();
                    (value / factor, value * factor)
                }
            };
            // Outwards the sum of squares falls at this rate.
            let outward = match unit[j] {
                u if u <= 0.0 && !p.ideal.lower => Some(-system.right[first + j]),
                u if u >= 1.0 && !p.ideal.upper => Some(system.right[first + j]),
                _ => None,
            };
            let pressed = pressed(first + j, p, value);
            let deviation = deviation(first + j);
            let cost = |slope: f64| 2.0 * INWARD * slope.max(0.0) + (INWARD / deviation).powi(2);
            let at_an_end = outward.is_some_and(|slope| deviation > 0.0 && cost(slope) > WIDTH.powi(2));
            let low = low.max(p.smallest);
            Estimate { name: p.name.clone(), unit: p.unit, value, low, high, at_an_end, pressed }
        })
        .collect();
    Estimates { coefficients, shapes }
}
