//! One step of the hysteretic variable, and its trace over a recording.

use super::elementary::{fma, power_lane};
use super::intervals::Plan;

/// Rate at which the hysteretic variable can change with itself, per mm, rounded up to a power of two.
///
/// The number of sub-steps follows from it. Rounded, it stays the same in wide ranges of the parameters,
/// so that the fitness is a smooth function of them but for few small jumps.
pub(crate) fn stiffness(shape: [f64; 3]) -> f64 {
    unrounded_stiffness(shape).log2().ceil().exp2()
}

/// The rate as it is.
pub(crate) fn unrounded_stiffness([rho, sigma, n]: [f64; 3]) -> f64 {
    rho * n * (2.0 * sigma - 1.0).max(1.0)
}

/// How `|w|^n` is computed. A lane's result does not depend on the choice, so that a candidate's value
/// does not depend on the others beside it.
pub(super) trait Power {
    /// `x^n` for x in [0, 2].
    fn power<const FUSED: bool>(x: f64, n: f64) -> f64;
}

/// For lanes that all have n = 1.
pub(super) struct One;
/// For lanes that all have n = 2.
pub(super) struct Two;
/// For any lanes.
pub(super) struct Any;

impl Power for One {
    #[inline(always)]
    fn power<const FUSED: bool>(x: f64, _: f64) -> f64 {
        x
    }
}

impl Power for Two {
    #[inline(always)]
    fn power<const FUSED: bool>(x: f64, _: f64) -> f64 {
        x * x
    }
}

impl Power for Any {
    #[inline(always)]
    fn power<const FUSED: bool>(x: f64, n: f64) -> f64 {
        let power = power_lane::<FUSED>(x, n);
        let power = if n == 2.0 { x * x } else { power };
        if n == 1.0 { x } else { power }
    }
}

/// Shapes side by side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shapes<const N: usize> {
    pub(super) rho: [f64; N],
    pub(super) sigma: [f64; N],
    pub(super) n: [f64; N],
}

/// `dw/dt` of the normalised Bouc-Wen law at `w + share * slope`.
#[inline(always)]
fn rate<const FUSED: bool, P: Power, const N: usize>(
    w: &[f64; N],
    (share, slope): (&[f64; N], &[f64; N]),
    v: &[f64; N],
    shapes: &Shapes<N>,
) -> [f64; N] {
    let mut out = [0.0; N];
    for l in 0..N {
        let w = fma::<FUSED>(share[l], slope[l], w[l]);
        let p = P::power::<FUSED>(w.abs().min(2.0), shapes.n[l]);
        let turn = fma::<FUSED>(shapes.sigma[l], v[l].abs().copysign(w) - v[l], v[l]);
        out[l] = shapes.rho[l] * fma::<FUSED>(-p, turn, v[l]);
    }
    out
}

/// RK4 over `h` with velocities at its beginning, halfway and at its end.
///
/// Stage by stage for all lanes: one lane after the other, the processor would wait for every result.
#[inline(always)]
pub(super) fn rk4<const FUSED: bool, P: Power, const N: usize>(
    w: &[f64; N],
    [begin, middle, end]: &[[f64; N]; 3],
    h: &[f64; N],
    shapes: &Shapes<N>,
) -> [f64; N] {
    let half = h.map(|h| 0.5 * h);
    let a = rate::<FUSED, P, N>(w, (&[0.0; N], w), begin, shapes);
    let b = rate::<FUSED, P, N>(w, (&half, &a), middle, shapes);
    let c = rate::<FUSED, P, N>(w, (&half, &b), middle, shapes);
    let d = rate::<FUSED, P, N>(w, (h, &c), end, shapes);
    let mut next = [0.0; N];
    for l in 0..N {
        next[l] = fma::<FUSED>(h[l] / 6.0, a[l] + 2.0 * (b[l] + c[l]) + d[l], w[l]);
    }
    next
}

/// The hysteretic variable at every sample, from a value at the first; infinite throughout where the samples are too
/// far apart for these parameters.
pub(crate) fn trace(plan: &Plan, shape: [f64; 3], start: f64, out: &mut [f64]) {
    let stiffness = stiffness(shape);
    if plan.too_coarse(stiffness) {
        out.fill(f64::INFINITY);
        return;
    }
    let shapes = Shapes { rho: [shape[0]], sigma: [shape[1]], n: [shape[2]] };
    let mut w = [start];
    out[0] = w[0];
    for i in 0..plan.len() {
        for interval in plan.after(i) {
            let count = (stiffness * interval.demand).ceil().max(1.0);
            for s in 0..count as usize {
                let velocity = interval.part(s as f64, count).map(|v| [v]);
                w = rk4::<false, Any, 1>(&w, &velocity, &[interval.step / count], &shapes);
            }
        }
        out[i + 1] = w[0];
    }
}
