//! What windows of polynomials, each twice as wide as the one before, take off a motion, and what of it is noise.

use super::low_pass::LowPass;
use super::window::Window;

/// Widest half window in samples.
const WIDEST: usize = 1024;
/// Cut-off frequencies that are tried are so many times apart.
const APART: f64 = 1.15;
/// An octave with less than so many times the mean square that noise has is noise.
const NOISE: f64 = 2.0;
/// Displacement, mm, and velocity, mm/s.
pub(super) type Motion = [Vec<f64>; 2];

/// A motion that was smoothed.
#[derive(Clone)]
pub(super) struct Smooth {
    pub(super) motion: Motion,
    /// Of the local polynomials, before any low pass.
    pub(super) window: Window,
    /// Share of white noise that is left in the displacement, mean square.
    pub(super) share: f64,
}

impl Smooth {
    /// Mean square that smoothing takes off a measured displacement.
    pub(super) fn left_of(&self, measured: &[f64]) -> f64 {
        let square = |(a, b): (&f64, &f64)| (a - b).powi(2);
        measured.iter().zip(&self.motion[0]).map(square).sum::<f64>() / measured.len() as f64
    }
}

pub(super) fn each(a: &[f64], b: &[f64], of: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| of(*a, *b)).collect()
}

pub(super) fn less(all: &Motion, part: &Motion) -> Motion {
    [0, 1].map(|k| each(&all[k], &part[k], |all, part| all - part))
}

/// What a wider window takes off a motion.
fn octave(narrow: &Motion, (wide, half): (&Motion, usize)) -> Motion {
    let n = narrow[0].len();
    // Near its ends a recording has windows that are off their middle.
    let rises = |i: usize| ((i.min(n - 1 - i) as f64 / half as f64) - 1.0).clamp(0.0, 1.0);
    less(narrow, wide).map(|part| part.iter().enumerate().map(|(i, d)| rises(i) * d).collect())
}

/// A motion of whose octave beyond a wider window only what is below a frequency in Hz is left.
pub(super) fn low_passed(
    narrow: &Motion,
    wide: (&Motion, usize),
    frequency: f64,
    step: f64,
) -> Option<Motion> {
    let octave = octave(narrow, wide);
    let kept = LowPass::new(frequency, step).over_both(&octave)?;
    Some(less(narrow, &less(&octave, &kept)))
}

/// A measured displacement on an even grid, and the variance of its noise.
pub(super) struct Noisy<'a> {
    pub(super) time: &'a [f64],
    pub(super) measured: &'a [f64],
    pub(super) step: f64,
    pub(super) variance: f64,
}

impl Noisy<'_> {
    /// The motion of a window, where it is not too wide.
    pub(super) fn smooth(&self, window: Window) -> Option<Smooth> {
        (window.half <= WIDEST.min(self.time.len() / 4)).then(|| {
            let (slope, value) = window.over(self.time, self.measured);
            Smooth { motion: [value, slope], window, share: window.leverage() }
        })
    }

    /// The motion of a window with the low pass, of what a wider one takes off, that has the smallest error; and its
    /// cut-off frequency in Hz, if one is better than none.
    pub(super) fn low_passed(&self, narrow: &Smooth, wide: &Smooth) -> (Smooth, Option<f64>) {
        let risk = |smooth: &Smooth| smooth.left_of(self.measured) + 2.0 * self.variance * smooth.share;
        let mut frequency = 0.5 * narrow.share / self.step;
        let (mut least, mut best) = (risk(narrow), (narrow.clone(), None));
        while 2.0 * frequency * self.step > wide.share {
            let passed = low_passed(&narrow.motion, (&wide.motion, wide.window.half), frequency, self.step);
            let Some(motion) = passed else { break };
            let tried = Smooth { motion, window: narrow.window, share: 2.0 * frequency * self.step };
            let of_tried = risk(&tried);
            if of_tried < least {
                (least, best) = (of_tried, (tried, Some(frequency)));
            }
            frequency /= APART;
        }
        best
    }

    /// Octave by octave from a motion and the next slower one on: what share of it is noise, sample by sample; and what
    /// share of the variance of the noise is left then.
    pub(super) fn shares_of_octaves(&self, fastest: Smooth, next: Smooth) -> (Vec<Vec<f64>>, Vec<f64>) {
        let mut shares = Vec::new();
        let mut left = vec![fastest.share; self.time.len()];
        let (mut fast, mut slower) = (fastest, Some(next));
        while let Some(slow) = slower {
            // The kernel of a least squares fit is a polynomial, which a narrower fit keeps.
            let less = (fast.share - slow.share).max(0.0);
            let octave = each(&fast.motion[0], &slow.motion[0], |fast, slow| fast - slow);
            let squares = around(&octave, 2 * slow.window.half);
            let own: Vec<f64> =
                squares.into_iter().map(|square| noise_share(square, self.variance * less)).collect();
            left = each(&left, &own, |left, own| left - own * less);
            shares.push(own);
            slower = self.smooth(slow.window.wider(1));
            fast = slow;
        }
        (shares, left)
    }
}

/// What share of something is noise that has this mean square where noise alone has that.
pub(super) fn noise_share(square: f64, noise: f64) -> f64 {
    if square > NOISE * noise { (NOISE * noise / square).powi(2) } else { 1.0 }
}

/// Mean square over so many samples on either side.
fn around(series: &[f64], reach: usize) -> Vec<f64> {
    let mut sums = vec![0.0];
    sums.extend(series.iter().scan(0.0, |sum, e| {
        *sum += e * e;
        Some(*sum)
    }));
    (0..series.len())
        .map(|i| {
            let (first, end) = (i.saturating_sub(reach), (i + reach + 1).min(series.len()));
            (sums[end] - sums[first]) / (end - first) as f64
        })
        .collect()
}
