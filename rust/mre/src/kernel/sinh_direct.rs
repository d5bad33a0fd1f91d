//! Squared error of the sinh model (eq. 5), sample by sample, lanes over samples.

use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::{LARGEST, fma, sinh, sinh_lane};
use super::sinh_series::{self, LONGEST};
use super::total::total;
use crate::recording::Recording;

/// Samples whose squares are added side by side: the widest registers there are. The processor overlaps
/// one round with the next by itself.
const LANES: usize = 8;

/// The scored samples of a recording, packed. Displacements are scaled by a power of two so that the
/// farthest is between 1/2 and 1: no power of it overflows.
#[derive(Debug, Clone)]
pub(crate) struct SinhDirect {
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    force: Vec<f64>,
    farthest: f64,
    scale: f64,
    isa: Isa,
}

impl SinhDirect {
    /// Pack a recording with a force.
    pub(crate) fn new(recording: &Recording) -> Self {
        let scored = recording.scored();
        let force = recording.force().unwrap_or_default();
        let displacement = &recording.displacement()[scored.clone()];
        let farthest = displacement.iter().fold(0.0, |far: f64, x| x.abs().max(far));
        let scale = power_of_two_above(farthest);
        Self {
            displacement: displacement.iter().map(|x| x / scale).collect(),
            velocity: recording.velocity()[scored.clone()].to_vec(),
            force: force[scored].to_vec(),
            farthest: farthest / scale,
            scale,
            isa: dispatch::best(),
        }
    }

    /// Sum of squared errors of `[c0, k0, alpha, beta, F0]`; infinite where sinh overflows.
    pub(crate) fn sum_of_squares(&self, x: &[f64]) -> f64 {
        let (c0, k0, alpha, beta, f0) = (x[0], x[1] * self.scale, x[2], x[3] * self.scale, x[4]);
        let samples = [&self.displacement[..], &self.velocity[..], &self.force[..]];
        if let Some((mut odd, count)) = sinh_series::coefficients(alpha, beta, self.farthest) {
            odd[0] += k0;
            sum_of_odd(self.isa, samples, [c0, f0], &odd[..count])
        } else if beta.abs() * self.farthest <= LARGEST {
            sum(self.isa, samples, [c0, k0, alpha, beta, f0])
        } else {
            self.sum_near_overflow([c0, k0, alpha, beta, f0])
        }
    }

    /// The same for any beta.
    #[cold]
    fn sum_near_overflow(&self, [c0, k0, alpha, beta, f0]: [f64; 5]) -> f64 {
        let samples = self.displacement.iter().zip(&self.velocity).zip(&self.force);
        samples.map(|((x, v), f)| (f - f0 - c0 * v - k0 * x - alpha * sinh(beta * x)).powi(2)).sum()
    }
}

/// The power of two next above a normal positive number; 1 for zero.
fn power_of_two_above(number: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    if number > 0.0 { 2.0 * f64::from_bits(number.to_bits() & EXPONENT) } else { 1.0 }
}

for_every_isa!(sum, sum_generic, (samples: [&[f64]; 3], candidate: [f64; 5]) -> f64);
for_every_isa!(sum_of_odd, sum_of_odd_generic, (samples: [&[f64]; 3], plain: [f64; 2], odd: &[f64]) -> f64);

#[inline(always)]
fn sum_generic<const FUSED: bool>(samples: [&[f64]; 3], [c0, k0, alpha, beta, f0]: [f64; 5]) -> f64 {
    sum_of_residuals::<FUSED>(samples, |x, v, f| {
        let rest = fma::<FUSED>(-k0, x, fma::<FUSED>(-c0, v, f - f0));
        fma::<FUSED>(-alpha, sinh_lane::<FUSED>(beta * x), rest)
    })
}

