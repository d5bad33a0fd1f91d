//! Noise does not know the motion, nor when it is: what is left and is larger at some displacements, velocities,
//! accelerations or moments of a recording than at others is not noise alone. An autoregression takes much of a mismatch
//! for noise, but not this: a fast one shows sample by sample, a slow one in means over some samples.

use nalgebra::{DMatrix, DVector};

use super::gaps::LeftOut;
use super::missing::Projected;
use super::motion::{COLUMNS, functions_of_the_motion};
use super::null::Null;
use super::resolution::step_of;
use crate::kernel::filter::dot;

/// Samples that are taken together: a mean of some keeps what is slow, and is as white.
const TOGETHER: [usize; 3] = [1, 4, 16];
/// Squares above this many variances count as this many: heavy tails are noise too.
const LARGEST: f64 = 9.0;
/// Samples over which sizes may be correlated.
const MEMORY: usize = 50;
/// Correlations below so many standard deviations are none.
const BY_CHANCE: f64 = 2.0;
/// Rounding to steps above this share of the noise depends on the motion.
const COARSE: f64 = 0.3;
/// Ridge on ones on the diagonal.
const RIDGE: f64 = 1e-6;
/// Samples that tell something, at least.
const FEWEST: usize = 100;
/// Share of the noise that is not noise, below which it may be chance.
const LEAST: f64 = 0.15;
/// The noise's own size is found where what is left is smaller than at all but this share of the samples.
const QUIET: f64 = 0.1;

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Uneven {
    /// Chance of as much under the null, for a decision.
    pub(super) p_value: f64,
    /// Squared standard deviations that the noise has swallowed.
    pub(super) swallowed: f64,
}

impl Uneven {
    /// No test could be made.
    pub(super) const NONE: Self = Self { p_value: 1.0, swallowed: 0.0 };
}

