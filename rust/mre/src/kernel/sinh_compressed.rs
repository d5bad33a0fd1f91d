//! Squared error of the sinh model (eq. 5) at a cost that does not depend on the number of samples.
//!
//! The residual is `c0 v + F0 + k0 x + alpha sinh(beta x) - F`, and `sinh(beta x)` is a sum of K odd
//! Chebyshev polynomials of x / xm with coefficients `2 I_(2k+1)(beta xm)`: exact to one rounding of
//! sinh at every sample, by the bound of [`super::bessel`]. So the residual is `A u` with the columns
//! `[v, 1, T1, T3, ..., F]` for A, and its weighted square is `||R u||^2` with the triangular factor R
//! of A, found in one pass over the samples. Lanes run over candidates.

use std::ops::Range;
use std::sync::Arc;

use super::bessel::{Bessel, MOST_NODES, nodes};
use super::dispatch::{self, Isa, for_every_isa};
use super::elementary::fma;
use super::triangle::{ROWS, Triangle};
use crate::recording::Recording;

/// Candidates evaluated side by side.
pub(crate) const LANES: usize = 8;
/// Rows of the factor that are multiplied side by side.
const GROUP: usize = 4;
/// Columns of most problems: beta up to about 5 / largest displacement.
const FEW: usize = 16;
/// Samples of one leaf of the tree of factors: fixed, so that the tree is.
const LEAF: usize = 64 * ROWS;
/// Columns beside the Chebyshev polynomials: v, 1, F.
pub(crate) const OTHERS: usize = 3;

/// All scored samples of a problem in one triangular factor.
#[derive(Debug, Clone)]
pub(crate) struct SinhCompressed {
    triangle: Triangle,
    /// The factor by groups of rows, each column by column from the diagonal on.
    packed: Vec<[f64; GROUP]>,
    bessel: Bessel,
    farthest: f64,
    largest_beta: f64,
    isa: Isa,
}

impl SinhCompressed {
    /// Compress recordings with a force; the squares of each count by its weight.
    ///
    /// `None` where `largest_beta` asks for too many nodes, or nothing moves.
    pub(crate) fn new(recordings: &[Arc<Recording>], weights: &[f64], largest_beta: f64) -> Option<Self> {
        let farthest = farthest(recordings);
        let largest = largest_beta.abs() * farthest;
        let nodes = if farthest > 0.0 { nodes(largest)? } else { return None };
        Some(Self::from_triangle(factor(recordings, weights, farthest, nodes), nodes, farthest, largest_beta))
    }

    /// From a factor of `[v, 1, T1(x / farthest), T3, ..., F]`, for candidates with beta up to
    /// `largest_beta`.
    pub(crate) fn from_triangle(triangle: Triangle, nodes: usize, farthest: f64, largest_beta: f64) -> Self {
        let n = triangle.columns();
        let mut packed = Vec::with_capacity(n * n / 2 + n * GROUP);
        for first in (0..n).step_by(GROUP) {
            for j in first..n {
                let entry = |i: usize| if i < n { triangle.at(i, j) } else { 0.0 };
                packed.push(std::array::from_fn(|r| entry(first + r)));
            }
        }
        let (bessel, isa) = (Bessel::new(nodes, largest_beta.abs() * farthest), dispatch::best());
        Self { triangle, packed, bessel, farthest, largest_beta: largest_beta.abs(), isa }
    }

    /// True for a candidate that this kernel can evaluate.
    pub(crate) fn holds(&self, candidate: &[f64]) -> bool {
        candidate[3].abs() <= self.largest_beta
    }

    /// Weighted sums of squared errors of up to [`LANES`] candidates `[c0, k0, alpha, beta, F0]`, one
    /// after the other. A candidate's value does not depend on the others.
    pub(crate) fn sums_of_squares(&self, rows: &[f64], out: &mut [f64]) {
        let count = (rows.len() / 5).min(LANES);
        if count == 0 {
            return;
        }
        let mut block = [[0.0; LANES]; 5];
        for l in 0..LANES {
            let row = &rows[5 * l.min(count - 1)..];
            for k in 0..5 {
                block[k][l] = row[k];
            }
        }
        let sums = evaluate(self.isa, self, &block);
        out[..count].copy_from_slice(&sums[..count]);
    }

