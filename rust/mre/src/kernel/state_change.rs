//! The hysteretic variable of a Bouc-Wen device whose state follows its motion otherwise: it slips, wears, or yields at a
//! displacement that follows the current.
//!
//! `dw/dt = rho h (v - nu (sigma |v| |w|^(n-1) w - (sigma - 1) v |w|^n)) / eta` with a slip `h`, `nu = 1 + strength e`,
//! `eta = 1 + stiffness e`, `e` the integral of `w v`, not below zero; a slip sees the state over its yield, which falls with
//! nu. Source: Baber and Wen 1981, Baber and Noori 1986.
//! The law has no rate: the state follows a [`Climb`] over the path, on which it is told by its yield. The path is that of
//! the velocity, as for the plain law, and turns where it does; the displacement only tells the place.

use std::f64::consts::PI;

use super::climb::Climb;
use super::elementary::erf;
use super::intervals::Plan;
use crate::recording::Condition;

/// What is changed of the law of a state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StateChange {
    /// Where it slips: of two, the later.
    pub slip: Option<Slip>,
    /// How it wears.
    pub wear: Wear,
    /// How its rate follows the current.
    pub pace: Option<Pace>,
}

impl StateChange {
    /// Both together.
    pub(crate) fn and(self, other: Self) -> Self {
        let wear = Wear {
            strength: self.wear.strength + other.wear.strength,
            stiffness: self.wear.stiffness + other.wear.stiffness,
        };
        Self { slip: other.slip.or(self.slip), wear, pace: other.pace.or(self.pace) }
    }
}

/// By how much the law of a state changes with what it dissipates, the integral of `w v`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wear {
    /// Growth of nu, 1/mm: the force at yield falls.
    pub strength: f64,
    /// Growth of eta, 1/mm: the displacement at yield grows.
    pub stiffness: f64,
}

/// rho as an affine function of the current.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// Lowest current, A.
    pub low: f64,
    /// Highest less lowest current, A.
    pub span: f64,
    /// rho at the highest current, over that at the lowest.
    pub ratio: f64,
}

impl Pace {
    /// rho at every sample, over that at the lowest current. Outside the levels the nearest holds.
    pub(crate) fn under(self, current: &Condition, samples: usize) -> Vec<f64> {
        let at = |i: f64| 1.0 + (self.ratio - 1.0) * ((i - self.low) / self.span).clamp(0.0, 1.0);
        match current {
            Condition::Missing => vec![1.0; samples],
            Condition::Constant(i) => vec![at(*i); samples],
            Condition::Series(all) => all.iter().map(|i| at(*i)).collect(),
        }
    }
}

/// Where a state slips; the share of its rate that is left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Slip {
    /// Near a force against or with the motion: `1 - depth exp(-((w sgn v - place) / width)^2)`.
    ByForce {
        /// Share that is lost.
        depth: f64,
        /// Share of the yield force.
        width: f64,
        /// Share of the yield force.
        place: f64,
    },
    /// Near the middle position: `1 - depth exp(-(x / width)^2)`.
    ByPlace {
        /// Share that is lost.
        depth: f64,
        /// mm.
        width: f64,
    },
}

impl Slip {
    /// Share of the rate at a state in the direction of motion.
    pub(crate) fn at(self, u: f64) -> f64 {
        match self {
            Self::ByForce { depth, width, place } => 1.0 - depth * (-((u - place) / width).powi(2)).exp(),
            Self::ByPlace { .. } => 1.0,
        }
    }

    /// How far the state takes a motion to go that starts at a place, mm.
    fn felt(self, from: f64, far: f64) -> f64 {
        let Self::ByPlace { depth, width } = self else { return far };
        let lost = |x: f64| depth * width * 0.5 * PI.sqrt() * erf(x / width);
        far - (lost(from + far) - lost(from))
    }
}

