//! Payne softening: the stiffness falls with the current strain amplitude and comes back with it.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | s | largest share of the stiffness that is lost | - | 0 to 0.95 |
//! | `x_c` | amplitude at which half of it is lost | mm | 1 % to 200 % of the largest stroke |
//! | `t_a` | time over which a past amplitude, or the loss, is forgotten | s | 0.05 s to half the longest recording, or 10 s |
//! | m | exponent of the amplitude (twice that of Kraus) | - | 0.3 to 2 |
//! | r | rate at which motion breaks the structure | 1/mm | 0.02 to 20 over the largest stroke |
//!
//! The amplitude is the largest displacement so far, forgotten exponentially; or half the stroke of the last
//! half cycle; or that of a sine with the mean square, forgotten exponentially; or the largest of the recording;
//! or there is none, and motion breaks a structure that time rebuilds.
//! Reference: Kraus, Rubber Chem. Technol. 51 (1978) 297; Mewis and Wagner, Adv. Colloid Interface Sci. 147 (2009) 214.
//! Known limit: at one amplitude it is part of k0; where the amplitude only rises it is Mullins softening.

use super::operators::{each, lag};
use super::{About, Effect, Factors, Scene, Sizes, order_within, within};
use crate::parameter::Parameter;

/// Share of the largest stroke by which a motion has to turn back to count as reversed.
const REVERSED: f64 = 0.005;

/// What the softening follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Amplitude {
    /// The largest displacement, forgotten over a time.
    Forgotten,
    /// The last half cycle.
    HalfCycle,
    /// The mean square of the displacement, forgotten over a time.
    MeanSquare,
    /// The largest displacement of the recording, as of a steady test.
    Recording,
    /// A structure that motion breaks and time rebuilds.
    Structure,
}

/// A law of softening, on the stiffness or on the whole force.
#[derive(Debug, Clone, Copy)]
pub(super) struct Payne {
    /// The law.
    pub(super) by: Amplitude,
    /// True where damping softens like stiffness.
    pub(super) whole: bool,
}

/// Longest time over which an amplitude is forgotten, s: rubber does so in seconds, recordings may be shorter.
fn longest_memory(sizes: &Sizes) -> f64 {
    (0.5 * sizes.duration).max(10.0)
}

/// Largest displacement so far, forgotten over a time: the current amplitude.
fn forgotten(scene: &Scene, forget: f64) -> Vec<f64> {
    let (time, x) = (scene.time, scene.displacement);
    scene.trace(x[0].abs(), |a, i| (a * (-(time[i] - time[i - 1]) / forget).exp()).max(x[i].abs()))
}

/// Half the stroke between the last two reversals; the first stroke counts from rest.
fn half_cycle(scene: &Scene) -> Vec<f64> {
    let (x, back) = (scene.displacement, REVERSED * scene.sizes.displacement);
    let (mut farthest, mut turn, mut side) = (x[0], None, 0.0);
    scene.trace(0.0, |amplitude, i| {
        if side == 0.0 {
            if (x[i] - x[0]).abs() > back {
                (side, farthest) = ((x[i] - x[0]).signum(), x[i]);
            }
            return amplitude;
        }
        if (x[i] - farthest) * side > 0.0 {
            farthest = x[i];
        }
        if (farthest - x[i]) * side <= back {
            return amplitude;
        }
        let stroke = turn.map_or((farthest - x[0]).abs(), |last: f64| 0.5 * (farthest - last).abs());
        (turn, farthest, side) = (Some(farthest), x[i], -side);
        stroke
    })
}

/// Amplitude of a sine with the mean square of the displacement, forgotten over a time.
fn mean_square(scene: &Scene, forget: f64) -> Vec<f64> {
    let squares = each(scene.displacement, |x| x * x);
    each(&lag(scene.time, &squares, forget, 0.0), |mean| (2.0 * mean.max(0.0)).sqrt())
}

/// Broken share of a structure that breaks at `rate` a millimetre and is rebuilt over a time; whole at rest.
fn broken(scene: &Scene, rate: f64, rebuilt: f64) -> Vec<f64> {
    let (time, v) = (scene.time, scene.velocity);
    scene.trace(0.0, |b, i| {
        let breaking = 0.5 * rate * (v[i - 1].abs() + v[i].abs());
        let sum = breaking + 1.0 / rebuilt;
        let steady = breaking / sum;
        steady + (b - steady) * (-sum * (time[i] - time[i - 1])).exp()
    })
}

