//! Squared error of the Bouc-Wen model by RK4, lanes over candidates.

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::fma;
use super::hysteretic::{Plan, rk4, stiffness};
use std::sync::Arc;

use crate::recording::Recording;

/// Candidates simulated side by side.
pub(crate) const LANES: usize = 16;

/// A recording made ready for simulations.
#[derive(Debug, Clone)]
pub(crate) struct BoucWenRk4 {
    plan: Plan,
    recording: Arc<Recording>,
    isa: Isa,
}

/// Parameters of the candidates, one lane each.
#[derive(Debug, Clone, Copy)]
struct Block {
    c0: [f64; LANES],
    kx: [f64; LANES],
    kw: [f64; LANES],
    rho: [f64; LANES],
    sigma: [f64; LANES],
    n: [f64; LANES],
    f0: [f64; LANES],
    stiffness: [f64; LANES],
}

impl BoucWenRk4 {
    /// Prepare a recording with a force.
    pub(crate) fn new(recording: Arc<Recording>) -> Self {
        Self { plan: Plan::new(&recording), recording, isa: dispatch::best() }
    }

    /// Rate that orders candidates by the cost of their simulation.
    pub(crate) fn cost(candidate: &[f64]) -> f64 {
        stiffness([candidate[3], candidate[4], candidate[5]])
    }

    /// Sums of squared errors of up to [`LANES`] candidates `[c0, kx, kw, rho, sigma, n, F0]`, one row
    /// each; infinite for a candidate that the samples are too coarse for. A candidate's value does not
    /// depend on the others.
    pub(crate) fn sums_of_squares(&self, rows: &[&[f64]], out: &mut [f64]) {
        let column = |k: usize| std::array::from_fn(|l| rows[l.min(rows.len() - 1)][k]);
        let mut block = Block {
            c0: column(0),
            kx: column(1),
            kw: column(2),
            rho: column(3),
            sigma: column(4),
            n: column(5),
            f0: column(6),
            stiffness: std::array::from_fn(|l| Self::cost(rows[l.min(rows.len() - 1)])),
        };
        let hopeless = block.stiffness.map(|s| self.plan.too_coarse(s));
        for l in 0..LANES {
            if hopeless[l] {
                (block.rho[l], block.stiffness[l]) = (0.0, 0.0);
            }
        }
        let sums = simulate(self.isa, self, &block);
        for (l, value) in out.iter_mut().enumerate() {
            *value = if hopeless[l] || !sums[l].is_finite() { f64::INFINITY } else { sums[l] };
        }
    }
}

for_every_isa!(simulate, simulate_generic, (on: &BoucWenRk4, block: &Block) -> [f64; LANES]);

#[inline(always)]
fn simulate_generic<const FUSED: bool>(on: &BoucWenRk4, block: &Block) -> [f64; LANES] {
    let stiffest = block.stiffness.iter().copied().fold(0.0, f64::max);
    let mut w = [0.0; LANES];
    let mut sums = [0.0; LANES];
    let (velocity, displacement) = (on.recording.velocity(), on.recording.displacement());
    let Some(force) = on.recording.force() else { return [f64::INFINITY; LANES] };
    let (scored, n) = (on.recording.scored(), force.len());
    for i in 0..n {
        let (v0, x, f) = (velocity[i], displacement[i], force[i]);
        if scored.contains(&i) {
            for l in 0..LANES {
                let rest = fma::<FUSED>(-block.kx[l], x, fma::<FUSED>(-block.c0[l], v0, f - block.f0[l]));
                let r = fma::<FUSED>(-block.kw[l], w[l], rest);
                sums[l] = fma::<FUSED>(r, r, sums[l]);
            }
        }
        if i + 1 == n {
            break;
        }
        let (v1, h, demand) = (velocity[i + 1], on.plan.step[i], on.plan.demand[i]);
        if stiffest * demand <= 1.0 {
            for l in 0..LANES {
                w[l] = rk4::<FUSED>(w[l], v0, v1, h, [block.rho[l], block.sigma[l], block.n[l]]);
            }
        } else {
            substeps::<FUSED>(block, &mut w, (v0, v1), h, demand);
        }
    }
    sums
}

/// Every lane takes the number of sub-steps it needs by itself; those that are done wait.
#[inline(always)]
fn substeps<const FUSED: bool>(
    block: &Block,
    w: &mut [f64; LANES],
    (v0, v1): (f64, f64),
    h: f64,
    demand: f64,
) {
    let mut count = [1.0; LANES];
    let mut most: f64 = 1.0;
    for l in 0..LANES {
        count[l] = (block.stiffness[l] * demand).ceil().max(1.0);
        most = most.max(count[l]);
    }
    for s in 0..most as usize {
        let done = s as f64;
        for l in 0..LANES {
            let dv = (v1 - v0) / count[l];
            let start = v0 + dv * done;
            let next = rk4::<FUSED>(
                w[l],
                start,
                start + dv,
                h / count[l],
                [block.rho[l], block.sigma[l], block.n[l]],
            );
            w[l] = if done < count[l] { next } else { w[l] };
        }
    }
}
