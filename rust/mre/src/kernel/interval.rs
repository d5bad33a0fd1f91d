//! The velocity between two samples of a motion.

use crate::physics::BOUC_WEN_STEP;

/// The mean velocity is beyond those at both ends by at most this share of the larger speed: a displacement that goes
/// further has an error.
const BEYOND: f64 = 0.25;

/// A time in which the velocity keeps its sign: from one sample to the next, or to where it turns or jumps in between.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interval {
    /// Velocities at its beginning, halfway, and at its end, mm/s.
    pub(super) velocity: [f64; 3],
    /// s.
    pub(super) step: f64,
    /// Sub-steps per unit of stiffness: largest of its three speeds times step, over the rule's limit.
    pub(super) demand: f64,
}

impl Interval {
    /// In which nothing moves.
    pub(super) const REST: Self = Self { velocity: [0.0; 3], step: 0.0, demand: 0.0 };

    pub(super) fn new(velocity: [f64; 3], step: f64) -> Self {
        let [begin, middle, end] = velocity.map(f64::abs);
        Self { velocity, step, demand: begin.max(middle).max(end) * step / BOUC_WEN_STEP }
    }

    /// Two velocities, one after the other, of which the first takes a share of the step.
    pub(super) fn corner([begin, end]: [f64; 2], step: f64, share: f64) -> (Self, Option<Self>) {
        let constant = |v: f64, share: f64| Self::new([v; 3], share * step);
        (constant(begin, share), Some(constant(end, 1.0 - share)))
    }

    /// Between these velocities so that it covers a distance in mm; where both have one sign, it keeps that if it can. `None`
    /// where no motion covers it that is only sampled coarsely.
    pub(super) fn covering([begin, end]: [f64; 2], step: f64, way: f64) -> Option<(Self, Option<Self>)> {
        let mean = way / step;
        let more = BEYOND * begin.abs().max(end.abs());
        if !(begin.min(end) - more..=begin.max(end) + more).contains(&mean) {
            return None;
        }
        // By Simpson's rule.
        let middle = 0.25 * (6.0 * mean - begin - end);
        let turns = 0.25 * (begin.abs().sqrt() - end.abs().sqrt()).powi(2);
        let share = (end - mean) / (end - begin);
        Some(
            if begin * end >= 0.0 && (begin + end).signum() * middle < turns && (0.0..=1.0).contains(&share) {
                Self::corner([begin, end], step, share)
            } else {
                Self::new([begin, middle, end], step).pieces()
            },
        )
    }

    /// Velocities at the beginning, halfway and at the end of a sub-step of so many; a single one has them to
    /// the bit.
    #[inline(always)]
    pub(super) fn part(&self, number: f64, count: f64) -> [f64; 3] {
        let [begin, middle, end] = self.velocity;
        let (whole, share) = (count <= 1.0, 1.0 / count);
        // Without a branch, so that lanes stay side by side.
        [
            if whole { begin } else { self.at(share * number) },
            if whole { middle } else { self.at(share * (number + 0.5)) },
            if whole { end } else { self.at(share * (number + 1.0)) },
        ]
    }

    /// Distance in it, mm.
    pub(super) fn far(&self) -> f64 {
        let [begin, middle, end] = self.velocity;
        self.step * (begin + 4.0 * middle + end) / 6.0
    }

    /// Velocity on the parabola through the three.
    #[inline(always)]
    fn at(&self, share: f64) -> f64 {
        let [begin, middle, end] = self.velocity;
        let bend = 4.0 * (middle - 0.5 * (begin + end));
        begin + share * (end - begin + bend * (1.0 - share))
    }

    /// Cut where the velocity turns, which the rate of the hysteretic variable feels as a kink.
    pub(super) fn pieces(self) -> (Self, Option<Self>) {
        let [begin, middle, end] = self.velocity;
        if begin * end >= 0.0 {
            return (self, None);
        }
        // Of the two roots of the parabola the one between the samples, in the form that loses no digits.
        let bend = 4.0 * (middle - 0.5 * (begin + end));
        let slope = end - begin + bend;
        let s = 2.0 * begin / (slope.mul_add(slope, 4.0 * bend * begin).sqrt().copysign(begin) - slope);
        if s > 0.0 && s < 1.0 {
            let first = Self::new([begin, self.at(0.5 * s), 0.0], s * self.step);
            let second = Self::new([0.0, self.at(0.5 * (1.0 + s)), end], (1.0 - s) * self.step);
            (first, Some(second))
        } else {
            (self, None)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_cut_where_the_velocity_turns() {
        for (root, other) in [(0.03, 2.0), (0.5, -1.0), (0.97, 30.0), (0.25, 1e9)] {
            for sign in [-1.0, 1.0] {
                let v = |s: f64| sign * (s - root) * (1.0 - s / other);
                let whole = Interval::new([v(0.0), v(0.5), v(1.0)], 2.0);
                let (first, second) = whole.pieces();
                assert!(second.is_some());
                let second = second.unwrap_or(first);
                assert!((first.step - 2.0 * root).abs() < 1e-12, "{} of {root}", first.step);
                assert!((first.step + second.step - 2.0).abs() < 1e-15);
                assert_eq!((first.velocity[2], second.velocity[0]), (0.0, 0.0));
                assert!((first.velocity[1] - v(0.5 * root)).abs() < 1e-12);
                assert!((second.velocity[1] - v(0.5 * (1.0 + root))).abs() < 1e-12);
            }
        }
        assert!(Interval::new([1.0, 0.5, 0.0], 1.0).pieces().1.is_none());
    }

    #[test]
    fn a_distance_is_covered_and_nothing_turns_back() {
        // Of a motion that begins, goes on, is quicker in between, turns, and goes over into another velocity.
        for (velocity, way) in [
            ([0.0, 4.0], 0.2),
            ([0.0, -4.0], -0.2),
            ([3.0, 4.0], 1.76),
            ([1.0, 1.0], 0.6),
            ([-3.0, 4.0], 0.4),
            ([4.0, 0.1], 0.3),
        ] {
            let found = Interval::covering(velocity, 0.5, way);
            assert!(found.is_some(), "{velocity:?}");
            let Some((before, after)) = found else { continue };
            let all = [before, after.unwrap_or(Interval::REST)];
            assert!((all.iter().map(Interval::far).sum::<f64>() - way).abs() < 1e-14, "{velocity:?}");
            let slowest = |interval: &Interval| {
                (0..=100).map(|k| way.signum() * interval.at(f64::from(k) / 100.0)).fold(f64::MAX, f64::min)
            };
            let back = all.iter().map(slowest).fold(f64::MAX, f64::min);
            assert!(velocity[0] * velocity[1] < 0.0 || back > -1e-14, "{velocity:?} {back}");
        }
        // A displacement that moves where nothing does, and one that moves back.
        for (velocity, way) in
            [([0.0, 0.0], 0.1), ([2.0, 3.0], -0.5), ([2.0, 3.0], 5.0), ([f64::NAN; 2], 1.0)]
        {
            assert!(Interval::covering(velocity, 0.5, way).is_none(), "{velocity:?}");
        }
    }
}
