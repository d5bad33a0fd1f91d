//! The hysteretic variable of a Bouc-Wen device whose state slips: it moves on by a share of what the motion asks for.
//!
//! The law has no rate: the state follows a [`Climb`] over the path. A motion turns between samples where its velocity
//! changes sign.

use super::climb::Climb;
use super::elementary::erf;

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
    fn at(self, u: f64) -> f64 {
        match self {
            Self::ByForce { depth, width, place } => 1.0 - depth * (-((u - place) / width).powi(2)).exp(),
            Self::ByPlace { .. } => 1.0,
        }
    }

    /// Displacement that the state takes for one of the device, mm.
    fn felt(self, x: f64) -> f64 {
        match self {
            Self::ByForce { .. } => x,
            Self::ByPlace { depth, width } => {
                x - depth * width * std::f64::consts::FRAC_2_SQRT_PI.recip() * erf(x / width)
            }
        }
    }
}

/// The hysteretic variable at every sample, from rest, for shapes `[rho, sigma, n]`.
pub(crate) fn trace(time: &[f64], x: &[f64], v: &[f64], [rho, sigma, n]: [f64; 3], slip: Slip) -> Vec<f64> {
    let bare = |u: f64| 1.0 - u.abs().powf(n) * (1.0 + sigma * (u.signum() - 1.0));
    let climb = Climb::new(|u| bare(u) * slip.at(u));
    let path: Vec<f64> = x.iter().map(|x| slip.felt(*x)).collect();
    climb.states(rho, &path, |i| {
        let (from, to) = (v[i - 1], v[i]);
        let turns = from * to < 0.0;
        turns.then(|| slip.felt(x[i - 1] + 0.5 * (time[i] - time[i - 1]) * from * from / (from - to)))
    })
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
        for shape in [[0.3, 0.8, 1.7], [0.5, 0.5, 1.0], [0.2, 1.4, 2.0]] {
            let mut plain = vec![0.0; x.len()];
            hysteretic::trace(&time, &v, shape, &mut plain);
            let slip = Slip::ByForce { depth: 0.0, width: 0.3, place: 0.1 };
            let off = largest_difference(&plain, &trace(&time, &x, &v, shape, slip));
            assert!(off < 3e-4, "{shape:?} {off}");
        }
    }

    #[test]
    fn a_slip_follows_its_differential_equation() {
        let [time, x, v] = motion(400.0);
        let (rho, sigma, n) = (0.4, 0.7, 1.3);
        let (depth, width) = (0.8, 0.25);
        let by_force = Slip::ByForce { depth, width, place: 0.15 };
        let by_place = Slip::ByPlace { depth, width: 1.2 };
        for slip in [by_force, by_place] {
            let found = trace(&time, &x, &v, [rho, sigma, n], slip);
            // Euler's method at two hundredths of a step.
            let (mut w, mut off): (f64, f64) = (0.0, 0.0);
            for i in 1..time.len() {
                off = off.max((w - found[i - 1]).abs());
                let h = (time[i] - time[i - 1]) / 200.0;
                for s in 0..200 {
                    let t = time[i - 1] + (f64::from(s) + 0.5) * h;
                    let x = 6.0 * (5.0 * t).sin() + 1.5 * (17.0 * t).sin();
                    let v = 30.0 * (5.0 * t).cos() + 25.5 * (17.0 * t).cos();
                    let share = match slip {
                        Slip::ByForce { place, .. } => {
                            1.0 - depth * (-((w * v.signum() - place) / width).powi(2)).exp()
                        }
                        Slip::ByPlace { width, .. } => 1.0 - depth * (-(x / width).powi(2)).exp(),
                    };
                    let p = w.abs().powf(n);
                    let turn = sigma * (v.abs() * w.signum() - v) + v;
                    w += h * rho * share * (v - p * turn);
                }
            }
            assert!(off < 2e-3, "{slip:?} {off}");
        }
    }
}
