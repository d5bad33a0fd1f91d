//! Squared error of the sinh model (eq. 5), sample by sample, lanes over samples.

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::{LARGEST, fma, sinh, sinh_lane};
use super::total::total;
use crate::recording::Recording;

/// Samples whose squares are added side by side: the widest registers there are. The processor overlaps
/// one round with the next by itself.
const LANES: usize = 8;

/// The scored samples of a recording, packed.
#[derive(Debug, Clone)]
pub(crate) struct SinhDirect {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    farthest: f64,
    isa: Isa,
}

impl SinhDirect {
    /// Pack a recording with a force.
    pub(crate) fn new(recording: &Recording) -> Self {
        let scored = recording.scored();
        let force = recording.force().unwrap_or_default();
        let displacement = recording.displacement()[scored.clone()].to_vec();
        Self {
            farthest: displacement.iter().fold(0.0, |far, x| x.abs().max(far)),
            velocity: recording.velocity()[scored.clone()].to_vec(),
            force: force[scored].to_vec(),
            displacement,
            isa: dispatch::best(),
        }
    }

    /// Sum of squared errors of `[c0, k0, alpha, beta, F0]`; infinite where sinh overflows.
    pub(crate) fn sum_of_squares(&self, x: &[f64]) -> f64 {
        let candidate = [x[0], x[1], x[2], x[3], x[4]];
        if candidate[3].abs() * self.farthest <= LARGEST {
            sum(self.isa, &self.displacement, &self.velocity, &self.force, candidate)
        } else {
            self.sum_near_overflow(candidate)
        }
    }

    /// The same for any beta.
    #[cold]
    fn sum_near_overflow(&self, [c0, k0, alpha, beta, f0]: [f64; 5]) -> f64 {
        let samples = self.displacement.iter().zip(&self.velocity).zip(&self.force);
        samples.map(|((x, v), f)| (f - f0 - c0 * v - k0 * x - alpha * sinh(beta * x)).powi(2)).sum()
    }
}

for_every_isa!(sum, sum_generic, (x: &[f64], v: &[f64], f: &[f64], candidate: [f64; 5]) -> f64);

#[inline(always)]
fn sum_generic<const FUSED: bool>(x: &[f64], v: &[f64], f: &[f64], candidate: [f64; 5]) -> f64 {
    let ((x, x_rest), (v, v_rest), (f, f_rest)) =
        (x.as_chunks::<LANES>(), v.as_chunks::<LANES>(), f.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for ((x, v), f) in x.iter().zip(v).zip(f) {
        for l in 0..LANES {
            let r = residual::<FUSED>(x[l], v[l], f[l], candidate);
            sums[l] = fma::<FUSED>(r, r, sums[l]);
        }
    }
    let mut rest = 0.0;
    for ((x, v), f) in x_rest.iter().zip(v_rest).zip(f_rest) {
        let r = residual::<FUSED>(*x, *v, *f, candidate);
        rest = fma::<FUSED>(r, r, rest);
    }
    total(&mut sums) + rest
}

#[inline(always)]
fn residual<const FUSED: bool>(x: f64, v: f64, f: f64, [c0, k0, alpha, beta, f0]: [f64; 5]) -> f64 {
    let rest = fma::<FUSED>(-k0, x, fma::<FUSED>(-c0, v, f - f0));
    fma::<FUSED>(-alpha, sinh_lane::<FUSED>(beta * x), rest)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::kernel::example;

    #[test]
    fn every_instruction_set_gives_the_same() {
        let direct = SinhDirect::new(&example::recording());
        let candidate = [0.4, 3.0, 2.0, 0.5, -0.2];
        let plain = SinhDirect { isa: Isa::Plain, ..direct.clone() }.sum_of_squares(&candidate);
        for isa in dispatch::available() {
            let found = SinhDirect { isa, ..direct.clone() }.sum_of_squares(&candidate);
            assert!((found - plain).abs() <= 1e-12 * plain, "{isa:?}: {found} {plain}");
        }
    }

    #[test]
    fn the_last_finite_values_are_finite() {
        let direct = SinhDirect::new(&example::recording());
        let at = |alpha: f64, argument: f64| {
            direct.sum_of_squares(&[0.0, 0.0, alpha, argument / direct.farthest, 0.0])
        };
        // Both sides of the end of the lane version, and of the end of the range of numbers.
        let (below, above) = (at(1e-300, 699.999_999), at(1e-300, 700.000_001));
        assert!((below / above - 1.0).abs() < 1e-5, "{below} {above}");
        assert!(at(1e-300, 710.4).is_finite());
        assert_eq!(at(1e-300, 711.0), f64::INFINITY);
        assert_eq!(at(1.0, 700.0), f64::INFINITY); // its square overflows
    }
}
