//! Benchmarks of the swarms.
fn main() {}
