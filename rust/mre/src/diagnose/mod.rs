//! Diagnosis: is anything missing, where, what, and does it help on data that took no part.
//!
//! All fits are least squares on whitened data: what an autoregression of each recording's noise cannot
//! predict. The base model is refitted together with every candidate, because its parameters bend
//! to hide an effect.

mod begin;
mod distribution;
mod least_squares;
mod name;
mod noise;
mod normal;
mod screen;

pub use begin::{Begun, begin};
pub use least_squares::{Data, Fitted, refine};
pub use name::{Candidate, Named, name};
pub use noise::Noise;
pub use normal::Rows;
pub use screen::Score;
