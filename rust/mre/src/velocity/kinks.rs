//! What stands out of polynomials around a sample: a parabola or a line that begins there.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::local::{TERMS, chebyshev};
use crate::spread::{GAUSSIAN, median};

/// Standard deviations by which a bend stands out of the noise, of what else polynomials miss, and of what is left beside it.
const STANDS_OUT: f64 = 5.0;
/// Terms of a polynomial that leaves less than one with a bend where a motion is only quicker than elsewhere.
pub(super) const MORE_TERMS: usize = TERMS + 2;
/// Of so much of the reach on either side of the largest, one place has to stand out.
const BESIDE: usize = 10;
/// Squares that a corner leaves, over those that a bend does, at most.
const HALF: f64 = 0.5;
/// Squares that are left beside a better place, over those beside the own, at most.
const MOVED: f64 = 0.1;

/// What is looked at around every sample, as far as `reach`.
pub(super) struct Windows<'a> {
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
    pub(super) fn new(displacement: &'a [f64], variance: f64, reach: usize) -> Self {
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
    pub(super) fn peaks(&self) -> Vec<usize> {
        let (reach, last) = (self.reach, self.displacement.len() - 1);
        let sizes: Vec<f64> = (reach..=last - reach).into_par_iter().map(|i| self.size(i)).collect();
        let least = STANDS_OUT * (median(sizes.clone()) / GAUSSIAN).max(1.0);
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
    pub(super) fn cut(&self, i: usize) -> (usize, bool) {
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
