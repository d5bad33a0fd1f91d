//! Is anything missing? One test for any mismatch: of generic features with memory, and of every recording
//! against the others.

use nalgebra::{DMatrix, DVector};

use super::distribution::{CAUTION, chi_square_tail};
use super::features::{On, features};
use super::locate::strengths;
use super::null::Null;
use super::projection::Projection;
use super::shaken::unsure;
use super::strays::Strays;
use crate::effect::Scene;

/// Share of a feature's square that the projection has to leave.
const SMALLEST_SHARE: f64 = 1e-7;
/// Most recordings that are compared one by one.
pub(super) const MOST_RECORDINGS: usize = 24;

/// Stretches of time over which a stiffness may come and go.
const STRETCHES: usize = 6;
/// The same where it does so in each recording on its own.
const OWN_STRETCHES: usize = 8;
/// So many columns of their own find more in a noise that was estimated: their gain counts this much less.
pub(super) const MORE_CAUTION: f64 = 1.25;

/// A stiffness that comes and goes: at the end of every stretch but the last.
fn passing(scene: &Scene) -> impl Iterator<Item = Vec<f64>> {
    (1..STRETCHES).map(|k| near(scene, k, STRETCHES))
}

/// The displacement around the end of stretch `k`.
fn near(scene: &Scene, k: usize, stretches: usize) -> Vec<f64> {
    let length = scene.duration() / stretches as f64;
    let share = |t: f64| (1.0 - ((t - scene.time[0]) / length - k as f64).abs()).max(0.0);
    scene.time.iter().zip(scene.displacement).map(|(t, x)| share(*t) * x).collect()
}

/// Outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mismatch {
    /// Chance of at least so much under the null.
    pub(super) p_value: f64,
    /// Squared standard deviations that the features take off.
    pub(super) gain: f64,
    /// The same that noise gives: the number of independent features.
    pub(super) freedom: usize,
}

impl Mismatch {
    /// No test could be made.
    pub(super) const NONE: Self = Self { p_value: 1.0, gain: 0.0, freedom: 0 };

    pub(super) fn new(gain: f64, freedom: usize) -> Self {
        let p_value = if freedom == 0 { 1.0 } else { chi_square_tail(gain, freedom) };
        Self { p_value, gain, freedom }
    }

    /// The same chance for a decision.
    pub(super) fn cautious(&self) -> f64 {
        Self::new(self.gain / CAUTION, self.freedom).p_value
    }

    /// Squared standard deviations that the features take off, beyond what noise gives.
    pub(super) fn excess(&self) -> f64 {
        (self.gain - self.freedom as f64).max(0.0)
    }
}

/// Projected products of some columns, scaled to unit length.
pub(super) struct Projected {
    gram: DMatrix<f64>,
    right: DVector<f64>,
    tame: DVector<f64>,
    bias: DVector<f64>,
    strays: Strays,
}

impl Projected {
    /// Columns that the projection leaves.
    pub(super) fn of(all: &Projection, chosen: &[usize]) -> Self {
        let Projection { gram, right, tame, bias, squares, strays } = all;
        let kept: Vec<usize> =
            chosen.iter().copied().filter(|i| gram[(*i, *i)] > SMALLEST_SHARE * squares[*i]).collect();
        let scale: Vec<f64> = kept.iter().map(|i| 1.0 / gram[(*i, *i)].sqrt()).collect();
        let of = |products: &DVector<f64>| DVector::from_fn(kept.len(), |a, _| products[kept[a]] * scale[a]);
        Self {
            gram: DMatrix::from_fn(kept.len(), kept.len(), |a, b| {
                gram[(kept[a], kept[b])] * scale[a] * scale[b]
            }),
            right: of(right),
            tame: of(tame),
            bias: of(bias),
            strays: strays.of(&kept, &scale),
        }
    }

    /// What the columns take off together.
    pub(super) fn mismatch(self) -> Mismatch {
        self.gains().map_or(Mismatch::NONE, |([gain, tame], freedom)| Mismatch::new(gain.min(tame), freedom))
    }

    /// That of the samples as they are, and where none of them is wild; with the number of independent columns.
    pub(super) fn gains(self) -> Option<([f64; 2], usize)> {
        if self.right.is_empty() {
            return None;
        }
        let eigen = self.gram.symmetric_eigen();
        let kept: Vec<usize> =
            (0..eigen.eigenvalues.len()).filter(|i| eigen.eigenvalues[*i] > 1e-6).collect();
        let along = DMatrix::from_fn(kept.len(), self.right.len(), |k, i| {
            eigen.eigenvectors[(i, kept[k])] / eigen.eigenvalues[kept[k]].sqrt()
        });
        let covariance = self.strays.combined(&along).covariance();
        let factor = covariance.cholesky()?;
        let even = |product: &DVector<f64>| factor.l().solve_lower_triangular(&(&along * product));
        let bias = even(&self.bias)?;
        let gain = |products: &DVector<f64>| {
            let right = even(products)?;
            let further = unsure(right.dot(&bias) / bias.norm_squared());
            Some((&right - &bias * further).norm_squared())
        };
        Some(([gain(&self.right)?, gain(&self.tame)?], kept.len()))
    }
}

