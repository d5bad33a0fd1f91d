//! Is a recorded velocity a difference quotient of the displacement? One of noisy or coarsely sampled displacement biases
//! the damping, and what it does to the force looks like an effect that the device has not.

/// A difference quotient is so many times as near to what was recorded as to the slope.
const NEARER: f64 = 10.0;

/// True where a velocity in mm/s is the backward, forward or central difference of the displacement in mm, which its `slope`
/// in mm/s is not.
pub(crate) fn is_quotient(time: &[f64], displacement: &[f64], velocity: &[f64], slope: &[f64]) -> bool {
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slopes: Vec<f64> =
        displacement.windows(2).zip(&steps).map(|(pair, step)| (pair[1] - pair[0]) / step).collect();
    let central = |i: usize| {
        let (before, after) = (steps[i - 1], steps[i]);
        (before * slopes[i] + after * slopes[i - 1]) / (before + after)
    };
    let is = |quotient: &dyn Fn(usize) -> f64| {
        let apart = |series: &[f64]| {
            (1..series.len() - 1).map(|i| (series[i] - quotient(i)).powi(2)).sum::<f64>().sqrt()
        };
        NEARER * apart(velocity) < apart(slope)
    };
    is(&central) || is(&|i| slopes[i - 1]) || is(&|i| slopes[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_told_from_slopes_on_even_and_uneven_times() {
        let motion = |t: f64| 3.0 * (20.0 * t).sin();
        let slope = |t: f64| 60.0 * (20.0 * t).cos();
        for uneven in [0.0, 0.3] {
            let time: Vec<f64> =
                (0..500).map(|i| (f64::from(i) + uneven * f64::from(i).sin()) * 0.01).collect();
            let x: Vec<f64> = time.iter().map(|t| motion(*t)).collect();
            let v: Vec<f64> = time.iter().map(|t| slope(*t)).collect();
            let difference = |i: usize, j: usize| (x[j] - x[i]) / (time[j] - time[i]);
            let backward: Vec<f64> =
                (0..500).map(|i| if i > 0 { difference(i - 1, i) } else { 0.0 }).collect();
            let forward: Vec<f64> =
                (0..500).map(|i| if i < 499 { difference(i, i + 1) } else { 0.0 }).collect();
            let central: Vec<f64> = (0..500)
                .map(|i| match i {
                    0 | 499 => 0.0,
                    _ => {
                        let (before, after) = (time[i] - time[i - 1], time[i + 1] - time[i]);
                        (before * forward[i] + after * backward[i]) / (before + after)
                    }
                })
                .collect();
            for quotient in [&backward, &forward, &central] {
                assert!(is_quotient(&time, &x, quotient, &v));
                // As a file rounds it.
                let rounded: Vec<f64> = quotient.iter().map(|v| (v * 100.0).round() / 100.0).collect();
                assert!(is_quotient(&time, &x, &rounded, &v));
            }
            // The slope itself, with noise of its own or without, is none.
            assert!(!is_quotient(&time, &x, &v, &v));
            let noisy: Vec<f64> = v.iter().zip(0..).map(|(v, i)| v + 0.3 * f64::from(7 * i).sin()).collect();
            assert!(!is_quotient(&time, &x, &noisy, &v));
        }
    }
}