    /// The factor of `[v, 1, T1, T3, ..., F]`.
    pub(crate) fn triangle(&self) -> &Triangle {
        &self.triangle
    }

    /// Coordinates of `sum_k 2 orders[2k+1] T_(2k+1)`: of sinh(b t) for Bessel functions of b.
    pub(crate) fn series(&self, orders: &[f64], out: &mut [f64]) {
        let n = self.triangle.columns();
        for (i, value) in out[..n].iter_mut().enumerate() {
            let first = i.max(2);
            let row = &self.triangle.row(i)[first - i..n - 1 - i];
            let odd = orders[2 * first - 3..].iter().step_by(2);
            *value = row.iter().zip(odd).map(|(r, order)| 2.0 * r * order).sum();
        }
    }

    /// Largest displacement, mm.
    pub(crate) fn farthest(&self) -> f64 {
        self.farthest
    }

    /// The Bessel functions of the box.
    pub(crate) fn bessel(&self) -> &Bessel {
        &self.bessel
    }
}

for_every_isa!(evaluate, evaluate_generic, (on: &SinhCompressed, block: &[[f64; LANES]; 5]) -> [f64; LANES]);

#[inline(always)]
fn evaluate_generic<const FUSED: bool>(on: &SinhCompressed, block: &[[f64; LANES]; 5]) -> [f64; LANES] {
    if on.triangle.columns() <= FEW {
        evaluate_within::<FUSED, FEW>(on, block)
    } else {
        evaluate_within::<FUSED, { MOST_NODES + OTHERS }>(on, block)
    }
}

/// With room for `MOST` columns, which takes time to clear.
#[inline(always)]
fn evaluate_within<const FUSED: bool, const MOST: usize>(
    on: &SinhCompressed,
    block: &[[f64; LANES]; 5],
) -> [f64; LANES] {
    let [c0, k0, alpha, beta, f0] = block;
    let n = on.triangle.columns();
    let mut u = [[0.0; LANES]; MOST];
    let mut b = [0.0; LANES];
    for l in 0..LANES {
        b[l] = beta[l] * on.farthest;
    }
    (u[0], u[1], u[n - 1]) = (*c0, *f0, [-1.0; LANES]);
    on.bessel.odd::<FUSED, LANES>(&b, alpha, &mut u[2..n - 1]);
    for l in 0..LANES {
        u[2][l] = fma::<FUSED>(k0[l], on.farthest, u[2][l]);
    }
    let mut sums = [0.0; LANES];
    let mut next = on.packed.iter();
    for first in (0..n).step_by(GROUP) {
        let mut rows = [[0.0; LANES]; GROUP];
        for (u, entries) in u[first..n].iter().zip(&mut next) {
            for r in 0..GROUP {
                for l in 0..LANES {
                    rows[r][l] = fma::<FUSED>(entries[r], u[l], rows[r][l]);
                }
            }
        }
        for row in &rows {
            for l in 0..LANES {
                sums[l] = fma::<FUSED>(row[l], row[l], sums[l]);
            }
        }
    }
    sums
}

/// Largest absolute displacement of the scored samples, mm.
pub(crate) fn farthest(recordings: &[Arc<Recording>]) -> f64 {
    let scored = recordings.iter().flat_map(|r| &r.displacement()[r.scored()]);
    scored.fold(0.0, |far, x| x.abs().max(far))
}

/// Triangular factor of `[v, 1, T1(x / farthest), T3, ..., F]` over the scored samples, rows times the
/// root of their weight.
pub(crate) fn factor(
    recordings: &[Arc<Recording>],
    weights: &[f64],
    farthest: f64,
    nodes: usize,
) -> Triangle {
    let mut leaves = Vec::new();
    for (recording, weight) in recordings.iter().zip(weights) {
        let scored = recording.scored();
        let motion = Motion {
            displacement: &recording.displacement()[scored.clone()],
            velocity: &recording.velocity()[scored.clone()],
            force: &recording.force().unwrap_or_default()[scored],
        };
        leaves.extend(motion.leaves(weight.sqrt(), farthest));
    }
    tree(&leaves, nodes)
}

/// Samples, in series of one length.
#[derive(Clone, Copy)]
pub(crate) struct Motion<'a> {
    /// mm
    pub(crate) displacement: &'a [f64],
    /// mm/s
    pub(crate) velocity: &'a [f64],
    /// N
    pub(crate) force: &'a [f64],
}

