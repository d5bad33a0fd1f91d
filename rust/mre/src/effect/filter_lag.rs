//! Filter lag: one channel is smoothed by a low-pass filter.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | T, `T_2` | time constants | s | 0.1 ms to 50 ms |
//! | `f_c` | corner frequency of a Butterworth filter | Hz | 3 to 2000 |
//!
//! Exact for the cubic spline through evenly spaced samples; behind a hysteretic base model through values halfway between
//! them too, since a spline swings where such a device turns.
//! Reference: Butterworth, Wireless Engineer 7 (1930) 536.
//! Known limit: with all frequencies far below the corner it is a time delay; recordings that a filter delays by so
//! much that the device would give out energy in every cycle are refused.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;

use super::{About, Effect, Motion, Scene, Sizes, ideal_below, order_within};
use crate::kernel::relaxation::Step;
use crate::kernel::spline::second_differences;
use crate::parameter::Parameter;

/// Which channel is filtered, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FilterLag {
    /// The force, by a first-order lag.
    Force,
    /// The force, by two first-order lags in a row.
    Two,
    /// The displacement, by a first-order lag.
    Displacement,
    /// The force, by a Butterworth filter of second, third or fourth order.
    Butterworth,
    Third,
    Fourth,
}

/// `Re(share y)` of `y' = rate (u - y)`, at rest at the first value: exact for the natural cubic spline through evenly
/// spaced values. A line between them would be coarser than a filter faster than their spacing.
fn filtered(step: f64, input: &[f64], rate: Complex<f64>, share: Complex<f64>) -> Vec<f64> {
    let bend = second_differences(input);
    let Step { decay, early, late, bent } = Step::over(rate * step);
    let mut y = Complex::from(input[0]);
    let mut out = Vec::with_capacity(input.len());
    out.push((share * y).re);
    for i in 1..input.len() {
        let entering = early * input[i - 1] + late * input[i] + bent[0] * bend[i - 1] + bent[1] * bend[i];
        y = y * decay + entering;
        out.push((share * y).re);
    }
    out
}

/// First-order lag of time constant `tau`.
fn first_order(step: f64, input: &[f64], tau: f64) -> Vec<f64> {
    filtered(step, input, Complex::from(1.0 / tau), Complex::from(1.0))
}

/// Butterworth filter of an order: poles evenly on a half circle, by one of each pair.
fn butterworth(step: f64, input: &[f64], corner: f64, order: u8) -> Vec<f64> {
    let w = TAU * corner;
    let real = if order % 2 == 1 { first_order(step, input, 1.0 / w) } else { input.to_vec() };
    (0..order / 2).fold(real, |passed, pair| {
        let from_real = PI * (0.5 - (f64::from(pair) + 0.5) / f64::from(order));
        let rate = Complex::from_polar(w, -from_real);
        filtered(step, &passed, rate, Complex::new(0.0, -w / from_real.sin()) / rate)
    })
}

impl FilterLag {
    /// A force at steps in s, where it is what is filtered.
    fn measured(self, step: f64, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        match self {
            Self::Force => Some(first_order(step, force, shape[0])),
            Self::Two => Some(first_order(step, &first_order(step, force, shape[0]), shape[1])),
            Self::Displacement => None,
            Self::Butterworth => Some(butterworth(step, force, shape[0], 2)),
            Self::Third => Some(butterworth(step, force, shape[0], 3)),
            Self::Fourth => Some(butterworth(step, force, shape[0], 4)),
        }
    }
}

impl Effect for FilterLag {
    fn about(&self) -> About {
        let force = About {
            effect: "filter_lag",
            law: "force, first order",
            plain: "a low-pass filter smooths and delays the measured force",
            equation: "T dF_measured/dt + F_measured = F",
            reference: "general",
            limit: "with all frequencies far below the corner it is a time delay",
        };
        match self {
            Self::Force => force,
            Self::Two => About {
                law: "force, two of first order",
                equation: "T_2 dF_measured/dt + F_measured = F_1, T dF_1/dt + F_1 = F",
                ..force
            },
            Self::Displacement => About {
                law: "displacement, first order",
                plain: "a low-pass filter smooths and delays the measured displacement",
                equation: "T dx/dt + x = x_device",
                ..force
            },
            Self::Butterworth => About {
                law: "force, Butterworth",
                equation: "F_measured'' + sqrt(2) w F_measured' + w^2 F_measured = w^2 F, w = 2 pi f_c",
                reference: "Butterworth 1930",
                ..force
            },
            Self::Third => About {
                law: "force, Butterworth of third order",
                equation: "|F_measured/F| = 1/sqrt(1 + (f/f_c)^6) at frequency f",
                reference: "Butterworth 1930",
                ..force
            },
            Self::Fourth => About {
                law: "force, Butterworth of fourth order",
                equation: "|F_measured/F| = 1/sqrt(1 + (f/f_c)^8) at frequency f",
                reference: "Butterworth 1930",
                ..force
            },
        }
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        let lag = |name| order_within(name, "s", 1e-4, 0.05);
        match self {
            Self::Force | Self::Displacement => vec![lag("T")],
            Self::Two => vec![lag("T"), ideal_below(lag("T_2"))],
            Self::Butterworth | Self::Third | Self::Fourth => {
                vec![order_within("f_c", "Hz", 3.0, 2000.0)]
            }
        }
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::Force | Self::Displacement => vec![vec![0.0005], vec![0.002], vec![0.008], vec![0.025]],
            Self::Two => vec![vec![0.002, 0.0005], vec![0.008, 0.002], vec![0.02, 0.008]],
            Self::Butterworth | Self::Third | Self::Fourth => {
                vec![vec![6.0], vec![15.0], vec![40.0], vec![120.0]]
            }
        }
    }

    fn moves_the_device(&self) -> bool {
        *self == Self::Displacement
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let ahead =
            |series: &[f64], rate: &[f64]| series.iter().zip(rate).map(|(x, v)| x + shape[0] * v).collect();
        self.moves_the_device().then(|| Motion {
            displacement: ahead(scene.displacement, scene.velocity),
            velocity: ahead(scene.velocity, scene.acceleration.get()),
        })
    }

    fn through(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        self.measured(scene.step(), shape, force)
    }

    fn through_halves(&self, scene: &Scene, shape: &[f64], force: &[f64]) -> Option<Vec<f64>> {
        let fine = self.measured(0.5 * scene.step(), shape, force)?;
        Some(fine.into_iter().step_by(2).collect())
    }

    fn between_samples(&self) -> bool {
        *self != Self::Displacement
    }
}
