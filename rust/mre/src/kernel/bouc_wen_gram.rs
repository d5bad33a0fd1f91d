//! Inner products of the hysteretic variable with the other columns of the Bouc-Wen model, lanes over
//! candidates: all that variable projection needs of a simulation. Its traces, for derivatives.

use super::dispatch::{self, for_every_isa};
use super::elementary::fma;
use super::hysteretic::stiffness;
use super::intervals::Plan;
use super::lanes::{LANES, Lanes};
use crate::recording::Recording;

/// For every lane: the products of w with v, x, 1, F and itself over the scored samples.
pub(crate) type Products = [[f64; LANES]; 5];

/// Products of up to [`LANES`] shapes `[rho, sigma, n]`; infinite where the samples are too far apart.
pub(crate) fn products(recording: &Recording, plan: &Plan, shapes: &[[f64; 3]]) -> Products {
    let lanes = Lanes::new(plan, |l| shapes[l.min(shapes.len() - 1)]);
    let mut sums = simulate(dispatch::best(), recording, plan, &lanes);
    for l in 0..LANES {
        if lanes.hopeless[l] || sums.iter().any(|sum| !sum[l].is_finite()) {
            for sum in &mut sums {
                sum[l] = f64::INFINITY;
            }
        }
    }
    sums
}

for_every_isa!(simulate, simulate_generic, (recording: &Recording, plan: &Plan, lanes: &Lanes) -> Products);

#[inline(always)]
fn simulate_generic<const FUSED: bool>(recording: &Recording, plan: &Plan, lanes: &Lanes) -> Products {
    let (velocity, displacement) = (recording.velocity(), recording.displacement());
    let force = recording.force().unwrap_or_default();
    let scored = recording.scored();
    let mut w = [0.0; LANES];
    let mut sums = [[0.0; LANES]; 5];
    for i in 0..scored.end.min(force.len()) {
        if i >= scored.start {
            let (v, x, f) = (velocity[i], displacement[i], force[i]);
            for l in 0..LANES {
                sums[0][l] = fma::<FUSED>(w[l], v, sums[0][l]);
                sums[1][l] = fma::<FUSED>(w[l], x, sums[1][l]);
                sums[2][l] += w[l];
                sums[3][l] = fma::<FUSED>(w[l], f, sums[3][l]);
                sums[4][l] = fma::<FUSED>(w[l], w[l], sums[4][l]);
            }
        }
        lanes.advance::<FUSED>(&mut w, plan.after(i));
    }
    sums
}

/// The hysteretic variable at every sample, a lane for each of up to [`LANES`] shapes. Groups of shapes,
/// for differences within, take the sub-steps of their first: their number jumps.
pub(crate) fn traces(
    recording: &Recording,
    plan: &Plan,
    shapes: &[[f64; 3]],
    group: usize,
) -> Vec<[f64; LANES]> {
    let shapes: [[f64; 3]; LANES] = std::array::from_fn(|l| shapes[l.min(shapes.len() - 1)]);
    let lanes =
        Lanes::with_stiffness(plan, &shapes, std::array::from_fn(|l| stiffness(shapes[l - l % group])));
    let mut out = vec![[0.0; LANES]; recording.len()];
    trace(dispatch::best(), plan, &lanes, &mut out);
    out
}

for_every_isa!(trace, trace_generic, (plan: &Plan, lanes: &Lanes, out: &mut [[f64; LANES]]) -> ());

#[inline(always)]
fn trace_generic<const FUSED: bool>(plan: &Plan, lanes: &Lanes, out: &mut [[f64; LANES]]) {
    let mut w = [0.0; LANES];
    for i in 0..plan.len() {
        lanes.advance::<FUSED>(&mut w, plan.after(i));
        out[i + 1] = w;
    }
}
