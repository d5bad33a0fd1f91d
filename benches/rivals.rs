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
            x: *const f64,
            v: *const f64,
            f: *const f64,
            first: *const usize,
            velocity: *const [f64; 3],
            step: *const f64,
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
/// RK4 an interval.
///
/// # Panics
/// The intervals are those of another recording, or it has no force.
#[allow(unsafe_code)]
pub fn bouc_wen_fitness(recording: &Recording, over: &Intervals, p: &[[f64; LANES]; 7]) -> [f64; LANES] {
    let (x, v, f) = series(recording);
    assert_eq!(over.first.len(), x.len() + 1);
    assert_eq!((over.first[x.len()], over.velocity.len()), (over.step.len(), over.step.len()));
    let mut out = [0.0; LANES];
    // SAFETY: the series of a recording have one length, the places of intervals end with their number, and C
    // reads and writes whole blocks.
    unsafe {
        c::rival_bouc_wen_fitness(
            x.len(),
            x.as_ptr(),
            v.as_ptr(),
            f.as_ptr(),
            over.first.as_ptr(),
            over.velocity.as_ptr(),
            over.step.as_ptr(),
            p.as_ptr(),
            out.as_mut_ptr(),
        );
    }
    out
}

/// Times between samples, cut where the velocity turns.
#[derive(Default)]
pub struct Intervals {
    first: Vec<usize>,
    /// At the beginning, halfway, at the end.
    velocity: Vec<[f64; 3]>,
    step: Vec<f64>,
}

impl Intervals {
    /// Of samples at even times: a cubic gives the velocity halfway, at the ends a parabola.
    pub fn of(recording: &Recording) -> Self {
        let (v, h) = (recording.velocity(), 1.0 / recording.sampling_rate());
        let last = v.len() - 1;
        let bend = |i: usize| {
            let i = i.clamp(1, last - 1);
            v[i - 1] - 2.0 * v[i] + v[i + 1]
        };
        let mut found = Self { first: vec![0], ..Self::default() };
        for i in 0..last {
            let middle = 0.5 * (v[i] + v[i + 1]) - (bend(i) + bend(i + 1)) / 16.0;
            let curve = 4.0 * (middle - 0.5 * (v[i] + v[i + 1]));
            let at = |s: f64| v[i] + s * (v[i + 1] - v[i] + curve * (1.0 - s));
            let mut ends = vec![0.0, 1.0];
            if v[i] * v[i + 1] < 0.0 {
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..60 {
                    let half = 0.5 * (low + high);
                    if at(half) * v[i] > 0.0 { low = half } else { high = half }
                }
                ends.insert(1, low);
            }
            for part in ends.windows(2) {
                found.velocity.push([at(part[0]), at(0.5 * (part[0] + part[1])), at(part[1])]);
                found.step.push((part[1] - part[0]) * h);
            }
            found.first.push(found.step.len());
        }
        found.first.push(found.step.len());
        found
    }
}

fn series(recording: &Recording) -> (&[f64], &[f64], &[f64]) {
    let force = recording.force().unwrap_or_default();
    assert_eq!(force.len(), recording.len(), "the recording has no force");
    (recording.displacement(), recording.velocity(), force)
}
