//! The state of a rate-independent element over the path of a motion in one direction, from one yield to the other:
//! where its law has no other memory, all motions follow parts of it.

/// Distance between the nodes of a climb, in yield displacements.
const STEP: f64 = 0.02;
/// A state so near the yield is the yield.
const NEAR: f64 = 1e-6;
/// Most nodes on either side of the middle: where it hardly moves any more.
const MOST: usize = 20_000;
/// Newton steps, with the slope of the nodes, from a line to the state on a climb: as exact as its nodes.
const NEWTON: usize = 3;

/// The state, share of the yield force in the direction of motion, over the path, in yield displacements.
pub(crate) struct Climb {
    /// State and its slope, at equal steps of the path.
    nodes: Vec<(f64, f64)>,
}

impl Climb {
    /// The climb with a slope of the state that follows from the state; it is zero at the yield.
    pub(crate) fn new(slope: impl Fn(f64) -> f64) -> Self {
        let after = |u: f64, step: f64| {
            let a = slope(u);
            let b = slope(u + 0.5 * step * a);
            let c = slope(u + 0.5 * step * b);
            let d = slope(u + step * c);
            u + step * (a + 2.0 * b + 2.0 * c + d) / 6.0
        };
        // From the middle, where a slope may have a kink.
        let mut nodes = vec![(0.0, slope(0.0))];
        let mut u = 0.0;
        while u > -1.0 && nodes.len() < MOST {
            u = after(u, -STEP);
            nodes.push((u, slope(u)));
        }
        nodes.reverse();
        u = after(0.0, STEP);
        while u < 1.0 - NEAR && nodes.len() < 2 * MOST {
            nodes.push((u, slope(u)));
            u = after(u, STEP);
        }
        nodes.push((u.min(1.0), 0.0));
        Self { nodes }
    }

    /// A state at rest on the climb, of an element with `rho` yields in its unit of displacement.
    pub(crate) fn at_rest(&self, rho: f64) -> OnClimb<'_> {
        OnClimb { climb: self, rho, side: 1.0, at: self.path(0.0), state: 0.0 }
    }

    /// States along a displacement, from rest.
    pub(crate) fn states(&self, rho: f64, path: &[f64]) -> Vec<f64> {
        let mut on = self.at_rest(rho);
        let from = path.first().into_iter().chain(path);
        let moved = from.zip(path).map(|(from, to)| on.moved(to - from));
        moved.collect()
    }

    /// State after a path from the yield behind.
    fn state(&self, path: f64) -> f64 {
        let last = self.nodes.len() - 1;
        let far = path / STEP;
        if far >= last as f64 {
            return self.nodes[last].0;
        }
        let i = far as usize;
        let ((a, p), (b, q)) = (self.nodes[i], self.nodes[i + 1]);
        let (t, rise) = (far - i as f64, b - a);
        let (p, q) = (STEP * p, STEP * q);
        a + t * (p + t * (3.0 * rise - 2.0 * p - q + t * (p + q - 2.0 * rise)))
    }

    /// Path from the yield behind to a state.
    fn path(&self, state: f64) -> f64 {
        let i = self.nodes.partition_point(|(u, _)| *u <= state).clamp(1, self.nodes.len() - 1) - 1;
        let ((a, p), (b, q)) = (self.nodes[i], self.nodes[i + 1]);
        let (from, to) = (i as f64 * STEP, (i + 1) as f64 * STEP);
        let mut path = from + STEP * (state - a) / (b - a);
        for _ in 0..NEWTON {
            let slope = p + (q - p) * (path - from) / STEP;
            path = (path + (state - self.state(path)) / slope.max(NEAR)).clamp(from, to);
        }
        path
    }
}

/// A state that moves on a climb.
pub(crate) struct OnClimb<'c> {
    climb: &'c Climb,
    rho: f64,
    /// Direction of the motion.
    side: f64,
    /// Path from the yield behind.
    at: f64,
    state: f64,
}

impl OnClimb<'_> {
    /// The state after a displacement in one direction.
    pub(crate) fn moved(&mut self, far: f64) -> f64 {
        if far * self.side < 0.0 {
            self.side = -self.side;
            self.at = self.climb.path(self.side * self.state);
        }
        self.at += self.rho * far.abs();
        self.state = self.side * self.climb.state(self.at);
        self.state
    }

    /// Another state, of an element that yields otherwise from here on.
    pub(crate) fn set(&mut self, state: f64, rho: f64) {
        (self.state, self.rho) = (state, rho);
        self.at = self.climb.path(self.side * state);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_spring_that_yields_follows_its_closed_form() {
        // du/dp = 1 - u from rest, back by twice as much from where it turned.
        let climb = Climb::new(|u| 1.0 - u);
        let path: Vec<f64> = (0..=300).map(|i| 0.01 * f64::from(i)).collect();
        for (p, u) in path.iter().zip(climb.states(1.0, &path)) {
            assert!((u - (1.0 - (-p).exp())).abs() < 1e-7, "{p} {u}");
        }
        let turned = 1.0 - (-1.0_f64).exp();
        let back = climb.states(1.0, &[0.0, 0.5, 1.0, 0.2])[3];
        let wanted = -(1.0 - (1.0 + turned) * (-0.8_f64).exp());
        assert!((back - wanted).abs() < 1e-7, "{back} {wanted}");
    }

    #[test]
    fn a_slope_with_a_kink_in_the_middle_is_exact_on_both_sides() {
        // Bouc-Wen with n = 1: du/dp = 1 - r u below the middle and 1 - u above.
        let r = 2.0 * 0.8 - 1.0;
        let climb = Climb::new(|u| 1.0 - u.abs() * if u < 0.0 { -r } else { 1.0 });
        let down: Vec<f64> = (0..=100).map(|i| -0.01 * f64::from(i)).collect();
        let turned = climb.states(1.0, &down)[100];
        assert!((turned + 1.0 - (-1.0_f64).exp()).abs() < 1e-8, "{turned}");
        let middle = (1.0 - r * turned).ln() / r;
        let back: Vec<f64> =
            down.iter().copied().chain((1..=100).map(|i| -1.0 + 0.02 * f64::from(i))).collect();
        for (path, u) in back.iter().zip(climb.states(1.0, &back)).skip(101) {
            let far = path + 1.0 - middle;
            let wanted = if far < 0.0 { (1.0 - (-r * far).exp()) / r } else { 1.0 - (-far).exp() };
            assert!((u - wanted).abs() < 1e-8, "{path} {u} {wanted}");
        }
    }
}
