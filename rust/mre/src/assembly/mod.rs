//! A base model and effects as one model: for given nonlinear parameters a sum of columns with linear
//! coefficients, seen through a measurement chain.

mod base;
mod campaign;
mod layout;
mod simulate;

pub use base::Base;
pub use campaign::Campaign;
pub use layout::{Assembly, Columns};
pub use simulate::{Addition, simulate};
