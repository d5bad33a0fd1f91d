//! What smoothing leaves of the noise of a motion.

use rand_chacha::ChaCha8Rng;

use super::calming::{Calm, Calming};
use super::parts::Parts;
use super::recorded::{Smoothed, Way};
use super::together::Together;
use crate::deviate::normal;
use crate::kernel::halfway::way;

/// How noise was taken off a motion, of which some is left.
#[derive(Debug, Clone)]
pub(crate) enum Left {
    /// Of one whose velocity is derived.
    Derived(Calming),
    /// The same between corners and bends.
    Between(Parts),
    /// Of one whose velocity was recorded, with the standard deviation of the noise of that, mm/s.
    Recorded(Way, f64, Together),
}

impl Left {
    /// Of a recorded velocity and the displacement that was brought together with it.
    pub(crate) fn recorded(velocity: Smoothed, together: Together) -> Self {
        Self::Recorded(velocity.way, velocity.noise, together)
    }

    /// True where there was no noise.
    pub(crate) fn is_none(&self) -> bool {
        match self {
            Self::Derived(calming) => calming.noise <= 0.0,
            Self::Between(parts) => parts.noise <= 0.0,
            Self::Recorded(_, noise, together) => *noise <= 0.0 && together.noise <= 0.0,
        }
    }

    /// Standard deviation of the noise that the displacement had, mm.
    pub(crate) fn of_displacement(&self) -> f64 {
        match self {
            Self::Derived(calming) => calming.noise,
            Self::Between(parts) => parts.noise,
            Self::Recorded(_, _, together) => together.noise,
        }
    }

    /// What is left of as much noise as there was, drawn anew, of a motion at times in s with a displacement in mm and a
    /// velocity in mm/s.
    pub(crate) fn drawn(&self, [time, displacement, velocity]: [&[f64]; 3], stream: &mut ChaCha8Rng) -> Calm {
        let mut draw = |size: f64| time.iter().map(|_| size * normal(stream)).collect::<Vec<f64>>();
        let calm =
            |[displacement, velocity]: [Vec<f64>; 2]| Calm { displacement, velocity, noisy: Vec::new() };
        match self {
            Self::Derived(calming) => calming.over(time, &draw(calming.noise)),
            Self::Between(parts) => parts.over(time, &draw(parts.noise)),
            Self::Recorded(way_of_noise, noise, together) => {
                let of_velocity = way_of_noise.over(time, &draw(*noise));
                let of_displacement = draw(together.noise);
                let path = way(time, &of_velocity);
                calm(together.along(
                    [time, &path],
                    [&of_displacement, &of_velocity],
                    [displacement, velocity],
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_core::SeedableRng;

    use super::super::{from_displacement, smoothed};
    use super::*;

    const RATE: f64 = 200.0;

    fn rms(series: impl Iterator<Item = f64>) -> f64 {
        let squares: Vec<f64> = series.map(|e| e * e).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// What is left, of errors of displacement and velocity, is of the size of what is drawn.
    fn alike(errors: &[Vec<f64>; 2], drawn: &Calm) {
        for (errors, drawn) in errors.iter().zip([&drawn.displacement, &drawn.velocity]) {
            // Not at the ends, where few samples have much.
            let inner = 100..errors.len() - 100;
            let sizes = [errors, drawn].map(|series| rms(series[inner.clone()].iter().copied()));
            assert!((0.7..1.4).contains(&(sizes[0] / sizes[1])), "{sizes:?}");
        }
    }

    fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
        a.iter().zip(b).map(|(a, b)| a - b).collect()
    }

    #[test]
    fn as_much_is_drawn_as_is_left() {
        let turn = std::f64::consts::TAU;
        let time: Vec<f64> = (0..4000).map(|i| f64::from(i) / RATE).collect();
        let truth = |of: &dyn Fn(f64) -> f64| time.iter().map(|t| of(*t)).collect::<Vec<f64>>();
        let x = truth(&|t| 5.0 * (turn * t).sin() + 2.0 * (turn * 0.3 * t).sin());
        let v = truth(&|t| turn * (5.0 * (turn * t).cos() + 0.6 * (turn * 0.3 * t).cos()));
        let mut stream = ChaCha8Rng::seed_from_u64(11);
        let mut noisy = |series: &[f64], size: f64| -> Vec<f64> {
            series.iter().map(|value| value + size * normal(&mut stream)).collect()
        };
        let (seen, shown) = (noisy(&x, 0.01), noisy(&v, 0.1));

        let recorded = smoothed(&time, &seen, &shown);
        let (together, [displacement, velocity]) = Together::of(&time, &seen, &recorded);
        let left = Left::recorded(recorded, together);
        let mut draws = ChaCha8Rng::seed_from_u64(13);
        let drawn = left.drawn([&time, &displacement, &velocity], &mut draws);
        alike(&[less(&displacement, &x), less(&velocity, &v)], &drawn);

        let calming = from_displacement(&time, &seen).calming(&time, &seen);
        let calm = calming.over(&time, &seen);
        let drawn = Left::Derived(calming).drawn([&time, &seen, &v], &mut draws);
        alike(&[less(&calm.displacement, &x), less(&calm.velocity, &v)], &drawn);
    }

    #[test]
    fn a_motion_without_noise_leaves_none() {
        let time: Vec<f64> = (0..2000).map(|i| f64::from(i) / RATE).collect();
        let turn = std::f64::consts::TAU;
        let (x, v): (Vec<f64>, Vec<f64>) =
            time.iter().map(|t| (5.0 * (turn * t).sin(), 5.0 * turn * (turn * t).cos())).unzip();
        let recorded = smoothed(&time, &x, &v);
        let (together, _) = Together::of(&time, &x, &recorded);
        assert!(Left::recorded(recorded, together).is_none());
    }
}
