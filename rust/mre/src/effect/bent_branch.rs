//! Maxwell relaxation that is not linear: the spring of a branch hardens, or its dashpot yields.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_m` | stiffness of the branch where it is hardly stretched | N/mm | >= 0 |
//! | tau | relaxation time there | s | five samples to the longest recording |
//! | `q_h` | stretch of the spring at which its force is twice that of a linear one | mm | 1 % to 300 % of the largest stroke |
//! | `q_e` | stretch of the spring whose force the dashpot yields to | mm | 1 % to 300 % of the largest stroke |
//!
//! Relaxation, in closed form, and motion in turns, half of the relaxation first and half last (Strang, SIAM J. Numer. Anal.
//! 5 (1968) 506), once and twice a step, extrapolated from both (Richardson); the motion is that of the spline through
//! the velocity.
//! Reference: Bergstrom and Boyce, J. Mech. Phys. Solids 46 (1998) 931; Eyring, J. Chem. Phys. 4 (1936) 283.
//! Known limit: under small motions it is a linear branch.

use super::maxwell::Maxwell;
use super::{About, Effect, Scene, Sizes, ideal_above, order_within, orders};
use crate::kernel::relaxation::{bends, runs};
use crate::parameter::Parameter;

/// What of a branch is not linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BentBranch {
    /// The spring hardens.
    Spring,
    /// The dashpot yields.
    Dashpot,
}

/// Values from which a fit starts, as shares of the largest stroke.
const BENDS: [f64; 2] = [0.1, 0.4];
/// Samples in the shortest relaxation time.
const SHORTEST: f64 = 5.0;

/// Motion in units of the bend that no branch keeps.
const FAR: f64 = 300.0;

/// A rest of a branch.
#[derive(Debug, Clone, Copy)]
struct Rest {
    /// Share of the invariant of the law that is left.
    left: f64,
    /// What the closed form has beside it: what is lost of the square of the invariant, or of itself where the dashpot yields.
    lost: f64,
}

/// The state of a branch is the stretch of its spring in units of the bend; where the dashpot yields, its exponential, which
/// neither a rest nor a motion needs a logarithm of.
impl BentBranch {
    fn unstretched(self) -> f64 {
        match self {
            Self::Spring => 0.0,
            Self::Dashpot => 1.0,
        }
    }

    /// A rest of so many relaxation times.
    fn rest(self, passed: f64) -> Rest {
        let times = match self {
            Self::Spring => 2.0,
            Self::Dashpot => 1.0,
        };
        Rest { left: (-passed).exp(), lost: -(-times * passed).exp_m1() }
    }

    /// The state after a rest.
    fn rested(self, state: f64, Rest { left, lost }: Rest) -> f64 {
        match self {
            // q/sqrt(1 + q^2) falls exponentially.
            Self::Spring => state * left / (1.0 + state * state * lost).sqrt(),
            // So does tanh(q/2).
            Self::Dashpot => {
                let kept = 1.0 + left;
                (state * kept + lost) / (state * lost + kept)
            }
        }
    }

    /// A motion in units of the bend, as it shifts the state.
    fn shift(self, by: f64) -> f64 {
        match self {
            Self::Spring => by,
            Self::Dashpot => by.clamp(-FAR, FAR).exp(),
        }
    }

    /// The state after a motion.
    fn shifted(self, state: f64, shift: f64) -> f64 {
        match self {
            Self::Spring => state + shift,
            Self::Dashpot => state * shift,
        }
    }

    /// The state with the stretch extrapolated from those of one step and of two.
    fn extrapolated(self, once: f64, twice: f64) -> f64 {
        match self {
            Self::Spring => (4.0 * twice - once) / 3.0,
            // The cube root of their ratio, but for its third order.
            Self::Dashpot => twice * (2.0 * twice + once) / (twice + 2.0 * once),
        }
    }

    /// Force of a state in units of the bend.
    fn force(self, state: f64) -> f64 {
        match self {
            Self::Spring => state * (1.0 + state * state),
            Self::Dashpot => state.ln(),
        }
    }
}

impl Effect for BentBranch {
    fn about(&self) -> About {
        let linear = Maxwell::One.about();
        match self {
            Self::Spring => About {
                law: "one branch, hardening spring",
                plain: "part of the stiffness relaxes with time, the faster the more it is stretched",
                equation: "F_m = k_m q (1 + (q/q_h)^2), dq/dt = v - F_m/(k_m tau)",
                reference: "Bergstrom and Boyce 1998",
                ..linear
            },
            Self::Dashpot => About {
                law: "one branch, Eyring dashpot",
                plain: "part of the stiffness relaxes with time, the faster the larger its force",
                equation: "F_m = k_m q, dq/dt = v - q_e sinh(q/q_e)/tau",
                reference: "Eyring 1936; Bergstrom and Boyce 1998",
                ..linear
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        Maxwell::One.coefficients()
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let tau = order_within("tau", "s", SHORTEST * sizes.step, sizes.duration);
        let bend = match self {
            Self::Spring => "q_h",
            Self::Dashpot => "q_e",
        };
        let x = sizes.displacement;
        vec![tau, ideal_above(order_within(bend, "mm", 0.01 * x, 3.0 * x))]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let taus = orders(SHORTEST * sizes.step, sizes.duration, 7);
        let bent = |tau: f64| BENDS.map(|share| vec![tau, share * sizes.displacement]);
        taus.into_iter().flat_map(bent).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let [tau, bend] = [shape[0], shape[1]];
        let (time, v) = (scene.time, scene.velocity);
        let bent = bends(time, v);
        let mut state = self.unstretched();
        let mut forces = vec![bend * self.force(state)];
        for (from, to) in runs(time) {
            let step = time[from] - time[from - 1];
            let (long, short) = (self.rest(0.5 * step / tau), self.rest(0.25 * step / tau));
            for i in from..to {
                let curved = (bent[i - 1] + bent[i]) / 24.0;
                let half = 0.5 * step / bend;
                let early = self.shift(half * (0.75 * v[i - 1] + 0.25 * v[i] - curved));
                let late = self.shift(half * (0.25 * v[i - 1] + 0.75 * v[i] - curved));
                let moved = self.shifted(self.shifted(self.rested(state, long), early), late);
                let once = self.rested(moved, long);
                let moved = self.rested(self.shifted(self.rested(state, short), early), long);
                let twice = self.rested(self.shifted(moved, late), short);
                state = self.extrapolated(once, twice);
                forces.push(bend * self.force(state));
            }
        }
        vec![forces]
    }
}
