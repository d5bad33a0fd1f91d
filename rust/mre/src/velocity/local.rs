//! Local polynomials by least squares, at any times.

use nalgebra::{Cholesky, Const};

/// Coefficients of the polynomial. A cubic has to take a window so short, where motion is curved, that it lets four
/// times as much noise into the velocity.
pub(super) const TERMS: usize = 8;
/// Samples at a time.
const LANES: usize = 8;

type Square = nalgebra::SMatrix<f64, TERMS, TERMS>;
pub(super) type Column = nalgebra::SVector<f64, TERMS>;

/// Half window with more samples than coefficients.
pub(super) const NARROWEST: usize = TERMS / 2;

/// What a polynomial says of a sample.
pub(super) struct Local {
    /// At the sample.
    pub(super) value: f64,
    /// Its slope there.
    pub(super) slope: f64,
    /// Share that the sample itself has in the value.
    pub(super) leverage: f64,
}

/// Polynomial fitted to the samples within a window.
pub(super) struct Polynomial {
    centre: f64,
    scale: f64,
    terms: usize,
    /// Displacement that the polynomial is counted from.
    base: f64,
    /// `None` for times that nearly coincide.
    found: Option<(Cholesky<f64, Const<TERMS>>, Column)>,
    /// Slope of the chord of the window.
    chord: f64,
}

impl Polynomial {
    /// The fit of at most so many `terms` to `half` samples on either side of sample `i`.
    pub(super) fn around(time: &[f64], displacement: &[f64], i: usize, half: usize, terms: usize) -> Self {
        let last = time.len() - 1;
        // At the ends the window is shifted, not shortened, so that the noise stays bounded.
        let start = i.saturating_sub(half).min(last.saturating_sub(2 * half));
        let stop = (start + 2 * half).min(last);
        let (centre, scale) = (0.5 * (time[start] + time[stop]), 0.5 * (time[stop] - time[start]));
        let base = displacement[i];
        let mut moments = [[0.0; LANES]; 2 * TERMS - 1];
        let mut right = [[0.0; LANES]; TERMS];
        for (t, x) in time[start..=stop].chunks(LANES).zip(displacement[start..=stop].chunks(LANES)) {
            // Lanes without a sample stay zero through the recurrence.
            let (mut place, mut rise, mut term) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
            for lane in 0..t.len() {
                place[lane] = (t[lane] - centre) / scale;
                rise[lane] = x[lane] - base;
                term[lane] = 1.0;
            }
            let mut next = place;
            for k in 0..2 * TERMS - 1 {
                for lane in 0..LANES {
                    moments[k][lane] += term[lane];
                    if k < TERMS {
                        right[k][lane] += term[lane] * rise[lane];
                    }
                    (term[lane], next[lane]) = (next[lane], 2.0 * place[lane] * next[lane] - term[lane]);
                }
            }
        }
        let moments = moments.map(|lanes| lanes.iter().sum::<f64>());
        let right = right.map(|lanes| lanes.iter().sum());
        // A short recording has a lower degree: its other rows are those of the identity.
        let terms = terms.min(stop - start);
        let found = normal_matrix(&moments, terms).cholesky().map(|factor| {
            let coefficients = factor.solve(&first(right, terms));
            (factor, coefficients)
        });
        let chord = (displacement[stop] - displacement[start]) / (time[stop] - time[start]);
        Self { centre, scale, terms, base, found, chord }
    }

    /// What it says of a sample of its window.
    pub(super) fn at(&self, time: f64, displacement: f64) -> Local {
        let place = (time - self.centre) / self.scale;
        let here = first(chebyshev(place), self.terms);
        let rise = first(slopes(place), self.terms);
        match &self.found {
            Some((factor, found)) => Local {
                value: self.base + found.dot(&here),
                slope: found.dot(&rise) / self.scale,
                leverage: factor.solve(&here).dot(&here),
            },
            None => Local { value: displacement, slope: self.chord, leverage: 0.5 },
        }
    }
}

/// The first terms of a column, and zeros.
pub(super) fn first(column: [f64; TERMS], terms: usize) -> Column {
    Column::from_fn(|r, _| if r < terms { column[r] } else { 0.0 })
}

/// Sums of products of Chebyshev polynomials, from their own: `T_r T_c = (T_(r+c) + T_|r-c|) / 2`.
pub(super) fn normal_matrix(moments: &[f64; 2 * TERMS - 1], terms: usize) -> Square {
    Square::from_fn(|r, c| {
        if r.max(c) < terms {
            0.5 * (moments[r + c] + moments[r.abs_diff(c)])
        } else {
            f64::from(u8::from(r == c))
        }
    })
}

/// Chebyshev polynomials at u, of degree 0 to N - 1.
pub(super) fn chebyshev<const N: usize>(u: f64) -> [f64; N] {
    let mut terms = [1.0; N];
    terms[1] = u;
    for k in 2..N {
        terms[k] = 2.0 * u * terms[k - 1] - terms[k - 2];
    }
    terms
}

/// Their derivatives.
pub(super) fn slopes(u: f64) -> [f64; TERMS] {
    let terms: [f64; TERMS] = chebyshev(u);
    let mut found = [0.0; TERMS];
    found[1] = 1.0;
    for k in 2..TERMS {
        found[k] = 2.0 * (terms[k - 1] + u * found[k - 1]) - found[k - 2];
    }
    found
}
