//! A low pass without delay: a windowed sinc.

use std::f64::consts::PI;

use crate::kernel::filter::dot;

/// Half the kernel, in periods of the cut-off frequency.
const REACH: f64 = 4.0;

/// Kernel of a cut-off frequency on an even grid.
pub(super) struct LowPass(Vec<f64>);

impl LowPass {
    /// Of a frequency in Hz, for a time step in s.
    pub(super) fn new(frequency: f64, step: f64) -> Self {
        let half = (REACH / (frequency * step)).ceil() as i64;
        let turn = 2.0 * PI * frequency * step;
        let kernel = |k: i64| {
            let (k, window) = (k as f64, 0.5 * (1.0 + (PI * k as f64 / (half + 1) as f64).cos()));
            window * if k == 0.0 { turn } else { (turn * k).sin() / k }
        };
        let kernel: Vec<f64> = (-half..=half).map(kernel).collect();
        let whole: f64 = kernel.iter().sum();
        Self(kernel.iter().map(|k| k / whole).collect())
    }

    /// What it passes of two series.
    pub(super) fn over_both(&self, series: &[Vec<f64>; 2]) -> Option<[Vec<f64>; 2]> {
        Some([self.over(&series[0])?, self.over(&series[1])?])
    }

    /// What it passes of a series, mirrored beyond its ends; `None` for one that is shorter than the kernel.
    fn over(&self, series: &[f64]) -> Option<Vec<f64>> {
        let (n, half) = (series.len(), self.0.len() / 2);
        if self.0.len() > n {
            return None;
        }
        let before = series[1..=half].iter().rev();
        let after = series[n - 1 - half..n - 1].iter().rev();
        let mirrored: Vec<f64> = before.chain(series).chain(after).copied().collect();
        Some(mirrored.windows(self.0.len()).map(|part| dot(&self.0, part)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_passes_and_fast_does_not() {
        let step = 0.005;
        let low_pass = LowPass::new(6.0, step);
        for (frequency, passes) in [(0.0, 1.0), (0.7, 1.0), (4.0, 1.0), (9.0, 0.0), (40.0, 0.0)] {
            let wave = |i: u32| (2.0 * PI * frequency * step * f64::from(i) + 0.3).cos();
            let series: Vec<f64> = (0..2000).map(wave).collect();
            let passed = low_pass.over(&series).unwrap_or_default();
            for i in 400..1600 {
                assert!((passed[i] - passes * series[i]).abs() < 0.01, "{frequency} Hz");
            }
        }
        assert!(low_pass.over(&[0.0; 100]).is_none());
    }
}
