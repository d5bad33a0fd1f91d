//! Noise does not know the motion, nor when it is: what is left and is larger at some displacements, velocities,
//! accelerations or moments of a recording than at others is not noise alone. An autoregression takes much of a mismatch
//! for noise, but not this: a fast one shows sample by sample, a slow one in means over some samples.
//!
//! Noise may be larger where a sensor or an amplifier works harder, though. What is missing follows the motion smoothly
//! besides: its neighbouring samples go together where it is large, and those of noise of any size do not.

use nalgebra::{DMatrix, DVector};

use super::missing::Projected;
use super::motion::COLUMNS;
use super::null::Null;
use super::projection::Projection;
use super::strays::Strays;

/// Samples that are taken together: a mean of some keeps what is slow, and is as white.
const TOGETHER: [usize; 3] = [1, 4, 16];
/// Neighbours that are taken together.
const LINKED: [usize; 3] = [2, 4, 16];
/// Squares above this many variances count as this many: heavy tails are noise too.
pub(super) const LARGEST: f64 = 9.0;
/// Ridge on ones on the diagonal.
const RIDGE: f64 = 1e-6;
/// Share of the noise that is not noise, below which it may be chance.
const LEAST: f64 = 0.15;
/// The noise's own size is found where what is left is smaller than at all but this share of the samples.
const QUIET: f64 = 0.1;

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Uneven {
    /// Chance of as much under a noise of even size.
    pub(super) p_value: f64,
    /// Squared standard deviations that the noise has swallowed.
    pub(super) swallowed: f64,
}

impl Uneven {
    /// No test could be made.
    pub(super) const NONE: Self = Self { p_value: 1.0, swallowed: 0.0 };
}

/// How squares follow the motion, all recordings together.
struct Followed {
    together: usize,
    p_value: f64,
    /// Products of the columns with themselves.
    plain: DMatrix<f64>,
    /// Products of the columns with the squares.
    right: DVector<f64>,
}

impl Followed {
    /// Of the columns, by least squares.
    fn weights(&self) -> Option<DVector<f64>> {
        let mut gram = self.plain.clone();
        for i in 0..COLUMNS {
            gram[(i, i)] += RIDGE * gram[(i, i)] + f64::MIN_POSITIVE;
        }
        Some(gram.cholesky()?.solve(&self.right))
    }
}

impl Null<'_> {
    /// Test whether the size of what is left follows the motion.
    ///
    /// A noise that a mismatch hides is not known, and of clipped samples nothing is left: there is no test.
    pub(super) fn uneven(&self) -> Option<Uneven> {
        if !self.knows_its_noise() {
            return None;
        }
        let tried = TOGETHER.iter().filter_map(|together| self.followed(*together));
        let best = tried.reduce(|best, next| if next.p_value < best.p_value { next } else { best });
        best.map(|best| Uneven {
            p_value: (best.p_value * TOGETHER.len() as f64).min(1.0),
            swallowed: self.swallowed(&best),
        })
    }

    /// Chance, under a noise of any size, that products of neighbours follow the motion as much: for a decision.
    pub(super) fn linked(&self) -> f64 {
        if !self.knows_its_noise() {
            return 1.0;
        }
        let of = |together: usize| {
            let (mut gram, mut right) = (DMatrix::zeros(COLUMNS, COLUMNS), DVector::zeros(COLUMNS));
            for own in self.sizes(|_, series| series.to_vec(), together, &products_of_neighbours) {
                gram += own.covariance_of_any_size();
                right += own.right();
            }
            chance(&gram, &right)
        };
        (LINKED.len() as f64 * LINKED.into_iter().map(of).fold(1.0, f64::min)).min(1.0)
    }

    /// True where what is left is noise that nothing hides, of all samples.
    pub(super) fn knows_its_noise(&self) -> bool {
        !self.noise().hidden() && !self.assembly().clips(&self.shapes())
    }

    /// How means over so many samples follow the motion; one recording after the other, for the memory's sake.
    fn followed(&self, together: usize) -> Option<Followed> {
        let nothing = || DMatrix::zeros(COLUMNS, COLUMNS);
        let (mut plain, mut gram, mut right) = (nothing(), nothing(), DVector::zeros(COLUMNS));
        for own in self.sizes(|r, series| self.unweighted(r, series), together, &square_of_the_mean) {
            plain += own.products(0);
            gram += own.covariance();
            right += own.right();
        }
        (gram.trace() > 0.0).then(|| Followed { together, p_value: chance(&gram, &right), plain, right })
    }

    /// Squared standard deviations in what is left beyond those of where the motion leaves least.
    fn swallowed(&self, followed: &Followed) -> f64 {
        let Some(weights) = followed.weights() else { return 0.0 };
        let mut sizes: Vec<f64> = Vec::new();
        for own in self.sizes(|r, series| self.unweighted(r, series), followed.together, &square_of_the_mean)
        {
            let follows = |i: usize| (0..COLUMNS).map(|k| weights[k] * own.columns[k][i]).sum::<f64>();
            sizes.extend((0..own.squares.len()).map(|i| 1.0 + own.spread * follows(i)));
        }
        let place = (QUIET * sizes.len() as f64) as usize;
        let (_, quiet, _) = sizes.select_nth_unstable_by(place, f64::total_cmp);
        let share = 1.0 - quiet.max(0.0);
        if share > LEAST { share * sizes.len() as f64 } else { 0.0 }
    }
}

/// Chance that all columns follow as much, given the covariance of their products with sizes.
pub(super) fn chance(covariance: &DMatrix<f64>, right: &DVector<f64>) -> f64 {
    let squares: Vec<f64> = (0..COLUMNS).map(|i| covariance[(i, i)]).collect();
    let chosen: Vec<usize> = (0..COLUMNS).collect();
    let bias = DVector::zeros(COLUMNS);
    let (gram, tame, strays) = (covariance.clone(), right.clone(), Strays::none(COLUMNS));
    Projected::of(&Projection { gram, right: right.clone(), tame, bias, squares, strays }, &chosen)
        .mismatch()
        .cautious()
}

/// Square of the mean of whitened samples, of unit mean under white noise.
fn square_of_the_mean(some: &[f64]) -> f64 {
    (some.iter().sum::<f64>().powi(2) / some.len() as f64).min(LARGEST)
}

/// The same without the squares of the samples themselves: of zero mean, however large a white noise is.
fn products_of_neighbours(some: &[f64]) -> f64 {
    let squares: f64 = some.iter().map(|e| e * e).sum();
    ((some.iter().sum::<f64>().powi(2) - squares) / some.len() as f64).clamp(-LARGEST, LARGEST)
}