/// The features beside a fitted model.
pub(super) struct Generic {
    /// What each depends on.
    on: Vec<On>,
    projected: Projection,
    /// True where the velocity of a recording is derived from its displacement.
    derived: bool,
    /// How much larger a gain is by chance because the noise was estimated.
    inflation: f64,
}

impl Generic {
    /// All features together.
    ///
    /// Where the velocity is derived, several linear filters of the motion could be combined to one that shows the
    /// noise of the displacement, which the force does not follow: they are left to the catalogue.
    pub(super) fn mismatch(&self) -> Mismatch {
        let filter = |on: On| matches!(on, On::Memory(_) | On::Acceleration);
        self.of(|on| !(self.derived && filter(on)))
    }

    /// Those that depend on some things.
    pub(super) fn of(&self, chosen: impl Fn(On) -> bool) -> Mismatch {
        let places: Vec<usize> = (0..self.on.len()).filter(|i| chosen(self.on[*i])).collect();
        let Mismatch { gain, freedom, .. } = Projected::of(&self.projected, &places).mismatch();
        Mismatch::new(gain / self.inflation, freedom)
    }

    /// What features depend on, each thing once.
    pub(super) fn things(&self) -> Vec<On> {
        let mut things: Vec<On> = Vec::new();
        for on in &self.on {
            if !things.contains(on) {
                things.push(*on);
            }
        }
        things
    }
}

impl Null<'_> {
    /// A stiffness that comes and goes in each recording on its own.
    pub(super) fn wandering(&self) -> Mismatch {
        let recordings = self.assembly().campaign().recordings().len();
        if recordings > MOST_RECORDINGS {
            return Mismatch::NONE;
        }
        let each = OWN_STRETCHES + 1;
        let projected = self.project(each * recordings, |view, r| {
            let scene = view.scene(r);
            (0..each).map(|k| (each * r + k, near(&scene, k, OWN_STRETCHES))).collect()
        });
        let all: Vec<usize> = (0..each * recordings).collect();
        let Mismatch { gain, freedom, .. } = Projected::of(&projected, &all).mismatch();
        Mismatch::new(gain / MORE_CAUTION, freedom)
    }

    /// A recording whose force or damping alone does not agree with the others: the features together dilute what is
    /// in one.
    pub(super) fn odd_recording(&self) -> Mismatch {
        let recordings = self.assembly().campaign().recordings().len();
        if !(2..=MOST_RECORDINGS).contains(&recordings) {
            return Mismatch::NONE;
        }
        let largest = |r: usize| {
            let motion = |scene: &Scene| vec![scene.force.to_vec(), scene.velocity.to_vec()];
            let own = strengths(self, (r, 2), &motion);
            own.into_iter().fold(0.0, |most: f64, s| most.max(s * s))
        };
        let gain = (0..recordings).map(largest).fold(0.0, f64::max);
        let (one, tests) = (Mismatch::new(gain / MORE_CAUTION, 1), 2.0 * recordings as f64);
        // The largest of so many reaches about twice their logarithm by chance.
        let by_chance = (2.0 * tests.ln()).ceil() as usize;
        Mismatch { p_value: (tests * one.p_value).min(1.0), freedom: by_chance, ..one }
    }

    /// Project the features.
    pub(super) fn generic(&self) -> Generic {
        let recordings = self.assembly().campaign().recordings().len();
        let own = if (2..=MOST_RECORDINGS).contains(&recordings) { recordings } else { 0 };
        let mut on: Vec<On> = features(&self.scene(0)).iter().map(|f| f.on).collect();
        on.extend([On::Time; STRETCHES - 1]);
        let count = on.len();
        on.extend(vec![On::Recording; own]);
        let projected = self.project(count + own, |view, r| {
            let scene = view.scene(r);
            let mut columns: Vec<(usize, Vec<f64>)> =
                features(&scene).into_iter().map(|f| f.column).chain(passing(&scene)).enumerate().collect();
            if own > 0 {
                columns.push((count + r, scene.force.to_vec()));
            }
            columns
        });
        let derived = self.assembly().campaign().recordings().iter().any(|r| r.velocity_window().is_some());
        Generic { on, projected, derived, inflation: self.noise().inflation() }
    }
}
