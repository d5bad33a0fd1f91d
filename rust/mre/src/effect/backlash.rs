//! Backlash: free play between the actuator and the device.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | g | half the free play | mm | 0.04 % of the largest stroke, or three times the noise of the displacement, to half of the stroke |
//! | c | its middle | mm | half the largest stroke to either side |
//!
//! Reference: Nordin and Gutman, Automatica 38 (2002) 1633.
//! Known limit: where g is small against all strokes only the jumps at reversals show it. The middle is sought on both sides
//! of zero, not of the middle of a motion with an offset.

use super::operators::each;
use super::{About, Effect, Motion, Scene, Sizes, within};
use crate::parameter::Parameter;

/// Form of the free play.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Backlash {
    /// No elastic force within the gap.
    DeadZone,
    /// The same with round edges.
    RoundDeadZone,
    /// No force at all within the gap.
    FreeDeadZone,
    /// The spring is held in its middle within a gap that is elsewhere.
    OffCentre,
    /// So is the whole device.
    FreeOffCentre,
    /// The device stays where it was left until the gap is crossed.
    Play,
    /// Its spring alone does.
    SpringPlay,
}

/// Gaps that are tried where the velocity jumps with them: the smallest over the largest displacement, by which factor
/// they rise, and how many they are.
const SMALLEST: f64 = ABOVE * LEAST;
const RATIO: f64 = 1.6;
const COUNT: i32 = 14;

/// A gap below this share of the largest displacement is none, nor one within so many standard deviations of the noise of a
/// displacement: where a motion rests, it would take off what is left of that.
const LEAST: f64 = 4e-4;
const NOISE: f64 = 3.0;
/// And the smallest that is tried is so many times as large.
const ABOVE: f64 = 1.2;

/// Gaps and their middles that are tried, over the largest displacement.
const GAPS: [f64; 4] = [0.01, 0.03, 0.08, 0.2];
const MIDDLES: [f64; 4] = [-0.3, -0.1, 0.1, 0.3];

const OFF_CENTRE: &str = "there is free play: at a place beside the middle the device is not moved";

/// The smallest gap that is one, mm; under much noise a box is left all the same.
fn least(sizes: &Sizes) -> f64 {
    (LEAST * sizes.displacement).max(NOISE * sizes.noise).min(0.25 * sizes.displacement)
}

/// Displacement beyond a gap of half width `g`.
pub(super) fn beyond(x: f64, g: f64) -> f64 {
    x - x.clamp(-g, g)
}

/// What a gap of half width `g` with round edges takes of a displacement.
fn round(x: f64, g: f64) -> f64 {
    if g > 0.0 { g * (x / g).tanh() } else { 0.0 }
}

/// Displacement of what is dragged with a gap of half width `g`: it stops where the motion turns, which is between
/// samples.
fn dragged(scene: &Scene, g: f64) -> Vec<f64> {
    let (time, x, v) = (scene.time, scene.displacement, scene.velocity);
    scene.trace(x[0], |p, i| {
        let (from, to) = (v[i - 1], v[i]);
        let turned = if from * to < 0.0 {
            let turn = x[i - 1] + 0.5 * (time[i] - time[i - 1]) * from * from / (from - to);
            p.max(turn - g).min(turn + g)
        } else {
            p
        };
        turned.max(x[i] - g).min(x[i] + g)
    })
}

