//! End stop: beyond a gap the device meets a second, stiff spring.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_c` | stiffness of the stop | N/mm, N/mm^1.5 for Hertz contact, N/mm^p for a power | >= 0 |
//! | `c_c` | damping of the contact: over the depth, or over its power 1.5 | N s/mm^2, N s/mm^2.5 | >= 0 |
//! | g | gap; where the ends differ, of the positive one | mm | 30 % to 99.5 % of the largest stroke |
//! | `g_n` | gap of the negative end, where it is another | mm | 30 % to 99.5 % of the largest stroke |
//! | p | power of the depth | - | 1 to 4 |
//!
//! Reference: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440.
//! Known limit: with few samples past the gap it is a stiffening spring.

use std::iter;

use super::operators::each;
use super::{About, Effect, Scene, Sizes, positive, within};
use crate::parameter::Parameter;

/// Where the stop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EndStop {
    /// At both ends.
    Both,
    /// At the positive end.
    Positive,
    /// At the negative end.
    Negative,
    /// At both ends, round.
    Hertz,
    /// At both ends, round, and the contact dissipates.
    HuntCrossley,
    /// At both ends, flat, and the contact dissipates the more the deeper it is.
    Flat,
    /// At both ends, of any power of the depth.
    Power,
    /// At both ends, one nearer than the other.
    Uneven,
    /// The same, round.
    UnevenHertz,
}

/// Shares of the largest stroke at which two gaps may lie.
const GAPS: [f64; 4] = [0.55, 0.75, 0.88, 0.96];

impl EndStop {
    fn is_round(self) -> bool {
        matches!(self, Self::Hertz | Self::HuntCrossley | Self::UnevenHertz)
    }

    /// True where each end has a gap of its own.
    fn is_uneven(self) -> bool {
        matches!(self, Self::Uneven | Self::UnevenHertz)
    }

    fn dissipates(self) -> bool {
        matches!(self, Self::HuntCrossley | Self::Flat)
    }

    /// How deep the contact is at a displacement, mm: negative at the negative end.
    fn depth(self, x: f64, shape: &[f64]) -> f64 {
        let positive = shape[0];
        let negative = if self.is_uneven() { shape[1] } else { positive };
        match self {
            Self::Positive => (x - positive).max(0.0),
            Self::Negative => (x + negative).min(0.0),
            _ => (x - positive).max(0.0) + (x + negative).min(0.0),
        }
    }
}

impl Effect for EndStop {
    fn about(&self) -> About {
        let both = About {
            effect: "end_stop",
            law: "both ends",
            plain: "near its largest displacement the device runs into a stop",
            equation: "F_s = k_c max(|x| - g, 0) sgn x",
            reference: "Hunt and Crossley 1975",
            limit: "with few samples past the gap it is a stiffening spring",
        };
        match self {
            Self::Both => both,
            Self::Positive => About { law: "positive end", equation: "F_s = k_c max(x - g, 0)", ..both },
            Self::Negative => About { law: "negative end", equation: "F_s = -k_c max(-x - g, 0)", ..both },
            Self::Hertz => About {
                law: "Hertz contact",
                equation: "F_s = k_c max(|x| - g, 0)^1.5 sgn x",
                reference: "Hertz 1882; Hunt and Crossley 1975",
                ..both
            },
            Self::HuntCrossley => About {
                law: "Hertz contact with damping",
                equation: "F_s = d^1.5 (k_c sgn x + c_c v), d = max(|x| - g, 0)",
                ..both
            },
            Self::Flat => About {
                law: "both ends with damping",
                equation: "F_s = d (k_c sgn x + c_c v), d = max(|x| - g, 0)",
                ..both
            },
            Self::Power => {
                About { law: "power of the depth", equation: "F_s = k_c max(|x| - g, 0)^p sgn x", ..both }
            }
            Self::Uneven => About {
                law: "both ends, uneven gaps",
                equation: "F_s = k_c (max(x - g, 0) - max(-x - g_n, 0))",
                ..both
            },
            Self::UnevenHertz => About {
                law: "Hertz contact, uneven gaps",
                equation: "F_s = k_c (max(x - g, 0)^1.5 - max(-x - g_n, 0)^1.5)",
                reference: "Hertz 1882; Hunt and Crossley 1975",
                ..both
            },
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        let unit = match self {
            Self::Power => "N/mm^p",
            _ if self.is_round() => "N/mm^1.5",
            _ => "N/mm",
        };
        let damping = match self {
            Self::HuntCrossley => Some("N s/mm^2.5"),
            Self::Flat => Some("N s/mm^2"),
            _ => None,
        };
        iter::once(positive("k_c", unit)).chain(damping.map(|unit| positive("c_c", unit))).collect()
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let gap = |name| within(name, "mm", 0.3 * sizes.displacement, 0.995 * sizes.displacement);
        match self {
            Self::Power => vec![gap("g"), within("p", "", 1.0, 4.0)],
            _ if self.is_uneven() => vec![gap("g"), gap("g_n")],
            _ => vec![gap("g")],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let at = |share: f64| share * sizes.displacement;
        if self.is_uneven() {
            return GAPS.iter().flat_map(|a| GAPS.map(|b| vec![at(*a), at(b)])).collect();
        }
        let gaps = [0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.975].map(at);
        if *self == Self::Power {
            return gaps.iter().flat_map(|gap| [1.2, 2.5].map(|p| vec![*gap, p])).collect();
        }
        gaps.iter().map(|gap| vec![*gap]).collect()
    }

    fn own(&self) -> Option<&'static str> {
        self.dissipates().then_some("k_c")
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let spring = each(scene.displacement, |x| {
            let depth = self.depth(x, shape);
            match self {
                Self::Power => depth.abs().powf(shape[1]).copysign(depth),
                _ if self.is_round() => depth.abs().powf(1.5).copysign(depth),
                _ => depth,
            }
        });
        let damping = self
            .dissipates()
            .then(|| spring.iter().zip(scene.velocity).map(|(spring, v)| spring.abs() * v).collect());
        iter::once(spring).chain(damping).collect()
    }
}
