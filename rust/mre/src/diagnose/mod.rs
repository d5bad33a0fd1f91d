//! Diagnosis: is anything missing, where, what, and does it help on data that took no part.
//!
//! All fits are least squares on whitened data: what an autoregression of each recording's noise cannot
//! predict. The base model is refitted together with every candidate, because its parameters bend
//! to hide an effect.

mod absorbed;
mod alternatives;
mod autoregression;
mod begin;
mod blank;
mod block;
mod bounded;
mod candidates;
mod clipped;
mod coherent;
mod correction;
mod diagnosis;
mod distribution;
mod drift;
mod exchange;
mod explained;
mod features;
mod firsts;
mod gaps;
mod held;
mod hum;
mod intervals;
mod judge;
mod least_squares;
mod locate;
mod look;
mod missing;
mod monitor;
mod needless;
mod next_test;
mod noise;
mod normal;
mod null;
mod plain_mismatch;
mod point;
mod prove;
mod realisation;
mod refitted;
mod run;
mod screen;
mod search;
mod settings;
mod slow;
mod splits;
mod starts;
mod step;
mod unknown;
mod unnamed;
mod verdict;
mod worth;

pub use absorbed::Absorbed;
pub use begin::Given;
pub use blank::{Blank, blank};
pub use candidates::Candidate;
pub use diagnosis::{Diagnosis, Effect, HeldOut, Judgement};
pub use features::On;
pub use intervals::{Estimate, Estimates};
pub use least_squares::Fitted;
pub use locate::{Finding, Place};
pub use monitor::{Monitor, Stage};
pub use next_test::{KINDS, Kind, Limits, NextTest, Prospect, Signal};
pub use noise::Noise;
pub use normal::Rows;
pub use prove::Proof;
pub use refitted::{Refitted, refitted};
pub use run::{beside, run};
pub use screen::Score;
pub use search::Named;
pub use settings::Settings;
pub use unknown::{Dependence, Map, Unknown};
pub use verdict::{Evidence, Verdict};
