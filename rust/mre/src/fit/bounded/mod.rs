//! Linear least squares within a box: the coefficients of a model, given its shapes.
//!
//! Active set (BVLS, Stark and Parker 1995, <https://doi.org/10.1007/bf02187725>): the free coefficients
//! are solved with the others on their bounds; one that would leave its bounds is stopped there, and one
//! that a bound holds against the slope is freed. The answer is exact to rounding.
//! A column that depends on the others keeps its coefficient where it is.

pub(crate) mod factor;
mod gram;

pub(crate) use gram::minimise;