/// For `c0 v + x (odd[0] + odd[1] x^2 + ...) + F0`, `[c0, F0]` being plain.
#[inline(always)]
fn sum_of_odd_generic<const FUSED: bool>(samples: [&[f64]; 3], plain: [f64; 2], odd: &[f64]) -> f64 {
    // The number of coefficients, from the shortest series on, is known to the compiler in each branch: no loop
    // inside the lanes.
    macro_rules! by_count {
        ($($count:literal),*) => {
            match odd.len() {
                $($count => with_count::<FUSED, $count>(samples, plain, odd),)*
                _ => with_count::<FUSED, LONGEST>(samples, plain, odd),
            }
        };
    }
    by_count!(6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17)
}

#[inline(always)]
fn with_count<const FUSED: bool, const COUNT: usize>(
    samples: [&[f64]; 3],
    [c0, f0]: [f64; 2],
    odd: &[f64],
) -> f64 {
    let mut c = [0.0; COUNT];
    c.copy_from_slice(&odd[..COUNT]);
    sum_of_residuals::<FUSED>(samples, |x, v, f| {
        let q = x * x;
        let mut p = c[COUNT - 1];
        for i in (0..COUNT - 1).rev() {
            p = fma::<FUSED>(p, q, c[i]);
        }
        fma::<FUSED>(-p, x, fma::<FUSED>(-c0, v, f - f0))
    })
}

#[inline(always)]
fn sum_of_residuals<const FUSED: bool>(
    [x, v, f]: [&[f64]; 3],
    residual: impl Fn(f64, f64, f64) -> f64,
) -> f64 {
    let ((x, x_rest), (v, v_rest), (f, f_rest)) =
        (x.as_chunks::<LANES>(), v.as_chunks::<LANES>(), f.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for ((x, v), f) in x.iter().zip(v).zip(f) {
        for l in 0..LANES {
            let r = residual(x[l], v[l], f[l]);
            sums[l] = fma::<FUSED>(r, r, sums[l]);
        }
    }
    let mut rest = 0.0;
    for ((x, v), f) in x_rest.iter().zip(v_rest).zip(f_rest) {
        let r = residual(*x, *v, *f);
        rest = fma::<FUSED>(r, r, rest);
    }
    total(&mut sums) + rest
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::kernel::example;

    #[test]
    fn every_instruction_set_gives_the_same() {
        let direct = SinhDirect::new(&example::recording());
        // Every number of coefficients, the lanes beyond the longest series, and what comes before either overflows.
        for argument in (1..=60).map(|i| 0.2 * f64::from(i)).chain([40.0, 300.0]) {
            let candidate = [0.4, 3.0, 2.0, argument / (direct.farthest * direct.scale), -0.2];
            let plain = SinhDirect { isa: Isa::Plain, ..direct.clone() }.sum_of_squares(&candidate);
            let recording = example::recording();
            let samples = recording.displacement().iter().zip(recording.velocity());
            let wanted: f64 = samples
                .zip(recording.force().unwrap())
                .map(|((x, v), f)| (f + 0.2 - 0.4 * v - 3.0 * x - 2.0 * (candidate[3] * x).sinh()).powi(2))
                .sum();
            assert!((plain - wanted).abs() <= 1e-12 * wanted, "{argument}: {plain} {wanted}");
            for isa in dispatch::available() {
                let found = SinhDirect { isa, ..direct.clone() }.sum_of_squares(&candidate);
                assert!((found - plain).abs() <= 1e-12 * plain, "{argument} {isa:?}: {found} {plain}");
            }
        }
    }

    #[test]
    fn the_last_finite_values_are_finite() {
        let direct = SinhDirect::new(&example::recording());
        let at = |alpha: f64, argument: f64| {
            direct.sum_of_squares(&[0.0, 0.0, alpha, argument / direct.farthest / direct.scale, 0.0])
        };
        // Both sides of the end of the lane version, and of the end of the range of numbers.
        let (below, above) = (at(1e-300, 699.999_999), at(1e-300, 700.000_001));
        assert!((below / above - 1.0).abs() < 1e-5, "{below} {above}");
        assert!(at(1e-300, 710.4).is_finite());
        assert_eq!(at(1e-300, 711.0), f64::INFINITY);
        assert_eq!(at(1.0, 700.0), f64::INFINITY); // its square overflows
    }
}
