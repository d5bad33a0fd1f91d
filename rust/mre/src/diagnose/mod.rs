//! Diagnosis: is anything missing, where, what, and does it help on data that took no part.
//!
//! All fits are least squares on whitened data: what an autoregression of each recording's noise cannot
//! predict. The base model is refitted together with every candidate, because its parameters bend
//! to hide an effect.

mod absorbed;
mod alternatives;
mod begin;
mod bounded;
mod candidates;
mod distribution;
mod drift;
mod features;
mod held;
mod hum;
mod intervals;
mod judge;
mod least_squares;
mod locate;
mod missing;
mod next_test;
mod noise;
mod normal;
mod plain_mismatch;
mod prove;
mod run;
mod screen;
mod search;
mod settings;
mod step;
mod unknown;
mod verdict;

pub use absorbed::Absorbed;
pub use begin::Given;
pub use candidates::Candidate;
pub use features::On;
pub use intervals::{Estimate, Estimates};
pub use least_squares::Fitted;
pub use locate::{Finding, Place};
pub use next_test::{KINDS, Kind, Limits, NextTest, Prospect, Signal};
pub use noise::Noise;
pub use normal::Rows;
pub use prove::Proof;
pub use run::{Diagnosis, Effect, beside, run};
pub use screen::Score;
pub use search::Named;
pub use settings::Settings;
pub use unknown::{Dependence, Map, Unknown};
pub use verdict::{Evidence, Verdict};