impl Effect for Backlash {
    fn about(&self) -> About {
        let dead_zone = About {
            effect: "backlash",
            law: "dead zone",
            plain: "there is free play: near the middle the device is not loaded",
            equation: "the device sees x - min(max(x, -g), g)",
            reference: "Nordin and Gutman 2002",
            limit: "where the play is small against all strokes it is hardly visible",
        };
        match self {
            Self::DeadZone => dead_zone,
            Self::RoundDeadZone => About {
                law: "dead zone with round edges",
                equation: "the device sees x - g tanh(x/g) and its velocity",
                ..dead_zone
            },
            Self::FreeDeadZone => About {
                law: "dead zone without damping",
                equation: "the device sees x - min(max(x, -g), g) and its velocity",
                ..dead_zone
            },
            Self::OffCentre => About {
                law: "dead zone off centre",
                plain: OFF_CENTRE,
                equation: "the device sees x - min(max(x - c, -g), g)",
                ..dead_zone
            },
            Self::FreeOffCentre => About {
                law: "dead zone off centre, without damping",
                plain: OFF_CENTRE,
                equation: "the device sees x - min(max(x - c, -g), g) and its velocity",
                ..dead_zone
            },
            Self::Play => About {
                law: "play",
                plain: "there is free play: after each reversal the device is not moved at first",
                equation: "the device sees p = max(x - g, min(x + g, p before)) and its velocity",
                ..dead_zone
            },
            Self::SpringPlay => About {
                law: "play of the spring",
                plain: "there is free play: after each reversal the spring is not moved at first",
                equation: "the device sees p = max(x - g, min(x + g, p before)) and the velocity of x",
                ..dead_zone
            },
        }
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let half = 0.5 * sizes.displacement;
        let gap = Parameter { smallest: 0.0, ..within("g", "mm", least(sizes), half) };
        match self {
            Self::OffCentre | Self::FreeOffCentre => vec![gap, within("c", "mm", -half, half)],
            _ => vec![gap],
        }
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let shares: Vec<f64> = match self {
            Self::OffCentre | Self::FreeOffCentre => GAPS.to_vec(),
            Self::DeadZone | Self::RoundDeadZone => vec![0.003, 0.01, 0.03, 0.08, 0.16, 0.3],
            // One of twice the right size explains nothing, and the fit jumps from sample to sample.
            Self::FreeDeadZone | Self::Play | Self::SpringPlay => {
                (0..COUNT).map(|k| SMALLEST * RATIO.powi(k)).collect()
            }
        };
        let size = sizes.displacement;
        let mut gaps: Vec<f64> =
            shares.iter().map(|share| (share * size).max(ABOVE * least(sizes))).collect();
        gaps.dedup();
        let off_centre = |g: f64| MIDDLES.map(|c| vec![g, c * size]);
        match self {
            Self::OffCentre | Self::FreeOffCentre => gaps.into_iter().flat_map(off_centre).collect(),
            _ => gaps.into_iter().map(|g| vec![g]).collect(),
        }
    }

    /// Elsewhere the gap is one of the spring.
    fn moves_the_device(&self) -> bool {
        matches!(self, Self::FreeDeadZone | Self::FreeOffCentre | Self::Play)
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let (x, v, g) = (scene.displacement, scene.velocity, shape[0]);
        let displacement = match self {
            Self::DeadZone | Self::FreeDeadZone => each(x, |x| beyond(x, g)),
            Self::RoundDeadZone => each(x, |x| x - round(x, g)),
            Self::OffCentre | Self::FreeOffCentre => each(x, |x| x - (x - shape[1]).clamp(-g, g)),
            Self::Play | Self::SpringPlay => dragged(scene, g),
        };
        let moving = |i: usize| match self {
            Self::RoundDeadZone if g > 0.0 => ((x[i] - displacement[i]) / g).powi(2),
            Self::DeadZone | Self::RoundDeadZone | Self::OffCentre | Self::SpringPlay => 1.0,
            Self::FreeDeadZone => f64::from(displacement[i] != 0.0),
            Self::FreeOffCentre => f64::from((x[i] - shape[1]).abs() > g),
            // At one end of the gap.
            Self::Play => f64::from((x[i] - displacement[i]).abs() >= g * (1.0 - 1e-9)),
        };
        let velocity = v.iter().enumerate().map(|(i, v)| moving(i) * v).collect();
        Some(Motion { displacement, velocity })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Condition, Recording, Series};

    #[test]
    fn a_gap_within_the_noise_is_none_and_every_start_is_in_its_box() -> crate::error::Result<()> {
        let time: Vec<f64> = (0..100).map(|i| f64::from(i) / 50.0).collect();
        let recording = Recording::new(Series {
            displacement: time.iter().map(|t| 5.0 * (6.0 * t).sin()).collect(),
            velocity: None,
            force: Some(vec![1.0; time.len()]),
            simulated: None,
            current: Condition::Missing,
            temperature: Condition::Missing,
            name: "sine".into(),
            time,
        })?;
        let plain = Sizes::of(std::iter::once(&recording));
        for noise in [0.0, 0.01, 0.3, 10.0] {
            let sizes = Sizes { noise, ..plain.clone() };
            let wanted = (3.0 * noise).clamp(LEAST * sizes.displacement, 0.25 * sizes.displacement);
            for law in [Backlash::Play, Backlash::SpringPlay, Backlash::RoundDeadZone, Backlash::OffCentre] {
                let shape = law.shape(&sizes);
                assert!((shape[0].lower - wanted).abs() < 1e-12, "{law:?} {noise}");
                let starts = law.starts(&sizes);
                let inside = |start: &Vec<f64>| {
                    start.iter().zip(&shape).all(|(value, p)| (p.lower..=p.upper).contains(value))
                };
                assert!(!starts.is_empty() && starts.iter().all(inside), "{law:?} {noise} {starts:?}");
            }
        }
        Ok(())
    }
}
