//! The kernels as a C programmer would write them (`c/rivals.c`), to race against.

use mre::recording::Recording;

/// Candidates that the C version of Bouc-Wen simulates side by side.
pub const LANES: usize = 16;

#[allow(unsafe_code)] // calling C
mod c {
    use super::LANES;

    unsafe extern "C" {
        pub(super) unsafe fn rival_sinh(n: usize, x: *const f64, out: *mut f64);
        pub(super) unsafe fn rival_power(n: usize, x: *const f64, exponent: *const f64, out: *mut f64);
        pub(super) unsafe fn rival_sinh_fitness(
            n: usize,
            x: *const f64,
            v: *const f64,
            f: *const f64,
            p: *const f64,
        ) -> f64;
        pub(super) unsafe fn rival_bouc_wen_fitness(
            samples: usize,
            t: *const f64,
            x: *const f64,
            v: *const f64,
            f: *const f64,
            p: *const [f64; LANES],
            out: *mut f64,
        );
    }
}

/// sinh of each number.
#[allow(unsafe_code)]
pub fn sinh(x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len()];
    // SAFETY: both slices have the length given.
    unsafe { c::rival_sinh(x.len(), x.as_ptr(), out.as_mut_ptr()) };
    out
}

/// `x^n` of each number and its exponent.
#[allow(unsafe_code)]
pub fn power(x: &[f64], n: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len().min(n.len())];
    // SAFETY: no slice is shorter than the length given.
    unsafe { c::rival_power(out.len(), x.as_ptr(), n.as_ptr(), out.as_mut_ptr()) };
    out
}

/// Fitness of `[c0, k0, alpha, beta, F0]` on all samples of a recording with a force.
#[allow(unsafe_code)]
pub fn sinh_fitness(recording: &Recording, p: &[f64; 5]) -> f64 {
    let (x, v, f) = series(recording);
    // SAFETY: the series of a recording have one length, and C reads five parameters.
    unsafe { c::rival_sinh_fitness(x.len(), x.as_ptr(), v.as_ptr(), f.as_ptr(), p.as_ptr()) }
}

/// Fitness of [`LANES`] candidates, one column each, rows `c0, kx, kw, rho, sigma, n, F0`; one step of
/// RK4 a sample.
#[allow(unsafe_code)]
pub fn bouc_wen_fitness(recording: &Recording, p: &[[f64; LANES]; 7]) -> [f64; LANES] {
    let ((x, v, f), t) = (series(recording), recording.time());
    let mut out = [0.0; LANES];
    // SAFETY: the series of a recording have one length, and C reads and writes whole blocks.
    unsafe {
        c::rival_bouc_wen_fitness(
            x.len(),
            t.as_ptr(),
            x.as_ptr(),
            v.as_ptr(),
            f.as_ptr(),
            p.as_ptr(),
            out.as_mut_ptr(),
        );
    }
    out
}

fn series(recording: &Recording) -> (&[f64], &[f64], &[f64]) {
    let force = recording.force().unwrap_or_default();
    assert_eq!(force.len(), recording.len(), "the recording has no force");
    (recording.displacement(), recording.velocity(), force)
}
