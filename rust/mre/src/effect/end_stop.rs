//! End stop: beyond a gap the device meets a second, stiff spring.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_c` | stiffness of the stop | N/mm, or N/mm^1.5 for Hertz contact | >= 0 |
//! | `c_c` | damping of the contact, over the power 1.5 of its depth | N s/mm^2.5 | >= 0 |
//! | g | gap; where the ends differ, of the positive one | mm | 30 % to 99.5 % of the largest stroke |
//! | `g_n` | gap of the negative end, where it is another | mm | 30 % to 99.5 % of the largest stroke |
//!
//! Reference: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440.
//! Known limit: with few samples past the gap it is a stiffening spring.

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

    /// How deep the contact is at a displacement, mm: negative at the negative end.
    fn depth(self, x: f64, gaps: &[f64]) -> f64 {
        let (positive, negative) = (gaps[0], gaps[gaps.len() - 1]);
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
        let mut found = vec![positive("k_c", if self.is_round() { "N/mm^1.5" } else { "N/mm" })];
        if *self == Self::HuntCrossley {
            found.push(positive("c_c", "N s/mm^2.5"));
        }
        found
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let gap = |name| within(name, "mm", 0.3 * sizes.displacement, 0.995 * sizes.displacement);
        if self.is_uneven() { vec![gap("g"), gap("g_n")] } else { vec![gap("g")] }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let at = |share: f64| share * sizes.displacement;
        if self.is_uneven() {
            return GAPS.iter().flat_map(|a| GAPS.map(|b| vec![at(*a), at(b)])).collect();
        }
        [0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.975].iter().map(|share| vec![at(*share)]).collect()
    }

    fn own(&self) -> Option<&'static str> {
        (*self == Self::HuntCrossley).then_some("k_c")
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let spring = each(scene.displacement, |x| {
            let depth = self.depth(x, shape);
            if self.is_round() { depth.abs().powf(1.5).copysign(depth) } else { depth }
        });
        let mut found = vec![spring];
        if *self == Self::HuntCrossley {
            found.push(found[0].iter().zip(scene.velocity).map(|(spring, v)| spring.abs() * v).collect());
        }
        found
    }
}
