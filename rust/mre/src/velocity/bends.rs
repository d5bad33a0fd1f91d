//! Bends of a motion: its acceleration jumps there, as at a quick release, and polynomials across swing on both sides.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::cuts::worth;
use super::local::{NARROWEST, TERMS, chebyshev};
use crate::spread::median;

/// Half windows over which a bend is looked for: over more it stands out of the noise further, and a motion needs more terms.
const REACHES: [f64; 2] = [1.5, 3.0];
/// Standard deviations by which a bend stands out of the noise, of what else polynomials miss, and of what is left beside it.
const STANDS_OUT: f64 = 5.0;
/// Terms of a polynomial that leaves less than one with a bend where a motion is only quicker than elsewhere.
const MORE_TERMS: usize = TERMS + 2;
/// Of so much of the reach on either side of the largest, one place has to stand out.
const BESIDE: usize = 10;
/// Samples of the shortest part between bends.
const SHORTEST: usize = 2 * NARROWEST + 1;
/// Squares that a corner leaves, over those that a bend does, at most.
const HALF: f64 = 0.5;
/// Squares that are left beside a better place, over those beside the own, at most.
const MOVED: f64 = 0.1;
/// Median of the size of a normal variable of variance one.
const MEDIAN: f64 = 0.6745;

/// Where a motion is to be cut.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Bends {
    /// Samples after which it bends, in rising order.
    pub(super) after: Vec<usize>,
    /// True where its slope jumps at one, and not its acceleration alone.
    pub(super) sharp: bool,
    /// Samples after which it bends too little to be cut.
    pub(super) slight: Vec<usize>,
}

/// The bends of a displacement in mm, on an even grid and with noise of this `variance` in mm² that is told over `half` samples
/// on either side.
pub(super) fn bends(time: &[f64], displacement: &[f64], variance: f64, half: usize) -> Bends {
    if variance <= 0.0 {
        return Bends::default();
    }
    let mut found: Vec<(usize, bool)> = Vec::new();
    for times in REACHES {
        let reach = ((times * half as f64).ceil() as usize).max(MORE_TERMS);
        if displacement.len() > 2 * reach + 1 {
            let windows = Windows::new(displacement, variance, reach);
            let more = windows.peaks().into_iter().map(|i| windows.cut(i));
            let apart = |(i, _): &(usize, bool)| found.iter().all(|(known, _)| known.abs_diff(*i) > reach);
            let more: Vec<(usize, bool)> = more.filter(apart).collect();
            found.extend(more);
        }
    }
    found.sort_unstable();
    let mut start = 0;
    let long_enough = |(after, _): &(usize, bool)| {
        let long = after + 1 >= start + SHORTEST && after + 1 + SHORTEST <= displacement.len();
        if long {
            start = after + 1;
        }
        long
    };
    found.retain(long_enough);
    let after = worth(found.iter().map(|(i, _)| *i).collect(), [time, displacement], variance);
    let (cut, slight): (Vec<(usize, bool)>, Vec<_>) = found.into_iter().partition(|(i, _)| after.contains(i));
    let slight = slight.into_iter().map(|(i, _)| i).collect();
    Bends { sharp: cut.iter().any(|(_, sharp)| *sharp), after, slight }
}

/// What is looked at around every sample, as far as `reach`.
struct Windows<'a> {
    displacement: &'a [f64],
    variance: f64,
    reach: usize,
    /// Orthonormal polynomials.
    smooth: DMatrix<f64>,
    /// What their first terms leave of a parabola, and of a line, that begins in the middle, of size one.
    parabola: DVector<f64>,
    line: DVector<f64>,
}

impl<'a> Windows<'a> {
    fn new(displacement: &'a [f64], variance: f64, reach: usize) -> Self {
        let smooth = polynomials(2 * reach + 1, MORE_TERMS);
        let begins = |power: i32| {
            let place = |k: usize| k as f64 / reach as f64 - 1.0;
            let whole = DVector::from_fn(2 * reach + 1, |k, _| place(k).max(0.0).powi(power));
            let first = smooth.columns(0, TERMS);
            (&whole - first * first.tr_mul(&whole)).normalize()
        };
        let (parabola, line) = (begins(2), begins(1));
        Self { displacement, variance, reach, smooth, parabola, line }
    }

    /// What is around a sample, less its displacement.
    fn around(&self, i: usize) -> DVector<f64> {
        let samples = &self.displacement[i - self.reach..=i + self.reach];
        DVector::from_iterator(samples.len(), samples.iter().map(|x| x - self.displacement[i]))
    }

