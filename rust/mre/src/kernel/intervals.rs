//! What the integrator of the hysteretic variable needs of a recording, computed once.

use super::jumps::jumps;
use crate::physics::BOUC_WEN_STEP;
use crate::recording::Recording;

/// More sub-steps than this between two samples: the samples are too far apart for the candidate.
const MOST_SUBSTEPS: f64 = 1000.0;

/// The velocity halfway is off the straight line by at most this share of the larger speed: a cubic through
/// samples at uneven times knows no limits, and the sub-steps follow from the speeds at the samples.
const MOST_BENT: f64 = 0.25;

/// A time in which the velocity keeps its sign: from one sample to the next, or to where it turns or jumps in between.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interval {
    /// Velocities at its beginning, halfway, and at its end, mm/s.
    velocity: [f64; 3],
    /// s.
    pub(super) step: f64,
    /// Sub-steps per unit of stiffness: larger speed at the ends times step, over the rule's limit.
    pub(super) demand: f64,
}

impl Interval {
    /// In which nothing moves.
    pub(super) const REST: Self = Self { velocity: [0.0; 3], step: 0.0, demand: 0.0 };

    fn new(velocity: [f64; 3], step: f64) -> Self {
        let [begin, _, end] = velocity;
        Self { velocity, step, demand: begin.abs().max(end.abs()) * step / BOUC_WEN_STEP }
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
    fn pieces(self) -> (Self, Option<Self>) {
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

/// The times between all samples.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    intervals: Vec<Interval>,
    /// Place of the first interval after each sample.
    first: Vec<usize>,
    /// The largest demand.
    largest: f64,
}

impl Plan {
    pub(crate) fn new(recording: &Recording) -> Self {
        Self::of(recording.time(), recording.displacement(), recording.velocity())
    }

    pub(crate) fn of(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Self {
        let jumps = jumps(time, displacement, velocity);
        let mut corners = jumps.iter().peekable();
        let (mut intervals, mut first) = (Vec::with_capacity(time.len()), vec![0]);
        let middles = middles(time, velocity, &jumps);
        for (i, ((t, v), middle)) in time.windows(2).zip(velocity.windows(2)).zip(middles).enumerate() {
            let step = t[1] - t[0];
            let (before, after) = match corners.next_if(|(place, _)| *place == i) {
                Some((_, share)) => {
                    let constant = |v: f64, share: f64| Interval::new([v; 3], share * step);
                    (constant(v[0], *share), Some(constant(v[1], 1.0 - share)))
                }
                None => Interval::new([v[0], middle, v[1]], step).pieces(),
            };
            intervals.push(before);
            intervals.extend(after);
            first.push(intervals.len());
        }
        Self { largest: largest(&intervals), intervals, first }
    }

    /// A plan with a quarter of the sub-steps: for a first look. RK4 stays stable.
    pub(crate) fn rough(&self) -> Self {
        let fewer = |interval: &Interval| Interval { demand: 0.25 * interval.demand, ..*interval };
        let intervals: Vec<Interval> = self.intervals.iter().map(fewer).collect();
        Self { largest: largest(&intervals), intervals, first: self.first.clone() }
    }

    /// Way from the first sample to every one, mm.
    pub(crate) fn path(&self) -> Vec<f64> {
        let ways = (0..self.len()).scan(0.0, |way, i| {
            *way += self.after(i).iter().map(Interval::far).sum::<f64>();
            Some(*way)
        });
        std::iter::once(0.0).chain(ways).collect()
    }

    /// Times between samples.
    pub(super) fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// The intervals from a sample to the next, of which there are one or two; none after the last.
    #[inline(always)]
    pub(super) fn after(&self, sample: usize) -> &[Interval] {
        match self.first.get(sample + 1) {
            Some(end) => &self.intervals[self.first[sample]..*end],
            None => &[],
        }
    }

    /// True where a candidate of this stiffness would need too many sub-steps.
    pub(super) fn too_coarse(&self, stiffness: f64) -> bool {
        let substeps = stiffness * self.largest;
        substeps.is_nan() || substeps > MOST_SUBSTEPS
    }
}

fn largest(intervals: &[Interval]) -> f64 {
    intervals.iter().map(|interval| interval.demand).fold(0.0, f64::max)
}

/// Way of a velocity without corners from the first sample to every one, mm.
pub(crate) fn way(time: &[f64], velocity: &[f64]) -> Vec<f64> {
    let spans = time.windows(2).zip(velocity.windows(2)).zip(middles(time, velocity, &[]));
    let ways = spans.scan(0.0, |way, ((t, v), middle)| {
        *way += (t[1] - t[0]) * (v[0] + 4.0 * middle + v[1]) / 6.0;
        Some(*way)
    });
    std::iter::once(0.0).chain(ways).collect()
}

/// Velocity halfway between samples: the mean of the parabolas through the sample before and the one after, which at
/// even times is the cubic through all four; one parabola at the ends and beside jumps. Where it jumps between two samples,
/// the velocity there.
///
/// On the straight line between two samples, with 22 samples a cycle, the path would be 0.7 % short: more than
/// the noise of a good recording.
pub(crate) fn middles(time: &[f64], velocity: &[f64], jumps: &[(usize, f64)]) -> Vec<f64> {
    let Some(spans) = time.len().checked_sub(1) else { return Vec::new() };
    let slopes: Vec<f64> =
        time.windows(2).zip(velocity.windows(2)).map(|(t, v)| (v[1] - v[0]) / (t[1] - t[0])).collect();
    // Half the second derivative at a sample; at an end that of the next.
    let mut bends = vec![0.0; spans + 1];
    for ((bend, slope), t) in bends.iter_mut().skip(1).zip(slopes.windows(2)).zip(time.windows(3)) {
        *bend = (slope[1] - slope[0]) / (t[2] - t[0]);
    }
    for (i, _) in jumps {
        bends[*i..=i + 1].fill(f64::NAN);
    }
    if spans > 1 {
        (bends[0], bends[spans]) = (bends[1], bends[spans - 1]);
    }
    let bent = |ends: &[f64]| match [ends[0], ends[1]] {
        [a, b] if a.is_nan() && b.is_nan() => 0.0,
        [a, b] if a.is_nan() => b,
        [a, b] if b.is_nan() => a,
        [a, b] => 0.5 * (a + b),
    };
    let ends = time.windows(2).zip(velocity.windows(2)).zip(bends.windows(2));
    let middle = ends.map(|((t, v), bend)| {
        let h = t[1] - t[0];
        let most = MOST_BENT * v[0].abs().max(v[1].abs());
        // No clamp: it panics where a diverged motion is not a number.
        0.5 * (v[0] + v[1]) - (0.25 * h * h * bent(bend)).max(-most).min(most)
    });
    let mut middle: Vec<f64> = middle.collect();
    for (i, share) in jumps {
        middle[*i] = velocity[if *share < 0.5 { i + 1 } else { *i }];
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_number_stays_none() {
        let lost = Plan::of(&[0.0, 1.0, 2.0, 3.0], &[0.0; 4], &[f64::NAN; 4]);
        assert!(lost.after(1).iter().all(|interval| interval.part(0.0, 1.0).iter().all(|v| v.is_nan())));
    }

    #[test]
    fn a_cubic_is_met_halfway_and_a_parabola_in_sub_steps() {
        let time: Vec<f64> = (0..12).map(|i| f64::from(i) / 10.0).collect();
        let cubic = |t: f64| 1.0 + 2.0 * t - 3.0 * t * t + 0.5 * t * t * t;
        let velocity: Vec<f64> = time.iter().map(|t| cubic(*t)).collect();
        let plan = Plan::of(&time, &[0.0; 12], &velocity);
        assert_eq!(plan.len(), 11);
        for (i, t) in time.iter().enumerate().take(10).skip(1) {
            assert!((plan.after(i)[0].velocity[1] - cubic(t + 0.05)).abs() < 1e-12);
        }
        let uneven = [0.0, 0.1, 0.25, 0.3, 0.5];
        let square = |t: f64| t * t + 0.3 * t + 0.1;
        let plan = Plan::of(&uneven, &[0.0; 5], &uneven.map(square));
        for (i, t) in uneven.windows(2).enumerate() {
            let interval = plan.after(i)[0];
            let at = |share: f64| square(t[0] + share * (t[1] - t[0]));
            assert!((interval.velocity[1] - at(0.5)).abs() < 1e-14);
            let [begin, middle, end] = interval.part(1.0, 3.0);
            let away = (begin - at(1.0 / 3.0)).abs() + (middle - at(0.5)).abs() + (end - at(2.0 / 3.0)).abs();
            assert!(away < 1e-14, "{away}");
        }
    }

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
        let plan = Plan::of(&[0.0, 1.0, 2.0], &[0.0; 3], &[1.0, -1.0, -2.0]);
        assert_eq!((plan.after(0).len(), plan.after(1).len(), plan.after(2).len()), (2, 1, 0));
    }

    #[test]
    fn a_path_with_corners_is_met() {
        let time: Vec<f64> = (0..40).map(|i| f64::from(i) / 10.0).collect();
        let (corner, again) = (1.234, 2.5);
        let x = |t: f64| t.min(corner) - (t.min(again) - corner).max(0.0) + 0.5 * (t - again).max(0.0);
        let v = |t: f64| {
            if t < corner {
                1.0
            } else if t < again {
                -1.0
            } else {
                0.5
            }
        };
        let (displacement, velocity): (Vec<f64>, Vec<f64>) = time.iter().map(|t| (x(*t), v(*t))).unzip();
        let plan = Plan::of(&time, &displacement, &velocity);
        for (at, wanted) in plan.path().iter().zip(&displacement) {
            assert!((at - wanted).abs() < 1e-12, "{at} of {wanted}");
        }
        let farthest = plan.after(12).first().map_or(0.0, Interval::far) + displacement[12];
        assert!((farthest - corner).abs() < 1e-12);
    }

    #[test]
    fn two_samples_are_joined_by_a_line() {
        assert_eq!(Plan::of(&[0.0, 1.0], &[0.0; 2], &[1.0, 3.0]).after(0)[0].velocity, [1.0, 2.0, 3.0]);
    }
}