impl<'a> Motion<'a> {
    /// In parts of a fixed length; rows are multiplied by `scale`.
    pub(crate) fn leaves(self, scale: f64, farthest: f64) -> impl Iterator<Item = Leaf<'a>> {
        (0..self.force.len()).step_by(LEAF).map(move |first| {
            let samples = first..(first + LEAF).min(self.force.len());
            Leaf { motion: self, samples, scale, farthest }
        })
    }
}

/// A part of a motion.
pub(crate) struct Leaf<'a> {
    motion: Motion<'a>,
    samples: Range<usize>,
    scale: f64,
    farthest: f64,
}

/// True where [`factor`] works on the calling thread alone.
pub(crate) fn is_one_leaf(recordings: &[Arc<Recording>]) -> bool {
    matches!(recordings, [one] if one.scored().len() <= LEAF)
}

/// Factors of the leaves, joined in pairs: a tree that only the samples decide, short so that
/// roundings do not add up, in parallel.
pub(crate) fn tree(leaves: &[Leaf<'_>], nodes: usize) -> Triangle {
    let [leaf] = leaves else {
        let (left, right) = leaves.split_at(leaves.len() / 2);
        if left.is_empty() {
            return Triangle::new(nodes + OTHERS);
        }
        let (mut whole, rest) = rayon::join(|| tree(left, nodes), || tree(right, nodes));
        whole.join(&rest);
        return whole;
    };
    let mut triangle = Triangle::new(nodes + OTHERS);
    let isa = dispatch::best();
    for first in leaf.samples.clone().step_by(ROWS) {
        let samples = first..(first + ROWS).min(leaf.samples.end);
        triangle.absorb(samples.len(), |block| fill(isa, leaf, samples, block));
    }
    triangle
}

for_every_isa!(fill, fill_generic, (leaf: &Leaf<'_>, samples: Range<usize>, block: &mut [f64]) -> ());

#[inline(always)]
fn fill_generic<const FUSED: bool>(leaf: &Leaf<'_>, samples: Range<usize>, block: &mut [f64]) {
    let (n, rows) = (block.len() / ROWS, samples.len());
    let scaled = |from: &[f64], to: &mut [f64]| {
        for (to, from) in to.iter_mut().zip(from) {
            *to = leaf.scale * from;
        }
    };
    let x = &leaf.motion.displacement[samples.clone()];
    scaled(&leaf.motion.velocity[samples.clone()], &mut block[..rows]);
    block[ROWS..ROWS + rows].fill(leaf.scale);
    scaled(&leaf.motion.force[samples], &mut block[(n - 1) * ROWS..(n - 1) * ROWS + rows]);
    // T_(m+2) = (4 t^2 - 2) T_m - T_(m-2), with T_-1 = T_1.
    let (mut turn, mut before, mut now) = ([0.0; ROWS], [0.0; ROWS], [0.0; ROWS]);
    for (i, x) in x.iter().enumerate() {
        let t = x / leaf.farthest;
        turn[i] = fma::<FUSED>(4.0 * t, t, -2.0);
        now[i] = leaf.scale * t;
        before[i] = now[i];
    }
    for column in block[2 * ROWS..(n - 1) * ROWS].chunks_exact_mut(ROWS) {
        column[..rows].copy_from_slice(&now[..rows]);
        for i in 0..ROWS {
            let after = fma::<FUSED>(turn[i], now[i], -before[i]);
            (before[i], now[i]) = (now[i], after);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::kernel::example;

    #[test]
    fn every_instruction_set_gives_the_same() {
        let best = SinhCompressed::new(&[example::recording()], &[0.002], 1.0).unwrap();
        let rows = [0.1, 2.0, 8.0, 0.98, 0.3, 0.0, 0.0, 9.0, 1.0, 0.0, 0.0, 5.0, -3.0, 0.1, 4.0];
        let costs = |isa| {
            let mut costs = [0.0; 3];
            SinhCompressed { isa, ..best.clone() }.sums_of_squares(&rows, &mut costs);
            costs
        };
        let plain = costs(Isa::Plain);
        for isa in dispatch::available() {
            let found = costs(isa);
            assert!(found.iter().zip(plain).all(|(a, b)| (a - b).abs() <= 1e-12 * b), "{isa:?} {found:?}");
        }
    }
}
