//! Wander of the current about its level: a coil that warms lets a constant current sag, and the device follows it.
//!
//! No effect of the catalogue, but a part of the model of recordings at constant currents: a base has its parameters for the
//! level alone, and what they change by within it is, to first order, a stiffness, a damping and a share of the force of the
//! base in proportion to the current less its mean over the recording.
//! Known limit: a softening that goes as the current does is not told from it, however large; levels share the slopes.

use std::ops::Range;

use super::{About, Effect, Scene, Sizes, signed};
use crate::parameter::Parameter;
use crate::recording::{Condition, Recording, extent, mean};

/// Parts of a recording over which the current is averaged.
const PARTS: usize = 8;
/// It wanders where their means differ by more than so many of their standard deviations.
const PLAINLY: f64 = 6.0;
/// And by more than this share of the largest current.
const LEAST: f64 = 2e-3;

/// Forces in proportion to the wander.
#[derive(Debug, Clone, Copy)]
pub struct CurrentWander;

/// True where a current that counts as constant wanders, beside the largest of the campaign.
pub fn current_wanders(recording: &Recording, largest: f64) -> bool {
    let Condition::Series(current) = recording.current() else { return false };
    recording.current().level().is_some() && wanders(current, largest)
}

fn wanders(current: &[f64], largest: f64) -> bool {
    let part = current.len() / PARTS;
    if part == 0 {
        return false;
    }
    let parts: Vec<&[f64]> = current.chunks_exact(part).collect();
    let means: Vec<f64> = parts.iter().map(|part| mean(part)).collect();
    let rest = parts.iter().zip(&means).flat_map(|(part, mean)| part.iter().map(move |i| (i - mean).powi(2)));
    let scatter = (rest.sum::<f64>() / current.len() as f64 / part as f64).sqrt();
    let (low, high) = extent(&means);
    high - low > (PLAINLY * scatter).max(LEAST * largest)
}

/// The current less its mean, smoothed: what is fast is noise of its meter. None where it does not wander, or changes.
fn wander(scene: &Scene) -> Option<Vec<f64>> {
    let current = scene.current?;
    let (_, largest) = scene.sizes.current?;
    if Condition::Series(current.to_vec()).varies() || !wanders(current, largest) {
        return None;
    }
    let (middle, half) = (mean(current), current.len() / (2 * PARTS));
    let near = |i: usize| i.saturating_sub(half)..(i + half + 1).min(current.len());
    let mut sums = vec![0.0];
    for i in current {
        sums.push(sums[sums.len() - 1] + i - middle);
    }
    let over = |r: Range<usize>| (sums[r.end] - sums[r.start]) / r.len() as f64;
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
