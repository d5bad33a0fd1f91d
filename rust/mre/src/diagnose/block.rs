//! The columns of one start of a law, projected: what they take off, and how often noise takes off as much.

use nalgebra::{DMatrix, DVector};

use super::bounded;
use super::distribution::{chi_square_beyond, chi_square_tail};
use super::shaken::unsure;
use super::strays::Strays;

/// Share of a column's square that has to survive the projection: below it the column is absorbed.
pub(super) const SMALLEST_SHARE: f64 = 1e-8;

/// Keeps the products solvable, scaled to ones on the diagonal.
const RIDGE: f64 = 1e-9;

/// The columns of one start of a law, projected.
#[derive(Clone)]
pub(super) struct Block {
    pub(super) gram: DMatrix<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Largest share of a column that the projection left.
    pub(super) visible: f64,
}

impl Block {
    pub(super) fn new(mut gram: DMatrix<f64>, squares: &[f64], lower: Vec<f64>, upper: Vec<f64>) -> Self {
        let mut visible: f64 = 0.0;
        for (i, square) in squares.iter().enumerate() {
            let share = if *square > 0.0 { gram[(i, i)] / square } else { 0.0 };
            if share < SMALLEST_SHARE {
                gram.row_mut(i).fill(0.0);
                gram.column_mut(i).fill(0.0);
            } else {
                visible = visible.max(share);
            }
        }
        Self { gram, lower, upper, visible }
    }

    /// The same where noise of the motions scatters the products further.
    pub(super) fn scattered(&self, strays: &Strays) -> Self {
        let size: Vec<f64> = (0..self.gram.nrows()).map(|i| self.gram[(i, i)].sqrt()).collect();
        let kept: Vec<usize> = (0..size.len()).filter(|i| size[*i] > 0.0).collect();
        if kept.is_empty() {
            return self.clone();
        }
        let scale: Vec<f64> = kept.iter().map(|i| 1.0 / size[*i]).collect();
        let scaled = DMatrix::from_fn(kept.len(), kept.len(), |a, b| {
            self.gram[(kept[a], kept[b])] * scale[a] * scale[b]
        });
        let eigen = scaled.symmetric_eigen();
        let along = |power: f64| {
            let sizes = eigen.eigenvalues.map(|value| value.max(RIDGE).powf(power));
            &eigen.eigenvectors * DMatrix::from_diagonal(&sizes)
        };
        let root = along(0.5);
        let more = strays.of(&kept, &scale).combined(&along(-0.5).transpose()).beyond();
        let more = &root * more * root.transpose();
        let mut gram = self.gram.clone();
        for (a, i) in kept.iter().enumerate() {
            for (b, j) in kept.iter().enumerate() {
                gram[(*i, *j)] += more[(a, b)] * size[*i] * size[*j];
            }
        }
        Self { gram, ..self.clone() }
    }

    /// Squared standard deviations that the columns take off, with admissible coefficients.
    pub(super) fn gain(&self, right: &DVector<f64>) -> f64 {
        if right.len() == 1 {
            let c = self.gram[(0, 0)];
            let value = right[0];
            let admissible = (value > 0.0 && self.upper[0] > 0.0) || (value < 0.0 && self.lower[0] < 0.0);
            return if c > 0.0 && admissible { value * value / c } else { 0.0 };
        }
        let c = DVector::from_vec(bounded::minimise(&self.gram, right, &self.lower, &self.upper));
        (2.0 * right.dot(&c) - c.dot(&(&self.gram * &c))).max(0.0)
    }

    /// The smallest of the gains that are left of products once a bias is taken off, as far as its size is not known.
    pub(super) fn least_gain(&self, right: &DVector<f64>, bias: &DVector<f64>) -> f64 {
        let here = self.gain(right);
        if bias.amax() == 0.0 {
            return here;
        }
        let solved = DMatrix::from_fn(self.gram.nrows(), self.gram.nrows(), |i, j| {
            self.gram[(i, j)] + if i == j { RIDGE * self.gram[(i, i)] + f64::MIN_POSITIVE } else { 0.0 }
        });
        let wanted = solved.cholesky().map_or(0.0, |factor| {
            let of_bias = factor.solve(bias);
            right.dot(&of_bias) / bias.dot(&of_bias)
        });
        let tried = [wanted, f64::INFINITY].map(|wanted| self.gain(&(right - bias * unsure(wanted))));
        tried.into_iter().fold(here, f64::min)
    }

    /// Gain that the null reaches with this chance; none where the projection leaves nothing.
    pub(super) fn reached(&self, chance: f64) -> f64 {
        match self.freedom() {
            0 => f64::INFINITY,
            freedom => chi_square_beyond(chance / self.sides(), freedom),
        }
    }

    /// Chance of at least this gain under the null.
    pub(super) fn tail(&self, gain: f64) -> f64 {
        let freedom = self.freedom();
        if freedom == 0 || gain <= 0.0 {
            return 1.0;
        }
        chi_square_tail(gain, freedom) * self.sides()
    }

    fn freedom(&self) -> usize {
        (0..self.gram.nrows()).filter(|i| self.gram[(*i, *i)] > 0.0).count()
    }

    /// Share of the signs that count.
    fn sides(&self) -> f64 {
        let one_sided = self.freedom() == 1 && (self.lower[0] == 0.0 || self.upper[0] == 0.0);
        if one_sided { 0.5 } else { 1.0 }
    }
}
