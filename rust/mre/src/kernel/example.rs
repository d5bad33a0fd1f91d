//! A recording for the tests of the kernels.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use crate::recording::{Condition, Recording, Series};

/// 503 samples (no multiple of any number of lanes) of a sine with a stiffening force.
pub(crate) fn recording() -> Arc<Recording> {
    let time: Vec<f64> = (0..503).map(|i| f64::from(i) / 100.0).collect();
    let displacement: Vec<f64> = time.iter().map(|t| 4.0 * (6.0 * t).sin()).collect();
    let force = displacement.iter().zip(&time).map(|(x, t)| 9.0 * x.sinh() + (70.0 * t).sin()).collect();
    let series = Series {
        time,
        displacement,
        velocity: None,
        force: Some(force),
        simulated: None,
        current: Condition::Missing,
        temperature: Condition::Missing,
        name: String::new(),
    };
    Arc::new(Recording::new(series).unwrap())
}
