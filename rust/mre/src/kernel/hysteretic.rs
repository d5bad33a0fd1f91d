//! One step of the hysteretic variable, and its trace over a recording.

use super::elementary::{fma, power_lane};
use crate::physics::BOUC_WEN_STEP;
use crate::recording::Recording;

/// More sub-steps than this between two samples: the samples are too far apart for the candidate.
const MOST_SUBSTEPS: f64 = 1000.0;

/// What the integrator needs of a recording, computed once.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    /// Time to the next sample, s.
    pub(crate) step: Vec<f64>,
    /// Sub-steps to the next sample per unit of stiffness: larger speed times step, over the rule's limit.
    pub(crate) demand: Vec<f64>,
    /// The largest of them.
    pub(crate) largest: f64,
}

impl Plan {
    pub(crate) fn new(recording: &Recording) -> Self {
        Self::of(recording.time(), recording.velocity())
    }

    fn of(time: &[f64], velocity: &[f64]) -> Self {
        let step: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let demand: Vec<f64> = velocity
            .windows(2)
            .zip(&step)
            .map(|(pair, step)| pair[0].abs().max(pair[1].abs()) * step / BOUC_WEN_STEP)
            .collect();
        let largest = demand.iter().copied().fold(0.0, f64::max);
        Self { step, demand, largest }
    }

    /// True where a candidate of this stiffness would need too many sub-steps.
    pub(super) fn too_coarse(&self, stiffness: f64) -> bool {
        let substeps = stiffness * self.largest;
        substeps.is_nan() || substeps > MOST_SUBSTEPS
    }
}

/// Rate at which the hysteretic variable can change with itself, per mm, rounded up to a power of two.
///
/// The number of sub-steps follows from it. Rounded, it stays the same in wide ranges of the parameters,
/// so that the fitness is a smooth function of them but for few small jumps.
pub(crate) fn stiffness([rho, sigma, n]: [f64; 3]) -> f64 {
    (rho * n * (2.0 * sigma - 1.0).max(1.0)).log2().ceil().exp2()
}

/// `dw/dt` of the normalised Bouc-Wen law.
#[inline(always)]
fn rate<const FUSED: bool>(w: f64, v: f64, [rho, sigma, n]: [f64; 3]) -> f64 {
    let p = power_lane::<FUSED>(w.abs().min(2.0), n);
    let turn = fma::<FUSED>(sigma, v.abs().copysign(w) - v, v);
    rho * fma::<FUSED>(-p, turn, v)
}

/// RK4 over `h` with a velocity that goes linearly from `v0` to `v1`.
#[inline(always)]
pub(super) fn rk4<const FUSED: bool>(w: f64, v0: f64, v1: f64, h: f64, shape: [f64; 3]) -> f64 {
    let middle = 0.5 * (v0 + v1);
    let half = 0.5 * h;
    let a = rate::<FUSED>(w, v0, shape);
    let b = rate::<FUSED>(fma::<FUSED>(half, a, w), middle, shape);
    let c = rate::<FUSED>(fma::<FUSED>(half, b, w), middle, shape);
    let d = rate::<FUSED>(fma::<FUSED>(h, c, w), v1, shape);
    fma::<FUSED>(h / 6.0, a + 2.0 * (b + c) + d, w)
}

/// The hysteretic variable at every sample, from rest; infinite throughout where the samples are too
/// far apart for these parameters.
pub(crate) fn trace(time: &[f64], velocity: &[f64], shape: [f64; 3], out: &mut [f64]) {
    let plan = Plan::of(time, velocity);
    let stiffness = stiffness(shape);
    if plan.too_coarse(stiffness) {
        out.fill(f64::INFINITY);
        return;
    }
    let mut w = 0.0;
    out[0] = w;
    for i in 0..plan.step.len() {
        let (v0, v1) = (velocity[i], velocity[i + 1]);
        let count = (stiffness * plan.demand[i]).ceil().max(1.0);
        let (h, dv) = (plan.step[i] / count, (v1 - v0) / count);
        for s in 0..count as usize {
            let start = v0 + dv * s as f64;
            w = rk4::<false>(w, start, start + dv, h, shape);
        }
        out[i + 1] = w;
    }
}
