//! What the integrator of the hysteretic variable needs of a recording, computed once.

use super::halfway::middles;
use super::interval::Interval;
use super::jumps::jumps;
use crate::spread::deviation;

/// More sub-steps than this between two samples: the samples are too far apart for the candidate.
const MOST_SUBSTEPS: f64 = 1000.0;

/// A path leaves the displacement between two samples where it does so by more than so many times the usual: 6 in
/// 10 million of normal errors.
const MISSES: f64 = 5.0;

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
    pub(crate) fn of(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Self {
        let jumps = jumps(time, displacement, velocity);
        let mut corners = jumps.iter().peekable();
        let (mut intervals, mut first) = (Vec::with_capacity(time.len()), vec![0]);
        let middles = middles(time, velocity, &jumps);
        let strays = strays(time, displacement, velocity, &middles);
        let much = MISSES * usual(&strays, &jumps);
        let spans = time.windows(2).zip(velocity.windows(2)).zip(displacement.windows(2));
        for (i, ((t, v), x)) in spans.enumerate() {
            let (step, v) = (t[1] - t[0], [v[0], v[1]]);
            let smooth = || Interval::new([v[0], middles[i], v[1]], step).pieces();
            let (before, after) = match corners.next_if(|(place, _)| *place == i) {
                Some((_, share)) => Interval::corner(v, step, *share),
                None if strays[i].abs() > much => {
                    Interval::covering(v, step, x[1] - x[0]).unwrap_or_else(smooth)
                }
                None => smooth(),
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

/// By how much a displacement changes more from sample to sample than its velocity covers, mm.
fn strays(time: &[f64], displacement: &[f64], velocity: &[f64], middles: &[f64]) -> Vec<f64> {
    let stray = |(i, middle): (usize, &f64)| {
        let [step, way] = [time, displacement].map(|series| series[i + 1] - series[i]);
        way - Interval::new([velocity[i], *middle, velocity[i + 1]], step).far()
    };
    middles.iter().enumerate().map(stray).collect()
}

/// Standard deviation of most of them, without those of jumps, mm. Where most of a motion is met but for rounding, that is
/// what is usual.
fn usual(strays: &[f64], jumps: &[(usize, f64)]) -> f64 {
    let mut smooth = strays.to_vec();
    for (i, _) in jumps {
        smooth[*i] = 0.0;
    }
    deviation(&smooth)
}

fn largest(intervals: &[Interval]) -> f64 {
    intervals.iter().map(|interval| interval.demand).fold(0.0, f64::max)
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
    fn a_path_meets_a_displacement_that_starts_at_once() {
        // Cosine ramps from rest to rest: the velocity has kinks, which no cubic has.
        let time: Vec<f64> = (0..400).map(|i| f64::from(i) / 40.0).collect();
        let (start, last) = (1.013, 0.61);
        let turn = std::f64::consts::PI / last;
        let share = |t: f64| ((t - start).rem_euclid(2.0) / last).min(1.0);
        let level = |t: f64| if ((t - start) / 2.0).floor() % 2.0 == 0.0 { 1.0 } else { -1.0 };
        let x: Vec<f64> =
            time.iter().map(|t| -2.0 * level(*t) * (std::f64::consts::PI * share(*t)).cos()).collect();
        let v: Vec<f64> =
            time.iter().map(|t| 2.0 * level(*t) * turn * (std::f64::consts::PI * share(*t)).sin()).collect();
        let off =
            |path: &[f64], way: &[f64]| path.iter().zip(way).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let way: Vec<f64> = x.iter().map(|at| at - x[0]).collect();
        let found = off(&Plan::of(&time, &x, &v).path(), &way);
        assert!(found < 1e-3, "{found}");
        // Noise of the displacement that hides the kinks stays out of the path.
        let noisy: Vec<f64> =
            x.iter().enumerate().map(|(i, x)| x + if i % 2 == 0 { 0.05 } else { -0.05 }).collect();
        let found = off(&Plan::of(&time, &noisy, &v).path(), &super::super::halfway::way(&time, &v));
        assert!(found < 1e-9, "{found}");
    }

    #[test]
    fn two_samples_are_joined_by_a_line() {
        assert_eq!(Plan::of(&[0.0, 1.0], &[0.0; 2], &[1.0, 3.0]).after(0)[0].velocity, [1.0, 2.0, 3.0]);
    }
}
