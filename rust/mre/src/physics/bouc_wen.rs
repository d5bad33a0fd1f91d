//! Bouc-Wen hysteresis in its non-redundant, admissible form:
//! `F = kw w`, `dw/dt = rho (v - sigma |v| |w|^(n-1) w + (sigma - 1) v |w|^n)`.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | kw | hysteretic force at yield | N | >= 0 |
//! | rho | inverse of the yield displacement | 1/mm | > 0 |
//! | sigma | share of the dissipative term, beta / (beta + gamma) | - | >= 1/2 |
//! | n | sharpness of the yield | - | >= 1 |
//! | w | hysteretic variable, z over its bound | - | [-1, 1] |
//!
//! Source: Ikhouane and Rodellar 2005, <https://doi.org/10.1007/s11071-005-0069-3>, the normalised
//! form of eq. 1 and 2 of Yu, Li and Li, ISARC 2014; limits
//! of sigma from Erlicher and Point 2004, <https://doi.org/10.1016/j.crme.2003.10.009>.
//! Integrated by RK4 on the samples with the velocity halfway between them from a cubic, or on both sides of a corner,
//! sub-stepped where [`STEP`] asks for it; where an effect changes the law of its state, from turn to turn.
//! Known limit: short unload-reload cycles drift.

use rayon::prelude::*;

use super::{Part, Term};
use crate::extent::Extent;
use crate::kernel::hysteretic;
use crate::kernel::hysteretic_traces::{Motion, traces};
use crate::kernel::state_change;
use crate::parameter::{Ideal, Parameter, Scale};
use crate::recording::Recording;

/// Largest `|v| dt rho n max(1, 2 sigma - 1)` in a step of RK4. It is unstable from about 2.8.
pub const STEP: f64 = 0.5;

/// Hysteretic spring.
#[derive(Debug, Clone, Copy)]
pub struct BoucWen;

impl Term for BoucWen {
    fn part(&self) -> Part {
        Part::Hysteretic
    }

    fn coefficient(&self, extent: &Extent) -> Parameter {
        Parameter {
            name: "kw".into(),
            unit: "N",
            smallest: 0.0,
            largest: f64::INFINITY,
            lower: 0.0,
            upper: 1.5 * extent.force,
            scale: Scale::Linear,
            ideal: Ideal::default(),
        }
    }

    fn shape(&self, extent: &Extent) -> Vec<Parameter> {
        let parameter = |name: &str, unit, smallest, lower, upper, scale| Parameter {
            name: name.into(),
            unit,
            smallest,
            largest: f64::INFINITY,
            lower,
            upper,
            scale,
            ideal: Ideal::default(),
        };
        // Yield displacements from five strokes down to 1 % of the longest, or 5 % of the shortest.
        let sharpest = (100.0 / extent.displacement).max(20.0 / extent.shortest);
        vec![
            parameter("rho", "1/mm", 0.0, 0.2 / extent.displacement, sharpest, Scale::Log),
            parameter("sigma", "", 0.5, 0.5, 2.0, Scale::Linear),
            parameter("n", "", 1.0, 1.0, 5.0, Scale::Log),
        ]
    }

    fn column(&self, recording: &Recording, shape: &[f64], out: &mut [f64]) {
        if let Some(trace) = changed(recording, shape) {
            out.copy_from_slice(&trace);
        } else {
            let shape = [shape[0], shape[1], shape[2]];
            hysteretic::trace(recording.plan(), shape, recording.start(), out);
        }
    }

    fn columns(&self, of: &[(&Recording, &[f64])]) -> Vec<Vec<f64>> {
        let changed: Vec<Option<Vec<f64>>> =
            of.par_iter().map(|(recording, shape)| changed(recording, shape)).collect();
        let motions: Vec<Motion> = of
            .iter()
            .filter(|(recording, _)| recording.state_change().is_none())
            .map(|(recording, shape)| Motion {
                plan: recording.plan(),
                shape: [shape[0], shape[1], shape[2]],
                start: recording.start(),
            })
            .collect();
        let mut plain = traces(&motions).into_iter();
        changed.into_iter().map(|trace| trace.or_else(|| plain.next()).unwrap_or_default()).collect()
    }
}

/// The hysteretic variable under another law of its state, where the recording has one.
fn changed(recording: &Recording, shape: &[f64]) -> Option<Vec<f64>> {
    let change = recording.state_change()?;
    let shape = [shape[0], shape[1], shape[2]];
    Some(state_change::trace(
        (recording.plan(), recording.displacement()),
        recording.current(),
        shape,
        change,
    ))
}

/// The same model in the notation of eq. 1 and 2, with the redundant A fixed at 1:
/// `F = a k0 x + (1 - a) k0 z + c0 v`, `dz/dt = A v - beta |v| |z|^(n-1) z - gamma v |z|^n`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Classical {
    /// Initial stiffness, N/mm.
    pub k0: f64,
    /// Ratio of post-yield to initial stiffness; `None` where `k0` is zero.
    pub alpha: Option<f64>,
    /// beta, in `mm^-n`.
    pub beta: f64,
    /// gamma, in `mm^-n`.
    pub gamma: f64,
}

impl Classical {
    /// From the normalised form.
    pub fn from_normalised(kx: f64, kw: f64, rho: f64, sigma: f64, n: f64) -> Self {
        let k0 = kx + kw * rho;
        let sum = rho.powf(n);
        Self { k0, alpha: (k0 > 0.0).then(|| kx / k0), beta: sigma * sum, gamma: (1.0 - sigma) * sum }
    }
}
