//! Field remanence: the field depends on past currents.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_q`, `c_q` | change of stiffness and damping with the remanent current | N/(A mm), N s/(A mm) | any |
//! | r | share of the remanent current that the device sees | - | 0 to 0.95 |
//! | `i_r` | half width of the play of the current, or of the widest of many | A | 1 % to 50 % of its span |
//!
//! The remanent current q is the play of the current less the current, or the largest past current less the
//! current. The device starts demagnetised to the first current, or to zero, from which it was raised to the first.
//! Either all that follows the current in the base model follows the remanent one too, or stiffness and damping do
//! in their own measure.
//! Reference: Jiles and Atherton, J. Magn. Magn. Mater. 61 (1986) 48; Krasnosel'skii and Pokrovskii, Systems with
//! Hysteresis, 1989 (play); Mayergoyz, Mathematical Models of Hysteresis, 1991 (plays of many widths).
//! Known limit: on a current that only rises or only falls it is drift or field dependence.

use super::operators::{play, play_from};
use super::{About, Effect, Scene, Sizes, order_within, signed, within};
use crate::parameter::Parameter;

/// What of the past is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Remanence {
    /// The play of the current.
    Play,
    /// The largest current.
    Largest,
    /// The largest current, seen by all of the base model.
    LargestSeen,
    /// Plays of many widths, seen by all of the base model.
    PlaysSeen,
    /// The same, where the first current was reached from zero.
    RaisedPlaysSeen,
    /// The same, whose first rise follows the current.
    FollowingPlaysSeen,
}

/// Widths of plays.
const WIDTHS: usize = 6;

/// Half widths that spread evenly up to `widest`.
fn widths(widest: f64) -> impl Iterator<Item = f64> {
    (1..=WIDTHS).map(move |k| widest * k as f64 / WIDTHS as f64)
}

/// Mean of plays of such widths, all at `start` before the first sample.
fn plays(current: &[f64], widest: f64, start: f64) -> Vec<f64> {
    let mut mean = vec![0.0; current.len()];
    for width in widths(widest) {
        let one = play_from(start, current, width);
        mean.iter_mut().zip(one).for_each(|(sum, p)| *sum += p / WIDTHS as f64);
    }
    mean
}

impl Remanence {
    /// Remanent current, A.
    fn remanent(self, scene: &Scene, current: &[f64], width: Option<&f64>) -> Vec<f64> {
        let width = width.copied().unwrap_or_default();
        let past = match self {
            Self::Play => play(current, width),
            Self::PlaysSeen => plays(current, width, current[0]),
            Self::RaisedPlaysSeen => plays(current, width, 0.0),
            Self::FollowingPlaysSeen => {
                let slack = |i: f64| widths(width).map(|r| i.clamp(-r, r)).sum::<f64>() / WIDTHS as f64;
                let plays = plays(current, width, 0.0);
                plays.iter().zip(current).map(|(p, i)| p + slack(*i)).collect()
            }
            Self::Largest | Self::LargestSeen => {
                scene.trace(current[0], |largest, i| largest.max(current[i]))
            }
        };
        past.iter().zip(current).map(|(p, i)| p - i).collect()
    }

    /// True where all of the base model sees it.
    fn seen(self) -> bool {
        !matches!(self, Self::Play | Self::Largest)
    }
}

/// Columns of stiffness and damping that follow a series.
pub(super) fn following(scene: &Scene, q: &[f64]) -> Vec<Vec<f64>> {
    [scene.displacement, scene.velocity].map(|s| q.iter().zip(s).map(|(q, s)| q * s).collect()).into()
}

impl Effect for Remanence {
    fn about(&self) -> About {
        let play = About {
            effect: "field_remanence",
            law: "play",
            plain: "the field remembers past currents: rising and falling currents differ",
            equation: "F_q = (k_q x + c_q v) q, q = play of the current with half width i_r, less the current",
            reference: "Jiles and Atherton 1986; Krasnosel'skii and Pokrovskii 1989",
            limit: "on a current that only rises or only falls it is drift or field dependence",
        };
        match self {
            Self::Play => play,
            Self::Largest => About {
                law: "largest past current",
                equation: "F_q = (k_q x + c_q v) q, q = largest past current less the current",
                ..play
            },
            Self::LargestSeen => About {
                law: "largest past current, seen",
                equation: "the device sees I + r q, q = largest past current less the current",
                ..play
            },
            Self::PlaysSeen => About {
                law: "plays, seen",
                equation: "the device sees I + r q, q = mean of plays of the current up to i_r, less the current",
                reference: "Mayergoyz 1991; Krasnosel'skii and Pokrovskii 1989",
                ..play
            },
            Self::RaisedPlaysSeen => About { law: "plays, seen, from zero", ..Self::PlaysSeen.about() },
            Self::FollowingPlaysSeen => About {
                law: "plays, seen, first rise followed",
                equation: "the device sees I + r q, q = mean of plays of the current up to i_r, and of the current \
                           within i_r, less the current",
                ..Self::PlaysSeen.about()
            },
        }
    }

    fn applies(&self, sizes: &Sizes) -> bool {
        sizes.current_varies
    }

    fn coefficients(&self) -> Vec<Parameter> {
        if self.seen() { Vec::new() } else { vec![signed("k_q", "N/(A mm)"), signed("c_q", "N s/(A mm)")] }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let span = sizes.current_span();
        let share = within("r", "", 0.0, 0.95);
        let width = order_within("i_r", "A", 0.01 * span, 0.5 * span);
        match self {
            Self::Play => vec![width],
            Self::Largest => Vec::new(),
            Self::LargestSeen => vec![share],
            _ => vec![share, width],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let widths = [0.03, 0.1, 0.2, 0.4].map(|share| share * sizes.current_span());
        match self {
            Self::Play => widths.map(|width| vec![width]).into(),
            Self::Largest => vec![Vec::new()],
            Self::LargestSeen => vec![vec![0.1]],
            _ => widths.map(|width| vec![0.2, width]).into(),
        }
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        if self.seen() {
            return Vec::new();
        }
        let still = vec![0.0; scene.len()];
        let current = scene.current.unwrap_or(&still);
        following(scene, &self.remanent(scene, current, shape.first()))
    }

    fn current(&self, scene: &Scene, shape: &[f64]) -> Option<Vec<f64>> {
        let current = scene.current.filter(|_| self.seen())?;
        let q = self.remanent(scene, current, shape.get(1));
        Some(current.iter().zip(q).map(|(i, q)| i + shape[0] * q).collect())
    }
}