    /// Standard deviations of the noise that a parabola which begins at a sample has.
    fn size(&self, i: usize) -> f64 {
        // It is odd.
        let (before, after) = self.displacement[i - self.reach..=i + self.reach].split_at(self.reach);
        let pairs = after[1..].iter().zip(before.iter().rev()).zip(self.parabola.iter().skip(self.reach + 1));
        pairs.map(|((b, a), weight)| weight * (b - a)).sum::<f64>().abs() / self.variance.sqrt()
    }

    /// What the first polynomials leave of what is around a sample.
    fn beside_polynomials(&self, i: usize) -> DVector<f64> {
        let around = self.around(i);
        let first = self.smooth.columns(0, TERMS);
        &around - first * first.tr_mul(&around)
    }

    /// Squares that they leave together with what begins in the middle.
    fn left(&self, i: usize, begins: &DVector<f64>) -> f64 {
        let left = self.beside_polynomials(i);
        left.norm_squared() - begins.dot(&left).powi(2)
    }

    /// True where it stands out of what is left beside it, and explains more than more terms.
    fn stands_out(&self, i: usize) -> bool {
        let left = self.beside_polynomials(i);
        let more = self.smooth.columns(TERMS, MORE_TERMS - TERMS).tr_mul(&left).norm_squared();
        let explained = self.parabola.dot(&left).powi(2);
        let beside = (left.norm_squared() - explained) / (left.len() - TERMS - 1) as f64;
        explained > more && explained > STANDS_OUT.powi(2) * beside
    }

    /// The samples where they are largest and stand out.
    fn peaks(&self) -> Vec<usize> {
        let (reach, last) = (self.reach, self.displacement.len() - 1);
        let sizes: Vec<f64> = (reach..=last - reach).into_par_iter().map(|i| self.size(i)).collect();
        let least = STANDS_OUT * (median(sizes.clone()) / MEDIAN).max(1.0);
        let mut largest: Vec<usize> = (0..sizes.len()).filter(|k| sizes[*k] > least).collect();
        largest.sort_by(|a, b| sizes[*b].total_cmp(&sizes[*a]));
        let mut hidden = vec![false; sizes.len()];
        let mut found = Vec::new();
        for k in largest {
            if hidden[k] {
                continue;
            }
            hidden[k.saturating_sub(reach)..(k + reach + 1).min(sizes.len())].fill(true);
            let near = k.saturating_sub(reach / BESIDE)..(k + reach / BESIDE + 1).min(sizes.len());
            let standing = near.filter(|k| sizes[*k] > least && self.stands_out(k + reach));
            found.extend(standing.max_by(|a, b| sizes[*a].total_cmp(&sizes[*b])).map(|k| k + reach));
        }
        found
    }

