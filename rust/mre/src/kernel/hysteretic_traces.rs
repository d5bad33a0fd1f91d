//! Traces of the hysteretic variable for many motions and shapes side by side, one SIMD lane each.

use rayon::prelude::*;

use super::dispatch::{self, Isa, for_every_isa};
use super::hysteretic::{Any, Shapes, rk4, stiffness};
use super::interval::Interval;
use super::intervals::Plan;

/// Most traces side by side.
const WIDE: usize = 16;
/// So few are done in half as many lanes.
const NARROW: usize = 8;

/// A motion and the shapes `[rho, sigma, n]` of one trace.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion<'a> {
    /// Times between its samples.
    pub(crate) plan: &'a Plan,
    /// Shapes.
    pub(crate) shape: [f64; 3],
    /// The hysteretic variable at the first sample.
    pub(crate) start: f64,
}

/// The hysteretic variable at every sample; infinite throughout where the samples are too far
/// apart for the shapes. A trace does not depend on the others.
pub(crate) fn traces(of: &[Motion]) -> Vec<Vec<f64>> {
    traces_on(dispatch::best(), of)
}

fn traces_on(isa: Isa, of: &[Motion]) -> Vec<Vec<f64>> {
    // Alike in length and sub-steps, a block wastes no lane.
    let mut order: Vec<usize> = (0..of.len()).collect();
    order.sort_by(|a, b| {
        let key = |i: usize| (stiffness(of[i].shape), of[i].plan.len());
        let ((s, n), (t, m)) = (key(*a), key(*b));
        s.total_cmp(&t).then(n.cmp(&m)).then(a.cmp(b))
    });
    let found: Vec<Vec<Vec<f64>>> = order
        .par_chunks(WIDE)
        .map(|places| {
            let lanes: Vec<Lane> = places.iter().map(|i| Lane::new(&of[*i])).collect();
            if lanes.len() > NARROW { wide(isa, &lanes) } else { narrow(isa, &lanes) }
        })
        .collect();
    let mut out = vec![Vec::new(); of.len()];
    for (place, trace) in order.into_iter().zip(found.into_iter().flatten()) {
        out[place] = trace;
    }
    out
}

/// One trace to be made.
struct Lane<'a> {
    shape: [f64; 3],
    start: f64,
    plan: &'a Plan,
    stiffness: f64,
    hopeless: bool,
}

impl<'a> Lane<'a> {
    fn new(&Motion { plan, shape, start }: &Motion<'a>) -> Self {
        let stiffness = stiffness(shape);
        let hopeless = plan.too_coarse(stiffness);
        Self { shape, start, plan, stiffness, hopeless }
    }

    /// Intervals from a sample to the next; none where all is done.
    #[inline(always)]
    fn after(&self, sample: usize) -> &[Interval] {
        if self.hopeless { &[] } else { self.plan.after(sample) }
    }
}

for_every_isa!(wide, simulate_wide, (lanes: &[Lane]) -> Vec<Vec<f64>>);
for_every_isa!(narrow, simulate_narrow, (lanes: &[Lane]) -> Vec<Vec<f64>>);

#[inline(always)]
fn simulate_wide<const FUSED: bool>(lanes: &[Lane]) -> Vec<Vec<f64>> {
    simulate::<FUSED, WIDE>(lanes)
}

#[inline(always)]
fn simulate_narrow<const FUSED: bool>(lanes: &[Lane]) -> Vec<Vec<f64>> {
    simulate::<FUSED, NARROW>(lanes)
}

#[inline(always)]
fn simulate<const FUSED: bool, const N: usize>(lanes: &[Lane]) -> Vec<Vec<f64>> {
    let part = |k: usize| std::array::from_fn(|l| lanes.get(l).map_or(1.0, |lane| lane.shape[k]));
    let shapes = Shapes::<N> { rho: part(0), sigma: part(1), n: part(2) };
    let longest = lanes.iter().map(|lane| lane.plan.len()).max().unwrap_or(0);
    let mut out: Vec<Vec<f64>> = lanes.iter().map(|lane| vec![lane.start; lane.plan.len() + 1]).collect();
    let mut w: [f64; N] = std::array::from_fn(|l| lanes.get(l).map_or(0.0, |lane| lane.start));
    for i in 0..longest {
        for k in 0..lanes.iter().map(|lane| lane.after(i).len()).max().unwrap_or(0) {
            // One that is done, or has nothing after its turn, stays where it is.
            let mut over = [Interval::REST; N];
            let mut count = [1.0; N];
            let mut most: f64 = 1.0;
            for (l, lane) in lanes.iter().enumerate() {
                if let Some(interval) = lane.after(i).get(k) {
                    over[l] = *interval;
                }
                count[l] = (lane.stiffness * over[l].demand).ceil().max(1.0);
                most = most.max(count[l]);
            }
            for s in 0..most as usize {
                let done = s as f64;
                let (mut velocity, mut step) = ([[0.0; N]; 3], [0.0; N]);
                for l in 0..N {
                    let [begin, middle, end] = over[l].part(done, count[l]);
                    (velocity[0][l], velocity[1][l], velocity[2][l]) = (begin, middle, end);
                    step[l] = if done < count[l] { over[l].step / count[l] } else { 0.0 };
                }
                w = rk4::<FUSED, Any, N>(&w, &velocity, &step, &shapes);
            }
        }
        for (l, trace) in out.iter_mut().enumerate() {
            if let Some(value) = trace.get_mut(i + 1) {
                *value = w[l];
            }
        }
    }
    for (trace, lane) in out.iter_mut().zip(lanes) {
        if lane.hopeless {
            trace.fill(f64::INFINITY);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::hysteretic::trace;
    use super::*;

    /// Motions of several lengths with shapes from smooth to stiff, one beyond all sub-steps.
    fn motions() -> Vec<(Plan, [f64; 3])> {
        let shapes = [
            [0.3, 0.8, 1.7],
            [0.3, 0.6, 1.0],
            [0.2, 0.5, 2.0],
            [9.0, 1.5, 4.0],
            [1e6, 1.5, 4.0],
            [2.0, 0.7, 1.3],
        ];
        (0..20_u32)
            .map(|k| {
                let n = 100 + 37 * (k as usize % 5);
                let time: Vec<f64> = (0..n).map(|i| i as f64 / (100.0 + f64::from(k % 3))).collect();
                let rate = 3.0 + f64::from(k);
                let displacement: Vec<f64> = time.iter().map(|t| 20.0 / rate * (rate * t).sin()).collect();
                let velocity: Vec<f64> = time.iter().map(|t| 20.0 * (rate * t).cos()).collect();
                (Plan::of(&time, &displacement, &velocity), shapes[k as usize % shapes.len()])
            })
            .collect()
    }

    #[test]
    fn every_lane_is_as_the_trace_alone() {
        let motions = motions();
        let jobs: Vec<Motion> = motions
            .iter()
            .map(|(plan, shape)| Motion { plan, shape: *shape, start: 0.5 - shape[1] })
            .collect();
        for isa in dispatch::available() {
            let together = traces_on(isa, &jobs);
            for (job, found) in jobs.iter().zip(&together) {
                assert_eq!(traces_on(isa, &[*job])[0], *found, "{isa:?} {:?}", job.shape);
                let mut alone = vec![0.0; job.plan.len() + 1];
                trace(job.plan, job.shape, job.start, &mut alone);
                let alike = alone.iter().zip(found).all(|(a, b)| a == b || (a - b).abs() < 1e-12);
                assert!(alike, "{isa:?} {:?}", job.shape);
            }
        }
    }
}
