//! The window of local polynomials, by generalised cross-validation.

use rayon::prelude::*;

use super::local::{Local, NARROWEST, Polynomial, TERMS};
use super::stencil::Stencil;

/// Samples over which the window is chosen; more add cost, not certainty.
const TRIAL_SAMPLES: usize = 4_000;

/// More terms have to lower the error of cross-validation to less than this share.
const BETTER: f64 = 0.8;

/// Samples on either side, and terms of the polynomial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) half: usize,
    pub(super) terms: usize,
}

impl Window {
    /// The one with the smallest error of cross-validation; of few samples it is uncertain, and few terms carry less
    /// noise to the ends.
    pub(super) fn best(time: &[f64], displacement: &[f64], widest: usize, terms: &[usize]) -> Self {
        Self::with_least([time, displacement], widest, terms, |Error { square, leverage }| {
            square / (1.0 - leverage).powi(2)
        })
    }

    /// The one with the smallest error (Mallows 1973, <https://doi.org/10.1080/00401706.1973.10489103>) where the noise is
    /// known to have a variance: of few samples it is more certain.
    pub(super) fn knowing(variance: f64, time: &[f64], displacement: &[f64], terms: &[usize]) -> Self {
        if variance <= 0.0 {
            return Self::best(time, displacement, usize::MAX, terms);
        }
        Self::with_least([time, displacement], usize::MAX, terms, |Error { square, leverage }| {
            square + 2.0 * variance * leverage
        })
    }

    /// A line over all of a part of so many samples, where that is too short to choose another.
    pub(super) fn of_few(samples: usize) -> Option<Self> {
        let line = Self { half: ((samples - 1) / 2).max(1), terms: 2 };
        (samples <= 2 * NARROWEST).then_some(line)
    }

    fn with_least(
        [time, displacement]: [&[f64]; 2],
        widest: usize,
        terms: &[usize],
        score: impl Fn(Error) -> f64,
    ) -> Self {
        let n = time.len();
        let stride = n.div_ceil(TRIAL_SAMPLES);
        let mut best = (f64::INFINITY, Self { half: 0, terms: TERMS });
        for terms in terms {
            let mut own = (f64::INFINITY, best.1);
            for half in candidates(((n - 1) / 2).min(widest)) {
                let window = Self { half, terms: *terms };
                let score = score(window.error(time, displacement, stride));
                // A wider window wins ties: it carries less noise into the velocity.
                if score <= own.0 {
                    own = (score, window);
                } else if score > 4.0 * own.0 {
                    break;
                }
            }
            if own.0 < BETTER * best.0 {
                best = own;
            }
        }
        best.1
    }

    /// Squares that it leaves of a displacement whose noise has a variance, and twice those that it follows.
    pub(super) fn cost(self, variance: f64, time: &[f64], displacement: &[f64]) -> f64 {
        let Error { square, leverage } = self.error(time, displacement, 1);
        time.len() as f64 * (square + 2.0 * variance * leverage)
    }

    /// So many times twice as wide.
    pub(super) fn wider(self, octaves: usize) -> Self {
        Self { half: self.half << octaves, ..self }
    }

    /// Samples for each term: the more, the less noise comes into the velocity.
    pub(super) fn calm(self) -> f64 {
        self.half as f64 / self.terms as f64
    }

    /// Share that a sample has in its own value, in the middle of an even window.
    pub(super) fn leverage(self) -> f64 {
        let place: Vec<f64> = (0..=2 * self.half).map(|k| k as f64).collect();
        let middle = self.half as f64;
        Polynomial::around(&place, &place, self.half, self.half, self.terms).at(middle, middle).leverage
    }

    /// Velocity and displacement at every sample.
    pub(super) fn over(self, time: &[f64], displacement: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let fits = Fits::new(self, time, displacement);
        let local = |i: usize| {
            let local = fits.at(i);
            (local.slope, local.value)
        };
        (0..time.len()).into_par_iter().map(local).unzip()
    }

    fn error(self, time: &[f64], displacement: &[f64], stride: usize) -> Error {
        let picked: Vec<usize> = (0..time.len()).step_by(stride).collect();
        let fits = Fits::new(self, time, displacement);
        let errors: Vec<(f64, f64)> = picked
            .par_iter()
            .map(|&i| {
                let local = fits.at(i);
                ((displacement[i] - local.value).powi(2), local.leverage)
            })
            .collect();
        let count = errors.len() as f64;
        let (squares, leverage) = errors.iter().fold((0.0, 0.0), |sum, e| (sum.0 + e.0, sum.1 + e.1));
        Error { square: squares / count, leverage: leverage / count }
    }
}

/// What a window leaves.
struct Error {
    /// Mean square.
    square: f64,
    /// Mean share that a sample has in its own value.
    leverage: f64,
}

/// The fits of one window to a series.
struct Fits<'a> {
    window: Window,
    time: &'a [f64],
    displacement: &'a [f64],
    /// Of the first and of the last window: those of all samples near an end.
    ends: [Polynomial; 2],
    /// Of all others on an even grid.
    middle: Option<Stencil>,
}

impl<'a> Fits<'a> {
    fn new(window: Window, time: &'a [f64], displacement: &'a [f64]) -> Self {
        let Window { half, terms } = window;
        let ends = [0, time.len() - 1].map(|i| Polynomial::around(time, displacement, i, half, terms));
        Self { window, time, displacement, ends, middle: Stencil::new(time, half, terms) }
    }

    fn at(&self, i: usize) -> Local {
        let Window { half, terms } = self.window;
        let (time, displacement) = (self.time[i], self.displacement[i]);
        if i < half {
            self.ends[0].at(time, displacement)
        } else if i + half >= self.time.len() {
            self.ends[1].at(time, displacement)
        } else if let Some(stencil) = &self.middle {
            stencil.fit(&self.displacement[i - half..=i + half])
        } else {
            Polynomial::around(self.time, self.displacement, i, half, terms).at(time, displacement)
        }
    }
}

/// Half widths in samples, about a quarter apart.
fn candidates(largest: usize) -> Vec<usize> {
    let mut widths = vec![NARROWEST.min(largest)];
    while let Some(&last) = widths.last() {
        let next = last + 1 + last / 4;
        if next > largest {
            break;
        }
        widths.push(next);
    }
    widths
}
