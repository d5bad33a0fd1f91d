//! The first fit of the base model, from several starts, and the noise that it leaves.

use std::sync::Arc;

use super::candidates::{Candidate, noise_left};
use super::joint::{best_of, fit};
use super::least_squares::{Data, Fitted, refine};
use super::monitor::Monitor;
use super::noise::Noise;
use super::normal::Rows;
use crate::assembly::{Assembly, Base, Campaign};
use crate::effect::{
    CurrentWander, Effect, InitialHysteresis, InitialState, Quantisation, current_wanders, starts_in_motion,
};

/// Steps of the first descents.
const FEW: usize = 8;

/// An effect that belongs to the base, with the shapes from which its fit starts.
pub type Given = (&'static dyn Effect, Vec<f64>);

/// A base on a campaign with its fit; effects refer to its force.
#[derive(Clone)]
pub(super) struct Begun<'a> {
    /// The base, with the effects that belong to it.
    pub(super) assembly: Assembly<'a>,
    /// Its fit on whitened data.
    pub(super) fitted: Fitted,
    /// Noise that it leaves.
    pub(super) noise: Noise,
}

/// Fit a base on the rows that count, with effects that belong to it.
///
/// Where a recording starts in motion, the remainders of its unknown initial states are one of them; where a constant
/// current wanders, what follows it is; where the force is measured in steps, their saw tooth is.
pub(super) fn begin<'a>(
    campaign: &'a Campaign,
    base: &'a Base,
    given: &[Given],
    rows: &[Rows],
    monitor: &dyn Monitor,
) -> Begun<'a> {
    let count = campaign.recordings().len();
    let nothing = campaign.recordings().iter().map(|r| vec![0.0; r.len()]).collect();
    let mut effects: Vec<&'static dyn Effect> = given.iter().map(|(effect, _)| *effect).collect();
    let in_motion = campaign.recordings().iter().any(|r| starts_in_motion(r));
    let state = in_motion && base.is_hysteretic();
    if in_motion {
        effects.push(&InitialState);
    }
    if state {
        effects.push(&InitialHysteresis);
    }
    let largest = campaign.sizes().current.map_or(0.0, |(_, largest)| largest);
    let wanders = campaign.recordings().iter().any(|r| current_wanders(r, largest));
    if wanders && !base.groups().is_empty() {
        effects.push(&CurrentWander);
    }
    if campaign.sizes().quantum.is_some() {
        effects.push(&Quantisation);
    }
    let shapes: Vec<f64> = given.iter().flat_map(|(_, shape)| shape.clone()).collect();
    let assembly = Assembly::new(campaign, base, effects, Arc::new(nothing));
    let white = Noise::white(count, 0.01 * campaign.sizes().force);
    let data = Data { noise: &white, rows, monitor };
    let known = assembly.base_shapes();
    let mut all = vec![0.0; known];
    all.extend(shapes);
    let given = assembly.unit(&all).split_off(known);
    let points = starts(base).iter().map(|start| [start.as_slice(), &given].concat()).collect();
    let first = best_of(&assembly, data, points, &[(1, FEW)]).map_or_else(Vec::new, |fit| fit.unit);
    let coarse = refine(&assembly, data, &first);
    let noise = noise_left(&assembly, data, &coarse);
    let data = Data { noise: &noise, rows, monitor };
    let mut fitted = refine(&assembly, data, &coarse.unit);
    let mut assembly = assembly;
    for _ in 0..if state { 2 } else { 1 } {
        let force = assembly.base_force(&fitted.unit, &fitted.coefficients);
        let referring = assembly.referring_to(force).fading(&assembly.physical(&fitted.unit));
        Candidate { assembly, fitted } = fit(referring, data, &fitted.unit);
    }
    let noise = noise_left(&assembly, data, &fitted);
    Begun { assembly, fitted, noise }
}

/// Points of the unit box for the shapes of the base: the same place in each group.
pub(super) fn starts(base: &Base) -> Vec<Vec<f64>> {
    let shapes = base.groups().first().map_or(0, |g| g.shapes.len());
    let places: Vec<Vec<f64>> = match shapes {
        0 => vec![Vec::new()],
        1 => [0.1, 0.35, 0.7].iter().map(|u| vec![*u]).collect(),
        _ => [0.1, 0.3, 0.5, 0.7, 0.9]
            .iter()
            .flat_map(|first| {
                [0.1, 0.5].iter().map(move |last| {
                    let mut start = vec![0.3; shapes];
                    (start[0], start[shapes - 1]) = (*first, *last);
                    start
                })
            })
            .collect(),
    };
    places.into_iter().map(|start| start.repeat(base.groups().len())).collect()
}
