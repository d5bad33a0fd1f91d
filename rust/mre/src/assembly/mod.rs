//! A base model and effects as one model: for given nonlinear parameters a sum of columns with linear
//! coefficients, seen through a measurement chain.

mod another;
mod base;
mod base_columns;
mod campaign;
mod columns;
mod effect_columns;
mod fading;
mod halves;
mod in_series;
mod kept;
mod layout;
mod metered;
mod motion;
mod shaken;
mod simulate;

pub(crate) use another::OnAnother;
pub use base::Base;
pub use campaign::Campaign;
pub use columns::Columns;
pub use kept::Kept;
pub use layout::Assembly;
pub(crate) use motion::Doubts;
pub use simulate::{Addition, Source, simulate, temperature_known};
