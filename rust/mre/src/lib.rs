//! Hysteresis models of magnetorheological elastomer isolators and dampers: simulation and
//! identification by artificial fish swarms and particle swarms.
//!
//! Units everywhere: millimetre, newton, second, ampere, degree Celsius.
//!
//! ```
//! use std::sync::{Arc, atomic::AtomicBool};
//! use mre::{fitness::{Problem, Weights}, model::Model, recording::{Condition, Recording, Series}};
//!
//! let time: Vec<f64> = (0..1000).map(|i| f64::from(i) / 256.0).collect();
//! let turn = std::f64::consts::TAU;
//! let displacement: Vec<f64> = time.iter().map(|t| 2.0 * (turn * t).sin()).collect();
//! let velocity: Vec<f64> = time.iter().map(|t| 2.0 * turn * (turn * t).cos()).collect();
//! let force: Vec<f64> = displacement.iter().zip(&velocity).map(|(x, v)| 5.0 * x + 0.3 * v).collect();
//! let recording = Recording::new(Series {
//!     time,
//!     displacement,
//!     velocity: Some(velocity),
//!     force: Some(force),
//!     simulated: None,
//!     current: Condition::Constant(0.0),
//!     temperature: Condition::Missing,
//!     name: "example".into(),
//! })?;
//! let model = Model::named("kelvin_voigt")?;
//! let problem = Problem::new(vec![Arc::new(recording)], model, &[], &Weights::Samples)?;
//! let mut cost = [0.0];
//! problem.fitness(&[0.3, 5.0, 0.0], &mut cost, &AtomicBool::new(false));
//! assert!(cost[0] < 1e-20);
//! # Ok::<(), mre::error::Error>(())
//! ```

pub mod assembly;
mod deviate;
pub mod device;
pub mod diagnose;
pub mod effect;
pub mod error;
pub mod extent;
pub mod fit;
pub mod fitness;
mod kernel;
pub mod law;
pub mod model;
pub mod over;
pub mod parameter;
pub mod physics;
pub mod recording;
mod spread;
pub mod swarm;
pub mod transient;
pub mod uncertainty;
pub mod velocity;
