//! Squared error of the Bouc-Wen model by RK4, lanes over candidates.

use std::sync::Arc;

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::fma;
use super::hysteretic::stiffness;
use super::lanes::{LANES, Lanes};
use crate::recording::Recording;

/// A recording made ready for simulations.
#[derive(Debug, Clone)]
pub(crate) struct BoucWenRk4 {
    recording: Arc<Recording>,
    isa: Isa,
}

/// Parameters of the candidates, one lane each.
#[derive(Debug, Clone, Copy)]
struct Block {
    c0: [f64; LANES],
    kx: [f64; LANES],
    kw: [f64; LANES],
    f0: [f64; LANES],
    lanes: Lanes,
}

impl BoucWenRk4 {
    /// Prepare a recording with a force.
    pub(crate) fn new(recording: Arc<Recording>) -> Self {
        Self { recording, isa: dispatch::best() }
    }

    /// Rate that orders candidates by the cost of their simulation.
    pub(crate) fn cost(candidate: &[f64]) -> f64 {
        stiffness([candidate[3], candidate[4], candidate[5]])
    }

    /// Sums of squared errors of up to [`LANES`] candidates `[c0, kx, kw, rho, sigma, n, F0]`, one row
    /// each; infinite for a candidate that the samples are too coarse for. A candidate's value does not
    /// depend on the others.
    pub(crate) fn sums_of_squares(&self, rows: &[&[f64]], out: &mut [f64]) {
        let row = |l: usize| rows[l.min(rows.len() - 1)];
        let column = |k: usize| std::array::from_fn(|l| row(l)[k]);
        let lanes = Lanes::new(self.recording.plan(), |l| [row(l)[3], row(l)[4], row(l)[5]]);
        let block = Block { c0: column(0), kx: column(1), kw: column(2), f0: column(6), lanes };
        let sums = simulate(self.isa, self, &block);
        for (l, value) in out.iter_mut().enumerate() {
            *value = if block.lanes.hopeless[l] || !sums[l].is_finite() { f64::INFINITY } else { sums[l] };
        }
    }
}

for_every_isa!(simulate, simulate_generic, (on: &BoucWenRk4, block: &Block) -> [f64; LANES]);

#[inline(always)]
fn simulate_generic<const FUSED: bool>(on: &BoucWenRk4, block: &Block) -> [f64; LANES] {
    let mut w = [0.0; LANES];
    let mut sums = [0.0; LANES];
    let (velocity, displacement) = (on.recording.velocity(), on.recording.displacement());
    let Some(force) = on.recording.force() else { return [f64::INFINITY; LANES] };
    let (plan, scored, n) = (on.recording.plan(), on.recording.scored(), force.len());
    for i in 0..n {
        let (v0, x, f) = (velocity[i], displacement[i], force[i]);
        if scored.contains(&i) {
            for l in 0..LANES {
                let rest = fma::<FUSED>(-block.kx[l], x, fma::<FUSED>(-block.c0[l], v0, f - block.f0[l]));
                let r = fma::<FUSED>(-block.kw[l], w[l], rest);
                sums[l] = fma::<FUSED>(r, r, sums[l]);
            }
        }
        block.lanes.advance::<FUSED>(&mut w, plan.after(i));
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::example;

    /// Ordinary candidates, one with n = 1, one with n = 2, one in sub-steps, one beyond all sub-steps.
    const ROWS: [[f64; 7]; 5] = [
        [0.1, 2.0, 30.0, 0.3, 0.8, 1.7, 0.1],
        [0.1, 2.0, 30.0, 0.3, 0.6, 1.0, 0.1],
        [0.2, 1.0, 40.0, 0.2, 0.5, 2.0, 0.3],
        [0.2, 1.0, 40.0, 9.0, 1.5, 4.0, 0.3],
        [0.2, 1.0, 40.0, 1e6, 1.5, 4.0, 0.3],
    ];

    fn costs(kernel: &BoucWenRk4, rows: &[[f64; 7]]) -> Vec<f64> {
        let block: Vec<&[f64]> = rows.iter().map(<[f64; 7]>::as_slice).collect();
        let mut out = vec![0.0; rows.len()];
        kernel.sums_of_squares(&block, &mut out);
        out
    }

    #[test]
    fn every_instruction_set_gives_the_same() {
        let best = BoucWenRk4::new(example::recording());
        let on = |isa| costs(&BoucWenRk4 { isa, ..best.clone() }, &ROWS);
        let plain = on(Isa::Plain);
        for isa in dispatch::available() {
            let found = on(isa);
            let alike = |(a, b): (&f64, &f64)| a == b || (a - b).abs() <= 1e-12 * b;
            assert!(found.iter().zip(&plain).all(alike), "{isa:?}: {found:?} {plain:?}");
        }
    }

    #[test]
    fn a_value_does_not_depend_on_the_others_in_the_block() {
        let best = BoucWenRk4::new(example::recording());
        for isa in dispatch::available() {
            let kernel = BoucWenRk4 { isa, ..best.clone() };
            let alone: Vec<f64> = ROWS.iter().flat_map(|row| costs(&kernel, &[*row])).collect();
            assert_eq!(alone, costs(&kernel, &ROWS), "{isa:?}");
            assert_eq!(alone[4], f64::INFINITY);
        }
    }
}