impl Effect for Payne {
    fn about(&self) -> About {
        let law = |stiffness, whole| if self.whole { whole } else { stiffness };
        let forgotten = About {
            effect: "payne_softening",
            law: law("Kraus, stiffness", "Kraus, whole force"),
            plain: "the stiffness falls with the current strain amplitude and recovers with it",
            equation: "k -> k (1 - s a^m/(1 + a^m)), a = A(t)/x_c, A the largest |x|, forgotten over t_a",
            reference: "Payne 1962; Kraus 1978",
            limit: "at one amplitude it is part of k0; where the amplitude only rises it is Mullins",
        };
        match self.by {
            Amplitude::Forgotten => forgotten,
            Amplitude::HalfCycle => About {
                law: law("last half cycle, stiffness", "last half cycle, whole force"),
                equation: "k -> k (1 - s a^m/(1 + a^m)), a = A/x_c, A half the stroke of the last half cycle",
                ..forgotten
            },
            Amplitude::MeanSquare => About {
                law: law("mean square, stiffness", "mean square, whole force"),
                equation: "k -> k (1 - s a^m/(1 + a^m)), a = A(t)/x_c, A^2 twice the mean of x^2 over t_a",
                ..forgotten
            },
            Amplitude::Recording => About {
                law: law("amplitude of the recording, stiffness", "amplitude of the recording, whole force"),
                equation: "k -> k (1 - s a^m/(1 + a^m)), a = A/x_c, A the largest |x| of the recording",
                ..forgotten
            },
            Amplitude::Structure => About {
                law: law("structure, stiffness", "structure, whole force"),
                equation: "k -> k (1 - s b), db/dt = r |v| (1 - b) - b/t_a",
                reference: "Mewis and Wagner 2009",
                ..forgotten
            },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        let s = within("s", "", 0.0, 0.95);
        let x_c = order_within("x_c", "mm", 0.01 * x, 2.0 * x);
        let t_a = order_within("t_a", "s", 0.05, longest_memory(sizes));
        let m = order_within("m", "", 0.3, 2.0);
        match self.by {
            Amplitude::Forgotten | Amplitude::MeanSquare => vec![s, x_c, t_a, m],
            Amplitude::HalfCycle | Amplitude::Recording => vec![s, x_c, m],
            Amplitude::Structure => vec![s, order_within("r", "1/mm", 0.02 / x, 20.0 / x), t_a],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let x = sizes.displacement;
        let grid = |firsts: [f64; 2], make: &dyn Fn(f64, f64) -> Vec<f64>| {
            [0.3, 1.0, 3.0].iter().flat_map(|t| firsts.map(|first| make(first, *t))).collect()
        };
        match self.by {
            Amplitude::Forgotten | Amplitude::MeanSquare => {
                grid([0.1 * x, 0.7 * x], &|x_c, t_a| vec![0.2, x_c, t_a, 1.0])
            }
            Amplitude::HalfCycle | Amplitude::Recording => {
                [0.05, 0.2, 0.8].iter().map(|share| vec![0.2, share * x, 1.0]).collect()
            }
            Amplitude::Structure => grid([0.1 / x, 1.0 / x], &|r, t_a| vec![0.2, r, t_a]),
        }
    }

    fn is_of_steady_motion(&self) -> bool {
        self.by == Amplitude::Recording
    }

    fn factors(&self, scene: &Scene, shape: &[f64]) -> Option<Factors> {
        let kraus = |amplitude: Vec<f64>, m: f64| -> Vec<f64> {
            amplitude.iter().map(|a| (a / shape[1]).powf(m)).map(|a| a / (1.0 + a)).collect()
        };
        let lost = match self.by {
            Amplitude::Forgotten => kraus(forgotten(scene, shape[2]), shape[3]),
            Amplitude::HalfCycle => kraus(half_cycle(scene), shape[2]),
            Amplitude::Recording => {
                let largest = scene.displacement.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
                kraus(vec![largest; scene.len()], shape[2])
            }
            Amplitude::MeanSquare => kraus(mean_square(scene, shape[2]), shape[3]),
            Amplitude::Structure => broken(scene, shape[1], shape[2]),
        };
        Some(Factors::losing(shape[0], &lost, self.whole))
    }
}
