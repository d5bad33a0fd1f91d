//! Builds the C rivals for the machine that runs the benchmarks.

fn main() {
    println!("cargo::rerun-if-changed=c/rivals.c");
    cc::Build::new()
        .file("c/rivals.c")
        .opt_level(3)
        .flag_if_supported("-march=native")
        .flag_if_supported("-ffast-math")
        .compile("rivals");
}