    /// The sample near one after which the motion is best cut, and whether the slope jumps there: a parabola seems to begin beside that.
    fn cut(&self, i: usize) -> (usize, bool) {
        let (aside, last) = (self.reach / 3, self.displacement.len() - 1);
        let near = (i - aside).max(self.reach)..=(i + aside).min(last - self.reach);
        let line = |i: usize| (i, self.line.dot(&self.around(i)).abs());
        let (corner, _) = near.map(line).fold((i, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        if self.left(corner, &self.line) > HALF * self.left(i, &self.parabola) {
            return (i, false);
        }
        let side = polynomials(self.reach - aside, TERMS / 2);
        let left = |samples: &[f64]| {
            let rise = DVector::from_fn(samples.len(), |k, _| samples[k] - samples[0]);
            (&rise - &side * side.tr_mul(&rise)).norm_squared()
        };
        let beside = |after: usize| {
            let (before, next) = self.displacement.split_at(after + 1);
            left(&before[before.len() - side.nrows()..]) + left(&next[..side.nrows()])
        };
        let own = beside(corner);
        let near = (corner - aside).max(side.nrows() - 1)..=(corner + aside).min(last - side.nrows());
        let (best, least) =
            near.map(|i| (i, beside(i))).fold((corner, own), |a, b| if b.1 < a.1 { b } else { a });
        let moved = own - least > STANDS_OUT.powi(2) * self.variance && least < MOVED * own;
        (if moved { best } else { corner }, true)
    }
}

/// Orthonormal polynomials over so many samples.
fn polynomials(samples: usize, terms: usize) -> DMatrix<f64> {
    let place = |k: usize| 2.0 * k as f64 / (samples - 1) as f64 - 1.0;
    DMatrix::from_fn(samples, terms, |k, c| chebyshev::<MORE_TERMS>(place(k))[c]).qr().q()
}

#[cfg(test)]
mod tests {
    use super::super::from_displacement;

    const RATE: f64 = 200.0;
    const SAMPLES: usize = 1500;
    /// Of the release.
    const AT: f64 = 2.5;

    fn time() -> Vec<f64> {
        (0..SAMPLES).map(|i| i as f64 / RATE).collect()
    }

    /// 5 mm held, and let go to ring at a frequency in Hz.
    fn released(frequency: f64, t: f64) -> [f64; 2] {
        let (turn, decay) = (std::f64::consts::TAU * frequency, 0.6);
        let s = t - AT;
        if s < 0.0 {
            return [5.0, 0.0];
        }
        let size = 5.0 * (-decay * s).exp();
        let slope = -size * (turn + decay * decay / turn) * (turn * s).sin();
        [size * ((turn * s).cos() + decay / turn * (turn * s).sin()), slope]
    }

    fn noise(i: usize, size: f64) -> f64 {
        let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
        12.0_f64.sqrt() * size * (x - x.floor() - 0.5)
    }

    #[test]
    fn a_quick_release_is_a_bend_and_the_velocity_beside_it_is_as_good_as_elsewhere() {
        let time = time();
        for (frequency, size) in [(1.0, 0.001), (1.0, 0.005), (2.0, 0.002), (2.0, 0.01)] {
            let x: Vec<f64> =
                time.iter().enumerate().map(|(i, t)| released(frequency, *t)[0] + noise(i, size)).collect();
            let derived = from_displacement(&time, &x);
            let release = (AT * RATE) as usize;
            let inner = &derived.corners[1..derived.corners.len() - 1];
            assert!(matches!(inner, [one] if one.contains(&release)), "{frequency} {size}: {inner:?}");
            let error = |i: usize| derived.velocity[i] - released(frequency, time[i])[1];
            let kept = |i: &usize| !derived.corners.iter().any(|range| range.contains(i));
            let rms = |near: std::ops::Range<usize>| {
                let errors: Vec<f64> = near.filter(kept).map(error).collect();
                (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
            };
            let (beside, elsewhere) = (rms(release - 30..release + 30), rms(0..SAMPLES));
            assert!(beside < 2.5 * elsewhere, "{frequency} {size}: {beside} beside {elsewhere}");
        }
    }

    #[test]
    fn where_an_exact_triangle_is_rounded_the_velocity_is_not_missed() {
        // The mean over 60 ms of a triangle of 5 mm at 0.5 Hz, and its slope.
        let integral = |t: f64| {
            let s = (t + 0.5).rem_euclid(2.0);
            if s < 1.0 { 5.0 * (s * s - s) } else { 5.0 * (3.0 * s - s * s - 2.0) }
        };
        let triangle = |t: f64| 5.0 - 10.0 * ((t + 0.5).rem_euclid(2.0) - 1.0).abs();
        let time = time();
        let x: Vec<f64> = time.iter().map(|t| (integral(t + 0.03) - integral(t - 0.03)) / 0.06).collect();
        let derived = from_displacement(&time, &x);
        // The last corner is cut off.
        for (i, t) in time.iter().enumerate().take(SAMPLES - 20) {
            let wanted = (triangle(t + 0.03) - triangle(t - 0.03)) / 0.06;
            let known = derived.corners.iter().any(|range| range.contains(&i));
            assert!(known || (derived.velocity[i] - wanted).abs() < 0.02, "{i}: {}", derived.velocity[i]);
        }
        let left_out: usize = derived.corners.iter().map(ExactSizeIterator::len).sum();
        assert!(5 * left_out < SAMPLES, "{left_out} of {SAMPLES} samples");
    }

    #[test]
    fn noise_alone_a_swell_and_a_burst_have_none() {
        let time = time();
        let turn = std::f64::consts::TAU;
        let motions: [&dyn Fn(f64) -> f64; 3] =
            [&|_| 0.0, &|t| 5.0 * (0.5 * turn * t / 7.5).sin().powi(2) * (2.0 * turn * t).sin(), &|t| {
                5.0 * (3.0 * turn * t).sin() * (-4.0 * (t - 3.0).powi(2)).exp()
            }];
        for (k, motion) in motions.iter().enumerate() {
            for size in [0.002, 0.02] {
                let x: Vec<f64> = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i, size)).collect();
                assert_eq!(from_displacement(&time, &x).corners, [], "motion {k} with noise of {size}");
            }
        }
    }
}
