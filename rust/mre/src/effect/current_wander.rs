//! Wander of the current about its level: a coil that warms lets a constant current sag, and the device follows it.
//!
//! No effect of the catalogue, but a part of the model of recordings at constant currents: a base has its parameters for the
//! level alone, and what they change by within it is, to first order, a stiffness, a damping and a share of the force of the
//! base in proportion to the current less its mean over the recording.
//! Known limit: a softening that goes as the current does is not told from it.

use super::{About, Effect, Scene, Sizes, signed};
use crate::parameter::Parameter;
use crate::recording::{Recording, mean};
use crate::spread::deviation;

/// Parts of a recording over which the current is averaged.
const PARTS: usize = 8;
/// It wanders where their means differ by more than so many of their standard deviations.
const PLAINLY: f64 = 6.0;
/// And by more than this share of the level.
const LEAST: f64 = 2e-3;

/// Forces in proportion to the wander.
#[derive(Debug, Clone, Copy)]
pub struct CurrentWander;

/// True where a current that counts as constant wanders.
pub fn current_wanders(recording: &Recording) -> bool {
    let (Some(level), Some(current)) = (recording.current().level(), recording.current().series()) else {
        return false;
    };
    let parts: Vec<&[f64]> = current.chunks(current.len().div_ceil(PARTS)).collect();
    let means: Vec<f64> = parts.iter().map(|part| mean(part)).collect();
    let rest: Vec<f64> =
        parts.iter().zip(&means).flat_map(|(part, mean)| part.iter().map(move |i| i - mean)).collect();
    let scatter = deviation(&rest) * (PARTS as f64 / current.len() as f64).sqrt();
    let (low, high) = crate::recording::extent(&means);
    high - low > (PLAINLY * scatter).max(LEAST * level.abs())
}

/// The current less its mean, smoothed: what is fast is noise of its meter.
fn wander(scene: &Scene) -> Option<Vec<f64>> {
    let current = scene.current?;
    let (middle, half) = (mean(current), current.len() / (2 * PARTS));
    let near = |i: usize| i.saturating_sub(half)..(i + half + 1).min(current.len());
    let mut sums = vec![0.0];
    for i in current {
        sums.push(sums[sums.len() - 1] + i - middle);
    }
    let over = |r: std::ops::Range<usize>| (sums[r.end] - sums[r.start]) / r.len() as f64;
    Some((0..current.len()).map(|i| over(near(i))).collect())
}

impl Effect for CurrentWander {
    fn about(&self) -> About {
        About {
            effect: "current_wander",
            law: "first order",
            plain: "the current wanders about its level",
            equation: "F += (k_i x + c_i v + s_i F) (I - mean I)",
            reference: "general",
            limit: "a softening that goes as the current does",
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![signed("k_i", "N/(mm A)"), signed("c_i", "N s/(mm A)"), signed("s_i", "1/A")]
    }

    fn shape(&self, _: &Sizes) -> Vec<Parameter> {
        Vec::new()
    }

    fn starts(&self, _: &Sizes) -> Vec<Vec<f64>> {
        vec![Vec::new()]
    }

    fn columns(&self, scene: &Scene, _: &[f64]) -> Vec<Vec<f64>> {
        let Some(wander) = wander(scene) else { return vec![vec![0.0; scene.len()]; 3] };
        let times = |series: &[f64]| series.iter().zip(&wander).map(|(y, i)| y * i).collect();
        [scene.displacement, scene.velocity, scene.force].map(times).to_vec()
    }
}
