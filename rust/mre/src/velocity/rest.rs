//! Where a motion rests: within its noise it stays where it is.

use super::octaves::noise_share;

/// A line leaves less than so many times the mean square of noise.
const LINE: f64 = 1.5;

/// What share of a motion beside its mean is noise, sample by sample, where its noise has these variances in mm².
///
/// Looked at over half a window of so many samples on either side, and over more, each time twice as many. A slow ramp goes no
/// further than its noise in a short time: where a longer one is a straight line, that tells. Where it is not, the motion is
/// another there.
pub(super) fn at_rest(motion: &[f64], variances: &[f64], half: usize, doublings: usize) -> Vec<f64> {
    let sums = Sums::of(motion);
    let mut rest: Vec<f64> = Vec::new();
    for k in 0..=doublings {
        let own = (0..motion.len()).map(|i| {
            let [mean, line] = sums.beside(i, half << k);
            let mean = noise_share(mean, variances[i]);
            // Where another motion just comes in, a line is none.
            let most = LINE * variances[i];
            let line = if line > most { (most / line).powi(4) } else { 1.0 };
            rest.get(i).map_or(mean, |before| line * mean + (1.0 - line) * before)
        });
        rest = own.collect();
    }
    rest
}

/// Sums of a series up to every sample: of its values about their mean, these times their place, and their squares.
struct Sums(Vec<[f64; 3]>);

impl Sums {
    fn of(series: &[f64]) -> Self {
        let middle = crate::recording::mean(series);
        let sums = series.iter().enumerate().scan([0.0; 3], |sums, (i, value)| {
            let own = value - middle;
            for (sum, term) in sums.iter_mut().zip([own, i as f64 * own, own * own]) {
                *sum += term;
            }
            Some(*sums)
        });
        Self(std::iter::once([0.0; 3]).chain(sums).collect())
    }

    /// Mean squares that the mean and a straight line leave over so many samples on either side of one.
    fn beside(&self, i: usize, reach: usize) -> [f64; 2] {
        let (first, end) = (i.saturating_sub(reach), (i + reach + 1).min(self.0.len() - 1));
        let [values, places, squares] = [0, 1, 2].map(|k| self.0[end][k] - self.0[first][k]);
        let count = (end - first) as f64;
        let centre = 0.5 * (first + end - 1) as f64;
        let spread = (squares - values * values / count).max(0.0);
        // Of the places about their middle.
        let square = count * (count * count - 1.0) / 12.0;
        let along = places - centre * values;
        let line = if square > 0.0 { (spread - along * along / square).max(0.0) } else { 0.0 };
        [spread / count, line / count]
    }
}

#[cfg(test)]
mod tests {
    use super::{Sums, at_rest};

    /// White noise of about unit variance that repeats late.
    fn noise(i: usize) -> f64 {
        let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
        12.0_f64.sqrt() * (x - x.floor() - 0.5)
    }

    #[test]
    fn sums_are_those_of_a_fit() {
        let series: Vec<f64> = (0..50).map(|i| 0.3 * f64::from(i) + noise(i as usize)).collect();
        let part = &series[15..36];
        let mean = part.iter().sum::<f64>() / 21.0;
        let along: f64 = part.iter().zip(-10..).map(|(x, k)| f64::from(k) * x).sum();
        let spread: f64 = part.iter().map(|x| (x - mean).powi(2)).sum();
        let line: f64 =
            part.iter().zip(-10..).map(|(x, k)| (x - mean - along / 770.0 * f64::from(k)).powi(2)).sum();
        let [of_mean, of_line] = Sums::of(&series).beside(25, 10);
        assert!((of_mean - spread / 21.0).abs() < 1e-10 && (of_line - line / 21.0).abs() < 1e-10);
    }

    #[test]
    fn a_rest_between_motions_is_one_and_a_slow_ramp_is_none() {
        let still: Vec<f64> =
            (0..3000).map(|i| noise(i) + if i < 1500 { 0.0 } else { 0.5 * (i - 1500) as f64 }).collect();
        let rest = at_rest(&still, &vec![1.0; 3000], 12, 5);
        let inner = &rest[200..1400];
        assert!(inner.iter().all(|share| *share > 0.8), "{:?}", inner.iter().fold(1.0_f64, |m, s| m.min(*s)));
        assert!(rest[1600..].iter().all(|share| *share < 0.1));
        // A tenth of its noise in half a window, and several times that in the longest.
        let ramp: Vec<f64> = (0..3000).map(|i| noise(i) + 0.01 * i as f64).collect();
        let rest = at_rest(&ramp, &vec![1.0; 3000], 12, 6);
        let inner = &rest[800..2200];
        assert!(inner.iter().all(|share| *share < 0.2), "{:?}", inner.iter().fold(0.0_f64, |m, s| m.max(*s)));
    }
}
