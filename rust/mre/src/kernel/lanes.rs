//! Hysteretic variables of several candidates side by side, one SIMD lane each.

use super::hysteretic::{Any, One, Power, Shapes, Two, rk4, stiffness};
use super::interval::Interval;
use super::intervals::Plan;

/// Candidates simulated side by side.
pub(crate) const LANES: usize = 16;

/// Shapes of the candidates.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes {
    shapes: Shapes<LANES>,
    stiffness: [f64; LANES],
    stiffest: f64,
    /// The exponent, if all lanes have the same.
    common: Option<f64>,
    /// Lanes that cannot be simulated: their variable stays at rest.
    pub(super) hopeless: [bool; LANES],
}

impl Lanes {
    /// Up to [`LANES`] shapes `[rho, sigma, n]`; the last one fills the rest.
    pub(super) fn new(plan: &Plan, shapes: impl Fn(usize) -> [f64; 3]) -> Self {
        let shapes: [[f64; 3]; LANES] = std::array::from_fn(shapes);
        Self::with_stiffness(plan, &shapes, shapes.map(stiffness))
    }

    /// Shapes whose sub-steps follow from a given stiffness.
    pub(super) fn with_stiffness(
        plan: &Plan,
        shapes: &[[f64; 3]; LANES],
        mut stiffness: [f64; LANES],
    ) -> Self {
        let mut rho = shapes.map(|shape| shape[0]);
        let hopeless = stiffness.map(|s| plan.too_coarse(s));
        for l in 0..LANES {
            if hopeless[l] {
                (rho[l], stiffness[l]) = (0.0, 0.0);
            }
        }
        let stiffest = stiffness.iter().copied().fold(0.0, f64::max);
        let (sigma, n) = (shapes.map(|shape| shape[1]), shapes.map(|shape| shape[2]));
        let common = n.iter().all(|other| *other == n[0]).then_some(n[0]);
        Self { shapes: Shapes { rho, sigma, n }, common, stiffness, stiffest, hopeless }
    }

    /// From one sample to the next.
    #[inline(always)]
    pub(super) fn advance<const FUSED: bool>(&self, w: &mut [f64; LANES], over: &[Interval]) {
        for interval in over {
            match self.common {
                Some(1.0) => self.advance_by::<FUSED, One>(w, interval),
                Some(2.0) => self.advance_by::<FUSED, Two>(w, interval),
                _ => self.advance_by::<FUSED, Any>(w, interval),
            }
        }
    }

    #[inline(always)]
    fn advance_by<const FUSED: bool, P: Power>(&self, w: &mut [f64; LANES], over: &Interval) {
        if self.stiffest * over.demand <= 1.0 {
            let velocity = over.part(0.0, 1.0).map(|v| [v; LANES]);
            *w = rk4::<FUSED, P, LANES>(w, &velocity, &[over.step; LANES], &self.shapes);
        } else {
            self.advance_in_substeps::<FUSED, P>(w, over);
        }
    }

    /// Every lane takes the number of sub-steps it needs by itself; those that are done wait.
    #[inline(always)]
    fn advance_in_substeps<const FUSED: bool, P: Power>(&self, w: &mut [f64; LANES], over: &Interval) {
        let mut count = [1.0; LANES];
        let mut most: f64 = 1.0;
        for l in 0..LANES {
            count[l] = (self.stiffness[l] * over.demand).ceil().max(1.0);
            most = most.max(count[l]);
        }
        let step = count.map(|count| over.step / count);
        for s in 0..most as usize {
            let done = s as f64;
            let mut velocity = [[0.0; LANES]; 3];
            for l in 0..LANES {
                let [begin, middle, end] = over.part(done, count[l]);
                (velocity[0][l], velocity[1][l], velocity[2][l]) = (begin, middle, end);
            }
            let next = rk4::<FUSED, P, LANES>(w, &velocity, &step, &self.shapes);
            for l in 0..LANES {
                w[l] = if done < count[l] { next[l] } else { w[l] };
            }
        }
    }
}