/// Squares of what is left of a recording and functions of its motion, both about their means.
struct Sizes {
    /// Of unit variance.
    squares: Vec<f64>,
    /// Standard deviation of the squares over their mean.
    spread: f64,
    columns: Vec<Vec<f64>>,
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
        if self.noise().hidden() || self.assembly().clips(&self.shapes()) {
            return None;
        }
        let tried = TOGETHER.iter().filter_map(|together| self.followed(*together));
        let best = tried.reduce(|best, next| if next.p_value < best.p_value { next } else { best });
        best.map(|best| Uneven {
            p_value: (best.p_value * TOGETHER.len() as f64).min(1.0),
            swallowed: self.swallowed(&best),
        })
    }

    /// How means over so many samples follow the motion; one recording after the other, for the memory's sake.
    fn followed(&self, together: usize) -> Option<Followed> {
        let nothing = || DMatrix::zeros(COLUMNS, COLUMNS);
        let (mut plain, mut gram, mut right) = (nothing(), nothing(), DVector::zeros(COLUMNS));
        for own in self.sizes(together) {
            plain += own.products(0);
            gram += own.covariance();
            right += DVector::from_fn(COLUMNS, |i, _| dot(&own.columns[i], &own.squares));
        }
        let squares: Vec<f64> = (0..COLUMNS).map(|i| gram[(i, i)]).collect();
        let chosen: Vec<usize> = (0..COLUMNS).collect();
        (gram.trace() > 0.0).then(|| Followed {
            together,
            p_value: Projected::of(&gram, &right, &squares, &chosen).mismatch().cautious(),
            plain,
            right,
        })
    }

    /// Squared standard deviations in what is left beyond those of where the motion leaves least.
    fn swallowed(&self, followed: &Followed) -> f64 {
        let Some(weights) = followed.weights() else { return 0.0 };
        let mut sizes: Vec<f64> = Vec::new();
        for own in self.sizes(followed.together) {
            let follows = |i: usize| (0..COLUMNS).map(|k| weights[k] * own.columns[k][i]).sum::<f64>();
            sizes.extend((0..own.squares.len()).map(|i| 1.0 + own.spread * follows(i)));
        }
        let place = (QUIET * sizes.len() as f64) as usize;
        let (_, quiet, _) = sizes.select_nth_unstable_by(place, f64::total_cmp);
        let share = 1.0 - quiet.max(0.0);
        if share > LEAST { share * sizes.len() as f64 } else { 0.0 }
    }

    /// Of the recordings that tell something.
    fn sizes(&self, together: usize) -> impl Iterator<Item = Sizes> {
        let recordings = self.assembly().campaign().recordings().len();
        (0..recordings).filter_map(move |r| self.sizes_over_motion(r, together))
    }

    fn sizes_over_motion(&self, r: usize, together: usize) -> Option<Sizes> {
        let (noise, campaign) = (self.noise(), self.assembly().campaign());
        if campaign.doubts()[r].cornered {
            return None;
        }
        let recording = &campaign.recordings()[r];
        let (coefficients, deviation) = noise.autoregression(r);
        let (start, memory) = (recording.scored().start.max(noise.lost(r)), coefficients.len());
        let left = &self.point.recordings[r].residual;
        let measured = &recording.force().unwrap_or_default()[recording.scored()];
        if start + left.len() != recording.scored().end || step_of(measured) > COARSE * deviation {
            return None;
        }
        let mut counts = vec![true; left.len()];
        for gap in LeftOut::of(campaign, r).ranges {
            let place = |i: usize| i.clamp(start, start + left.len()) - start;
            counts[place(gap.start)..place(gap.end + memory)].fill(false);
        }
        let whole = |some: &[bool]| some.iter().all(|counts| *counts);
        let counts: Vec<bool> = counts.chunks_exact(together).map(whole).collect();
        let size = |some: &[f64]| (some.iter().sum::<f64>().powi(2) / together as f64).min(LARGEST);
        let squares: Vec<f64> = left.chunks_exact(together).map(size).collect();
        let counted = counts.iter().filter(|c| **c).count() as f64;
        let mean = squares.iter().zip(&counts).filter(|(_, c)| **c).map(|(s, _)| s).sum::<f64>() / counted;
        let squares = centred(squares, &counts)?;
        let deviation = (dot(&squares, &squares) / counted).sqrt();
        if deviation.is_nan() || deviation <= 0.0 {
            return None;
        }
        let columns = functions_of_the_motion(&self.scene(r), start..start + left.len());
        let means = |column: Vec<f64>| {
            let mean = |some: &[f64]| some.iter().sum::<f64>() / together as f64;
            column.chunks_exact(together).map(mean).collect()
        };
        Some(Sizes {
            squares: squares.iter().map(|s| s / deviation).collect(),
            spread: deviation / mean,
            columns: columns
                .into_iter()
                .map(|column| centred(means(column), &counts))
                .collect::<Option<_>>()?,
        })
    }
}

impl Sizes {
    /// Products of the columns with themselves so many samples later.
    fn products(&self, lag: usize) -> DMatrix<f64> {
        let (columns, last) = (&self.columns, self.squares.len());
        DMatrix::from_fn(COLUMNS, COLUMNS, |i, j| dot(&columns[i][lag..], &columns[j][..last - lag]))
    }

    /// Covariance of the products of the columns with the squares under the null; neighbouring squares are correlated.
    fn covariance(&self) -> DMatrix<f64> {
        let last = self.squares.len();
        let mut gram = self.products(0);
        for lag in 1..MEMORY.min(last / 4) {
            let correlation = dot(&self.squares[lag..], &self.squares[..last - lag]) / last as f64;
            if correlation.abs() < BY_CHANCE / (last as f64).sqrt() {
                continue;
            }
            let later = self.products(lag) * (correlation * (1.0 - lag as f64 / MEMORY as f64));
            gram += &later + later.transpose();
        }
        gram
    }
}

/// Values about the mean of those that count, the others zero; `None` of too few.
fn centred(mut values: Vec<f64>, counts: &[bool]) -> Option<Vec<f64>> {
    let count = counts.iter().filter(|c| **c).count();
    if count < FEWEST {
        return None;
    }
    let mean = values.iter().zip(counts).filter(|(_, c)| **c).map(|(v, _)| v).sum::<f64>() / count as f64;
    for (value, counts) in values.iter_mut().zip(counts) {
        *value = if *counts { *value - mean } else { 0.0 };
    }
    Some(values)
}
