//! Global optimum of the sinh problem: a walk along the whole interval of beta with the linear
//! coefficients projected out, then the root of the slope in every valley.

use super::sinh_curve::{Curve, Point};
use crate::fitness::Problem;

/// Points of the walk for every e-fold of 1 + b: the shape of sinh(b t) changes in steps of b where b
/// is small, and in ratios where it is large.
const DENSITY: f64 = 24.0;
/// Halvings of an interval whose ends tell of a hidden valley.
const DEPTH: u32 = 5;
/// Most steps to the root of the slope.
const STEPS: usize = 50;

/// Parameters in the order of the problem, and the number of points on the way.
pub(super) fn optimum(problem: &Problem) -> (Vec<f64>, u64) {
    let curve = Curve::new(problem);
    let grid = grid(problem, &curve);
    let mut walk = Walk { curve: &curve, best: None, evaluations: 0 };
    let mut left: Option<Point> = None;
    for b in grid {
        let right = walk.visit(b);
        if let Some(left) = &left {
            walk.cell(left, &right, DEPTH);
        }
        left = Some(right);
    }
    let Walk { best, evaluations, .. } = walk;
    let values = best.map_or_else(|| problem.bounds().lower().to_vec(), |best| curve.values(&best));
    (values, evaluations)
}

/// Points that cover the interval of `b = beta xm`, ends included.
pub(super) fn grid(problem: &Problem, curve: &Curve<'_>) -> Vec<f64> {
    let low = problem.bounds().lower()[3] * curve.farthest;
    let high = problem.bounds().upper()[3] * curve.farthest;
    let (first, last) = (low.ln_1p(), high.ln_1p());
    let count = ((last - first) * DENSITY).ceil().max(8.0);
    let inner = (1..count as usize).map(|i| (first + (last - first) * i as f64 / count).exp_m1());
    std::iter::once(low).chain(inner).chain(std::iter::once(high)).collect()
}

struct Walk<'a> {
    curve: &'a Curve<'a>,
    best: Option<Point>,
    evaluations: u64,
}

impl Walk<'_> {
    fn visit(&mut self, b: f64) -> Point {
        let point = self.curve.point(b);
        self.evaluations += 1;
        if self.best.as_ref().is_none_or(|best| point.cost < best.cost) {
            self.best = Some(point.clone());
        }
        point
    }

    /// Find the valleys between two points.
    fn cell(&mut self, left: &Point, right: &Point, depth: u32) {
        if left.slope < 0.0 && right.slope > 0.0 {
            self.descend(left.clone(), right.clone());
        } else if depth > 0 && left.slope * right.slope > 0.0 && hides_valley(left, right) {
            let middle = self.visit(0.5 * (left.b + right.b));
            self.cell(left, &middle, depth - 1);
            self.cell(&middle, right, depth - 1);
        }
    }

    /// Root of the slope: false position (Illinois), bisection where it is slow.
    fn descend(&mut self, mut left: Point, mut right: Point) {
        let (mut down, mut up) = (left.slope, right.slope);
        let mut moved = 0; // the end that moved last: the slope of the other is halved the next time
        for step in 0..STEPS {
            let width = right.b - left.b;
            let mut b = (left.b * up - right.b * down) / (up - down);
            if step % 4 == 3 || !(b > left.b && b < right.b) {
                b = left.b + 0.5 * width;
            }
            if b <= left.b || b >= right.b {
                return;
            }
            let point = self.visit(b);
            // What is left to gain, far below the digits of the cost.
            if point.slope.abs() * width <= 1e-20 * point.cost {
                return;
            }
            if point.slope < 0.0 {
                up *= if moved < 0 { 0.5 } else { 1.0 };
                (down, left, moved) = (point.slope, point, -1);
            } else {
                down *= if moved > 0 { 0.5 } else { 1.0 };
                (up, right, moved) = (point.slope, point, 1);
            }
        }
    }
}

/// True where the cubic through both ends, with their slopes of one sign, turns between them.
fn hides_valley(left: &Point, right: &Point) -> bool {
    let width = right.b - left.b;
    let (m0, m1, rise) = (left.slope * width, right.slope * width, right.cost - left.cost);
    let (a, b) = (3.0 * (m0 + m1) - 6.0 * rise, 6.0 * rise - 4.0 * m0 - 2.0 * m1);
    let turn = -b / (2.0 * a);
    turn > 0.0 && turn < 1.0 && (m0 - 0.25 * b * b / a) * m0 < 0.0
}
