//! Fitness kernels: the squared error of many candidates over one recording.
//!
//! The code is plain Rust in a form that the compiler spreads over SIMD lanes. It is compiled for
//! several instruction sets, and the best one for the machine is chosen at run time.

// Lane loops are written as index loops over arrays, inlined into one function per instruction set.
#![allow(clippy::inline_always, clippy::needless_range_loop)]

pub(crate) mod bessel;
pub(crate) mod bouc_wen_gram;
mod bouc_wen_rk4;
pub(crate) mod climb;
mod dispatch;
pub(crate) mod elementary;
#[cfg(test)]
pub(crate) mod example;
pub(crate) mod filter;
pub(crate) mod halfway;
pub(crate) mod hysteretic;
pub(crate) mod hysteretic_traces;
mod interval;
pub(crate) mod intervals;
pub(crate) mod jumps;
mod lanes;
pub(crate) mod recursion;
pub(crate) mod relaxation;
mod sinh;
pub(crate) mod sinh_compressed;
mod sinh_direct;
mod sinh_series;
pub(crate) mod slope;
pub(crate) mod spline;
pub(crate) mod state_change;
mod total;
pub(crate) mod triangle;

pub(crate) use bouc_wen_rk4::BoucWenRk4;
pub(crate) use lanes::LANES;
pub(crate) use sinh::Sinh;
pub(crate) use sinh_compressed::SinhCompressed;
