//! The power that warms or wears a device.

use super::{Scene, Sizes};

/// What the power is taken as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Work {
    /// All that passes through the device, `|F v|`.
    Passed,
    /// What stays in it, `F v`.
    Net,
    /// The heat of a dashpot, in proportion to `v^2`.
    Viscous,
}

impl Work {
    /// Power of the base model alone, N mm/s (of a dashpot: mm^2/s^2).
    pub(super) fn power(self, scene: &Scene) -> Vec<f64> {
        let of = |power: fn(f64, f64) -> f64| {
            scene.force.iter().zip(scene.velocity).map(|(f, v)| power(*f, *v)).collect()
        };
        match self {
            Self::Passed => of(|f, v| (f * v).abs()),
            Self::Net => of(|f, v| f * v),
            Self::Viscous => of(|_, v| v * v),
        }
    }

    /// Most of it in a recording of the campaign, N mm (of a dashpot: mm^2/s).
    pub(super) fn most(self, sizes: &Sizes) -> f64 {
        match self {
            Self::Passed => sizes.energy,
            Self::Net => sizes.dissipated,
            Self::Viscous => sizes.heat(),
        }
    }
}
