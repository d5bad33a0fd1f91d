//! Recordings on which the benchmarks run.
