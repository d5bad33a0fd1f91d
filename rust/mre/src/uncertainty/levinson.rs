//! From autocovariances to an autoregression.

/// Largest reflection coefficient: a memory of about the whole recording.
pub(super) fn limit(n: usize) -> f64 {
    1.0 - 1.0 / n as f64
}

/// `sum_t e_t e_(t + lag)` for every lag up to the last.
pub(super) fn products(values: &[f64], last: usize) -> Vec<f64> {
    let product = |lag: usize| values.iter().zip(&values[lag..]).map(|(a, b)| a * b).sum();
    (0..=last).map(product).collect()
}

/// Recursion of Levinson and Durbin for the Yule-Walker equations.
pub(super) struct Levinson {
    pub(super) phi: Vec<f64>,
    pub(super) variance: f64,
    pub(super) autocovariance: Vec<f64>,
}

impl Levinson {
    /// Order zero: white noise.
    pub(super) fn new(variance: f64) -> Self {
        Self { phi: Vec::new(), variance, autocovariance: vec![variance] }
    }

    /// One order more. False, and nothing done, where the reflection coefficient is beyond its limit.
    pub(super) fn raise(&mut self, wanted: f64, limit: f64) -> bool {
        let m = self.phi.len();
        let expected: f64 = (0..m).map(|j| self.phi[j] * self.autocovariance[m - j]).sum();
        let reflection = (wanted - expected) / self.variance;
        if reflection.is_nan() || reflection.abs() > limit {
            return false;
        }
        self.autocovariance.push(wanted);
        self.phi = (0..m).map(|j| self.phi[j] - reflection * self.phi[m - 1 - j]).collect();
        self.phi.push(reflection);
        self.variance *= 1.0 - reflection * reflection;
        true
    }
}
