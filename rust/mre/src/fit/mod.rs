//! Exact fits: linear coefficients by projection, shapes by search and polish.

mod bounded;
pub mod certified;
mod descent;
mod edges;
mod gauss_newton;
mod projection;
mod refine;
mod solve;

pub(crate) use solve::refit;
pub use solve::{Fit, exact, hybrid};
