//! Squared error of the sinh model (eq. 5), sample by sample, lanes over samples.

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::{fma, sinh_lane};
use crate::physics::SINH_LARGEST;
use crate::recording::Recording;

/// Samples whose squares are added side by side: enough to hide the latency of the addition.
const LANES: usize = 32;

/// The scored samples of a recording, packed.
#[derive(Debug, Clone)]
pub(crate) struct SinhDirect {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    farthest: f64,
    isa: Isa,
}

impl SinhDirect {
    /// Pack a recording with a force.
    pub(crate) fn new(recording: &Recording) -> Self {
        let scored = recording.scored();
        let force = recording.force().unwrap_or_default();
        let displacement = recording.displacement()[scored.clone()].to_vec();
        Self {
            farthest: displacement.iter().fold(0.0, |far, x| x.abs().max(far)),
            velocity: recording.velocity()[scored.clone()].to_vec(),
            force: force[scored].to_vec(),
            displacement,
            isa: dispatch::best(),
        }
    }

    /// Sum of squared errors of `[c0, k0, alpha, beta, F0]`; infinite where sinh overflows.
    pub(crate) fn sum_of_squares(&self, x: &[f64]) -> f64 {
        let candidate = [x[0], x[1], x[2], x[3], x[4]];
        if candidate[3].abs() * self.farthest > SINH_LARGEST {
            return f64::INFINITY;
        }
        sum(self.isa, &self.displacement, &self.velocity, &self.force, candidate)
    }
}

for_every_isa!(sum, sum_generic, (x: &[f64], v: &[f64], f: &[f64], candidate: [f64; 5]) -> f64);

#[inline(always)]
fn sum_generic<const FUSED: bool>(x: &[f64], v: &[f64], f: &[f64], candidate: [f64; 5]) -> f64 {
    let n = x.len().min(v.len()).min(f.len());
    let whole = n - n % LANES;
    let mut sums = [0.0; LANES];
    for start in (0..whole).step_by(LANES) {
        let (x, v, f) = (&x[start..start + LANES], &v[start..start + LANES], &f[start..start + LANES]);
        for l in 0..LANES {
            let r = residual::<FUSED>(x[l], v[l], f[l], candidate);
            sums[l] = fma::<FUSED>(r, r, sums[l]);
        }
    }
    for i in whole..n {
        let r = residual::<FUSED>(x[i], v[i], f[i], candidate);
        sums[i - whole] = fma::<FUSED>(r, r, sums[i - whole]);
    }
    sums.iter().sum()
}

#[inline(always)]
fn residual<const FUSED: bool>(x: f64, v: f64, f: f64, [c0, k0, alpha, beta, f0]: [f64; 5]) -> f64 {
    let rest = fma::<FUSED>(-k0, x, fma::<FUSED>(-c0, v, f - f0));
    fma::<FUSED>(-alpha, sinh_lane::<FUSED>(beta * x), rest)
}