/// The hysteretic variable at every sample, from rest, for shapes `[rho, sigma, n]` under a current.
pub(crate) fn trace(
    (plan, x): (&Plan, &[f64]),
    current: &Condition,
    [rho, sigma, n]: [f64; 3],
    StateChange { slip, wear, pace }: StateChange,
) -> Vec<f64> {
    let pace = pace.map(|pace| pace.under(current, x.len()));
    let bare = |u: f64| 1.0 - u.abs().powf(n) * (1.0 + sigma * (u.signum() - 1.0));
    let climb = Climb::new(|u| bare(u) * slip.map_or(1.0, |slip| slip.at(u)));
    let felt = |from: f64, far: f64| slip.map_or(far, |slip| slip.felt(from, far));
    let mut on = climb.at_rest(rho);
    let (mut w, mut dissipated) = (0.0, 0.0);
    let mut go = |from: f64, far: f64, pace: f64| {
        if wear == Wear::default() {
            w = on.moved(pace * felt(from, far));
            return w;
        }
        let halfway = (dissipated + 0.5 * w * far).max(0.0);
        let yields = (1.0 + wear.strength * halfway).powf(-1.0 / n);
        let rho = rho / (yields * (1.0 + wear.stiffness * halfway));
        let state: f64 = w / yields;
        let within = state.clamp(-1.0, 1.0);
        // A yield that fell leaves the state beyond it, to which it comes back.
        let beyond = (state - within) * (-n * rho * pace * far.abs()).exp();
        on.set(within, rho);
        let next = yields * (on.moved(pace * felt(from, far)) + beyond);
        dissipated = (dissipated + 0.5 * (w + next) * far).max(0.0);
        w = next;
        w
    };
    let mut found = Vec::with_capacity(x.len());
    found.push(0.0);
    for i in 0..plan.len() {
        let (mut at, mut state) = (x[i], found[i]);
        let pace = pace.as_ref().map_or(1.0, |pace| 0.5 * (pace[i] + pace[i + 1]));
        for interval in plan.after(i) {
            let far = interval.far();
            state = go(at, far, pace);
            at += far;
        }
        found.push(state);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::hysteretic;
    use super::*;

    /// A motion of two sines.
    fn motion(rate: f64) -> [Vec<f64>; 3] {
        let time: Vec<f64> = (0..1200).map(|i| f64::from(i) / rate).collect();
        let x = time.iter().map(|t| 6.0 * (5.0 * t).sin() + 1.5 * (17.0 * t).sin()).collect();
        let v = time.iter().map(|t| 30.0 * (5.0 * t).cos() + 25.5 * (17.0 * t).cos()).collect();
        [time, x, v]
    }

    fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).fold(0.0, |most, (a, b)| most.max((a - b).abs()))
    }

    #[test]
    fn without_a_slip_it_is_the_hysteretic_variable() {
        let [time, x, v] = motion(400.0);
        let plan = Plan::of(&time, &x, &v);
        for shape in [[0.3, 0.8, 1.7], [0.5, 0.5, 1.0], [0.2, 1.4, 2.0]] {
            let mut plain = vec![0.0; x.len()];
            hysteretic::trace(&plan, shape, 0.0, &mut plain);
            let found = trace((&plan, &x), &Condition::Missing, shape, StateChange::default());
            let off = largest_difference(&plain, &found);
            assert!(off < 3e-4, "{shape:?} {off}");
        }
    }

    #[test]
    fn noise_of_the_displacement_moves_no_state() {
        let [time, mut x, v] = motion(400.0);
        let shape = [0.6, 0.7, 1.0];
        let change = StateChange { wear: Wear { strength: 0.01, stiffness: 0.0 }, ..StateChange::default() };
        let trace = |x: &[f64]| trace((&Plan::of(&time, x, &v), x), &Condition::Missing, shape, change);
        let still = trace(&x);
        for (i, x) in x.iter_mut().enumerate() {
            *x += if i % 2 == 0 { 0.02 } else { -0.02 };
        }
        // Its path is less exact than one that meets an exact displacement.
        let moved = largest_difference(&still, &trace(&x));
        assert!(moved < 1e-5, "{moved}");
    }

    #[test]
    fn a_changed_state_stays_within_its_yield() {
        let [time, x, v] = motion(60.0);
        let plan = Plan::of(&time, &x, &v);
        let slips = [
            None,
            Some(Slip::ByForce { depth: 0.97, width: 0.05, place: 0.5 }),
            Some(Slip::ByForce { depth: 0.97, width: 0.8, place: -0.3 }),
            Some(Slip::ByPlace { depth: 0.97, width: 0.2 }),
        ];
        for slip in slips {
            for wear in [Wear::default(), Wear { strength: 0.5, stiffness: 0.5 }] {
                for shape in [[1e-3, 0.5, 1.0], [20.0, 2.0, 5.0], [1e6, 1.5, 1.0]] {
                    let change = StateChange { slip, wear, pace: None };
                    let found = trace((&plan, &x), &Condition::Missing, shape, change);
                    assert!(found.iter().all(|w| w.abs() <= 1.0 + 1e-6), "{slip:?} {wear:?} {shape:?}");
                }
            }
        }
    }

    #[test]
    fn a_changed_state_follows_its_differential_equation() {
        let [time, x, v] = motion(400.0);
        let (rho, sigma, n) = (0.4, 0.7, 1.3);
        let (depth, width) = (0.8, 0.25);
        let by_force = Slip::ByForce { depth, width, place: 0.15 };
        let by_place = Slip::ByPlace { depth, width: 1.2 };
        let worn = Wear { strength: 0.01, stiffness: 0.02 };
        let pace = Pace { low: -1.0, span: 2.0, ratio: 3.0 };
        let current = Condition::Series(time.iter().map(|t| (2.0 * t).sin()).collect());
        let changes = [
            (Some(by_force), Wear::default(), None),
            (Some(by_place), Wear::default(), None),
            (None, worn, None),
            (None, Wear::default(), Some(pace)),
            (Some(by_place), Wear::default(), Some(pace)),
        ];
        for (slip, wear, pace) in changes {
            let change = StateChange { slip, wear, pace };
            let found = trace((&Plan::of(&time, &x, &v), &x), &current, [rho, sigma, n], change);
            // Euler's method at two hundredths of a step.
            let (mut w, mut e, mut off): (f64, f64, f64) = (0.0, 0.0, 0.0);
            for i in 1..time.len() {
                off = off.max((w - found[i - 1]).abs());
                let h = (time[i] - time[i - 1]) / 200.0;
                for s in 0..200 {
                    let t = time[i - 1] + (f64::from(s) + 0.5) * h;
                    let x = 6.0 * (5.0 * t).sin() + 1.5 * (17.0 * t).sin();
                    let v = 30.0 * (5.0 * t).cos() + 25.5 * (17.0 * t).cos();
                    let share = match slip {
                        Some(Slip::ByForce { place, .. }) => {
                            1.0 - depth * (-((w * v.signum() - place) / width).powi(2)).exp()
                        }
                        Some(Slip::ByPlace { width, .. }) => 1.0 - depth * (-(x / width).powi(2)).exp(),
                        None => 1.0,
                    };
                    let turn = sigma * (v.abs() * w.signum() - v) + v;
                    let rho = pace.map_or(rho, |_| rho * (2.0 + (2.0 * t).sin()));
                    let (nu, eta) = (1.0 + wear.strength * e, 1.0 + wear.stiffness * e);
                    w += h * rho * share * (v - nu * w.abs().powf(n) * turn) / eta;
                    e += h * w * v;
                }
            }
            assert!(off < 2e-3, "{change:?} {off}");
        }
    }
}
