//! Field lag: the field follows the recorded current with a delay (coil, eddy currents, controller).
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `tau_i` | time constant | s | 0.02 ms to 2 s |
//! | `tau_u`, `tau_d` | time constants of rise and fall | s | 0.02 ms to 2 s |
//! | `zeta` | damping ratio of a field that overshoots | - | 0.3 to 0.95 |
//! | `s_j` | share of the time between two samples that passes before the current jumps | - | 0 to 1 |
//!
//! The field is that of the first current at the start.
//! Reference: Spencer, Dyke, Sain and Carlson, J. Eng. Mech. 123 (1997) 230 (first-order filter);
//! Yang, Spencer, Carlson and Sain, Eng. Struct. 24 (2002) 309 (coil).
//! Known limit: the lag of the coil and that of its controller are one.

use super::smooth_lag::{jumping_lag, smooth_lag, smooth_ringing};
use super::{About, Effect, Scene, Sizes, ideal_above, order_within, within};
use crate::kernel::jumps::jumps_after;
use crate::parameter::Parameter;

/// Time constants that a fit starts from, s.
const TAUS: [f64; 6] = [5e-4, 0.003, 0.01, 0.05, 0.2, 0.8];

/// Of rise and fall.
const RISE_AND_FALL: [[f64; 2]; 4] = [[0.02, 0.1], [0.1, 0.02], [0.1, 0.5], [0.5, 0.1]];

/// Time constant of a field that overshoots, s, at least: it has a frequency.
const SHORTEST: f64 = 1e-9;

/// Form of the lag.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FieldLag {
    /// One time constant.
    One,
    /// The same lag twice: coil and controller.
    Twice,
    /// A second-order lag that overshoots.
    Ringing,
    /// One for rise and one for fall.
    RiseAndFall,
    /// One, of a current that jumps between samples.
    Jumping,
    /// One for rise and one for fall, of such a current.
    JumpingRiseAndFall,
}

impl Effect for FieldLag {
    fn about(&self) -> About {
        let one = About {
            effect: "field_lag",
            law: "first order",
            plain: "the magnetic field follows the coil current with a delay",
            equation: "dI_f/dt = (I - I_f)/tau_i, the device sees I_f",
            reference: "Spencer, Dyke, Sain and Carlson 1997",
            limit: "the lag of the coil and that of its controller are one",
        };
        match self {
            Self::One => one,
            Self::Twice => About {
                law: "second order",
                equation: "dI_1/dt = (I - I_1)/tau_i, dI_f/dt = (I_1 - I_f)/tau_i, the device sees I_f",
                reference: "Yang, Spencer, Carlson and Sain 2002",
                ..one
            },
            Self::Ringing => About {
                law: "second order, overshooting",
                equation: "tau_i^2 d2I_f/dt2 + 2 zeta tau_i dI_f/dt + I_f = I, the device sees I_f",
                reference: "Yang, Spencer, Carlson and Sain 2002",
                ..one
            },
            Self::RiseAndFall => About {
                law: "rise and fall",
                equation: "dI_f/dt = (I - I_f)/(tau_u where it rises, tau_d where it falls)",
                ..one
            },
            Self::Jumping => About {
                law: "first order, jumps",
                equation: "dI_f/dt = (I - I_f)/tau_i, the device sees I_f; I jumps after the share s_j of a step",
                ..one
            },
            Self::JumpingRiseAndFall => About {
                law: "rise and fall, jumps",
                equation: "dI_f/dt = (I - I_f)/(tau_u where it rises, tau_d where it falls); I jumps after the share \
                           s_j of a step",
                ..one
            },
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.current_varies
            && (sizes.current_steps || !matches!(self, Self::Jumping | Self::JumpingRiseAndFall))
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        let tau = |name| order_within(name, "s", 2e-5, 2.0);
        let share = within("s_j", "", 0.0, 1.0);
        match self {
            Self::One | Self::Twice => vec![tau("tau_i")],
            Self::Ringing => vec![
                Parameter { smallest: SHORTEST, ..tau("tau_i") },
                ideal_above(Parameter { smallest: 0.0, largest: 0.99, ..within("zeta", "", 0.3, 0.95) }),
            ],
            Self::RiseAndFall => vec![tau("tau_u"), tau("tau_d")],
            Self::Jumping => vec![tau("tau_i"), share],
            Self::JumpingRiseAndFall => vec![tau("tau_u"), tau("tau_d"), share],
        }
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        match self {
            Self::One | Self::Twice => TAUS.map(|tau| vec![tau]).into(),
            Self::Ringing => TAUS.map(|tau| vec![tau, 0.7]).into(),
            Self::RiseAndFall => RISE_AND_FALL.map(|taus| taus.to_vec()).into(),
            Self::Jumping => TAUS.map(|tau| vec![tau, 0.5]).into(),
            Self::JumpingRiseAndFall => RISE_AND_FALL.map(|[up, down]| vec![up, down, 0.5]).into(),
        }
    }

    fn current(&self, scene: &Scene, shape: &[f64]) -> Option<Vec<f64>> {
        let (current, time) = (scene.current?, scene.time);
        Some(match self {
            Self::One => smooth_lag(time, current, shape[0], current[0]),
            Self::Twice => {
                let once = smooth_lag(time, current, shape[0], current[0]);
                smooth_lag(time, &once, shape[0], current[0])
            }
            Self::Ringing => smooth_ringing(time, current, 1.0 / shape[0], shape[1], current[0]),
            Self::RiseAndFall => rise_and_fall(scene, current, [shape[0], shape[1]], 0.5),
            Self::Jumping => jumping_lag(time, current, shape[0], shape[1]),
            Self::JumpingRiseAndFall => rise_and_fall(scene, current, [shape[0], shape[1]], shape[2]),
        })
    }
}

/// Field of a current whose own time constants are those of its rise and fall, and which jumps after a share of a step.
fn rise_and_fall(scene: &Scene, current: &[f64], [rise, fall]: [f64; 2], share: f64) -> Vec<f64> {
    let jumps = jumps_after(current);
    scene.trace(current[0], |field, i| {
        let step = scene.time[i] - scene.time[i - 1];
        let towards = |target: f64, step: f64, field: f64| {
            let tau = if target > field { rise } else { fall };
            target + (field - target) * (-step / tau).exp()
        };
        if jumps.binary_search(&(i - 1)).is_ok() {
            towards(current[i], (1.0 - share) * step, towards(current[i - 1], share * step, field))
        } else {
            towards(0.5 * (current[i - 1] + current[i]), step, field)
        }
    })
}
