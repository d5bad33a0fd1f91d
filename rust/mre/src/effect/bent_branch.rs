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
use crate::kernel::relaxation::bends;
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

impl BentBranch {
    /// Stretch of the spring, in units of the bend, after a rest of `passed` relaxation times.
    fn relaxed(self, stretch: f64, passed: f64) -> f64 {
        let left = (-passed).exp();
        match self {
            // q/sqrt(1 + q^2) falls exponentially.
            Self::Spring => {
                let lost = -(-2.0 * passed).exp_m1();
                stretch * left / (1.0 + stretch * stretch * lost).sqrt()
            }
            // So does tanh(q/2), here with what it lacks of one.
            Self::Dashpot => {
                let near = (-stretch.abs()).exp();
                let share = left * (1.0 - near) / (1.0 + near);
                let lacks = left * 2.0 * near / (1.0 + near) - (-passed).exp_m1();
                (2.0 * share / lacks).ln_1p().copysign(stretch)
            }
        }
    }

    /// Force for a stretch in units of the bend.
    fn force(self, stretch: f64) -> f64 {
        match self {
            Self::Spring => stretch * (1.0 + stretch * stretch),
            Self::Dashpot => stretch,
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

    fn plain_when_small(&self) -> bool {
        true
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let [tau, bend] = [shape[0], shape[1]];
        let (time, v) = (scene.time, scene.velocity);
        let bent = bends(time, v);
        let stretch = scene.trace(0.0, |q, i| {
            let step = time[i] - time[i - 1];
            let curved = (bent[i - 1] + bent[i]) / 24.0;
            let half = 0.5 * step / bend;
            let early = half * (0.75 * v[i - 1] + 0.25 * v[i] - curved);
            let late = half * (0.25 * v[i - 1] + 0.75 * v[i] - curved);
            let quarter = 0.25 * step / tau;
            let once = self.relaxed(self.relaxed(q, 2.0 * quarter) + early + late, 2.0 * quarter);
            let moved = self.relaxed(self.relaxed(q, quarter) + early, 2.0 * quarter);
            let twice = self.relaxed(moved + late, quarter);
            (4.0 * twice - once) / 3.0
        });
        vec![stretch.into_iter().map(|q| bend * self.force(q)).collect()]
    }
}
