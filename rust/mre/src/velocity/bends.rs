//! Bends of a motion: its acceleration jumps there, as at a quick release, and polynomials across swing on both sides.

use super::cuts::worth;
use super::kinks::{MORE_TERMS, Windows};
use super::local::NARROWEST;

/// Half windows over which a bend is looked for: over more it stands out of the noise further, and a motion needs more terms.
const REACHES: [f64; 2] = [1.5, 3.0];
/// Samples of the shortest part between bends.
const SHORTEST: usize = 2 * NARROWEST + 1;

/// Where a motion is to be cut.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Bends {
    /// Samples after which it bends, in rising order.
    pub(super) after: Vec<usize>,
    /// True where its slope jumps at one, and not its acceleration alone.
    pub(super) sharp: bool,
    /// Samples after which it bends too little to be cut.
    pub(super) slight: Vec<usize>,
}

/// The bends of a displacement in mm, on an even grid and with noise of this `variance` in mm² that is told over `half` samples
/// on either side.
pub(super) fn bends(time: &[f64], displacement: &[f64], variance: f64, half: usize) -> Bends {
    if variance <= 0.0 {
        return Bends::default();
    }
    let mut found: Vec<(usize, bool)> = Vec::new();
    for times in REACHES {
        let reach = ((times * half as f64).ceil() as usize).max(MORE_TERMS);
        if displacement.len() > 2 * reach + 1 {
            let windows = Windows::new(displacement, variance, reach);
            let more = windows.peaks().into_iter().map(|i| windows.cut(i));
            let apart = |(i, _): &(usize, bool)| found.iter().all(|(known, _)| known.abs_diff(*i) > reach);
            let more: Vec<(usize, bool)> = more.filter(apart).collect();
            found.extend(more);
        }
    }
    found.sort_unstable();
    let mut start = 0;
    let long_enough = |(after, _): &(usize, bool)| {
        let long = after + 1 >= start + SHORTEST && after + 1 + SHORTEST <= displacement.len();
        if long {
            start = after + 1;
        }
        long
    };
    found.retain(long_enough);
    let after = worth(found.iter().map(|(i, _)| *i).collect(), [time, displacement], variance);
    let (cut, slight): (Vec<(usize, bool)>, Vec<_>) = found.into_iter().partition(|(i, _)| after.contains(i));
    let slight = slight.into_iter().map(|(i, _)| i).collect();
    Bends { sharp: cut.iter().any(|(_, sharp)| *sharp), after, slight }
}

#[cfg(test)]
mod tests {
    use super::super::from_displacement;

    const RATE: f64 = 200.0;
    const SAMPLES: usize = 1500;
    /// Of the release.
    const AT: f64 = 2.5;

    fn time() -> Vec<f64> {
        (0..SAMPLES).map(|i| i as f64 / RATE).collect()
    }

    /// 5 mm held, and let go to ring at a frequency in Hz.
    fn released(frequency: f64, t: f64) -> [f64; 2] {
        let (turn, decay) = (std::f64::consts::TAU * frequency, 0.6);
        let s = t - AT;
        if s < 0.0 {
            return [5.0, 0.0];
        }
        let size = 5.0 * (-decay * s).exp();
        let slope = -size * (turn + decay * decay / turn) * (turn * s).sin();
        [size * ((turn * s).cos() + decay / turn * (turn * s).sin()), slope]
    }

    fn noise(i: usize, size: f64) -> f64 {
        let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
        12.0_f64.sqrt() * size * (x - x.floor() - 0.5)
    }

    #[test]
    fn a_quick_release_is_a_bend_and_the_velocity_beside_it_is_as_good_as_elsewhere() {
        let time = time();
        for (frequency, size) in [(1.0, 0.001), (1.0, 0.005), (2.0, 0.002), (2.0, 0.01)] {
            let x: Vec<f64> =
                time.iter().enumerate().map(|(i, t)| released(frequency, *t)[0] + noise(i, size)).collect();
            let derived = from_displacement(&time, &x);
            let release = (AT * RATE) as usize;
            let inner = &derived.corners[1..derived.corners.len() - 1];
            assert!(matches!(inner, [one] if one.contains(&release)), "{frequency} {size}: {inner:?}");
            let error = |i: usize| derived.velocity[i] - released(frequency, time[i])[1];
            let kept = |i: &usize| !derived.corners.iter().any(|range| range.contains(i));
            let rms = |near: std::ops::Range<usize>| {
                let errors: Vec<f64> = near.filter(kept).map(error).collect();
                (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
            };
            let (beside, elsewhere) = (rms(release - 30..release + 30), rms(0..SAMPLES));
            assert!(beside < 2.5 * elsewhere, "{frequency} {size}: {beside} beside {elsewhere}");
        }
    }

    #[test]
    fn where_an_exact_triangle_is_rounded_the_velocity_is_not_missed() {
        // The mean over 60 ms of a triangle of 5 mm at 0.5 Hz, and its slope.
        let integral = |t: f64| {
            let s = (t + 0.5).rem_euclid(2.0);
            if s < 1.0 { 5.0 * (s * s - s) } else { 5.0 * (3.0 * s - s * s - 2.0) }
        };
        let triangle = |t: f64| 5.0 - 10.0 * ((t + 0.5).rem_euclid(2.0) - 1.0).abs();
        let time = time();
        let x: Vec<f64> = time.iter().map(|t| (integral(t + 0.03) - integral(t - 0.03)) / 0.06).collect();
        let derived = from_displacement(&time, &x);
        // The last corner is cut off.
        for (i, t) in time.iter().enumerate().take(SAMPLES - 20) {
            let wanted = (triangle(t + 0.03) - triangle(t - 0.03)) / 0.06;
            let known = derived.corners.iter().any(|range| range.contains(&i));
            assert!(known || (derived.velocity[i] - wanted).abs() < 0.02, "{i}: {}", derived.velocity[i]);
        }
        let left_out: usize = derived.corners.iter().map(ExactSizeIterator::len).sum();
        assert!(5 * left_out < SAMPLES, "{left_out} of {SAMPLES} samples");
    }

    #[test]
    fn noise_alone_a_swell_and_a_burst_have_none() {
        let time = time();
        let turn = std::f64::consts::TAU;
        let motions: [&dyn Fn(f64) -> f64; 3] =
            [&|_| 0.0, &|t| 5.0 * (0.5 * turn * t / 7.5).sin().powi(2) * (2.0 * turn * t).sin(), &|t| {
                5.0 * (3.0 * turn * t).sin() * (-4.0 * (t - 3.0).powi(2)).exp()
            }];
        for (k, motion) in motions.iter().enumerate() {
            for size in [0.002, 0.02] {
                let x: Vec<f64> = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i, size)).collect();
                assert_eq!(from_displacement(&time, &x).corners, [], "motion {k} with noise of {size}");
            }
        }
    }

    #[test]
    fn beside_a_bend_that_is_not_worth_a_cut_the_slope_is_not_trusted() {
        let time = time();
        // From 2.5 s on pushed at once, and soon less.
        let pushed = |t: f64| 10.0 * t.powi(2) * (-8.0 * t).exp();
        let motion = |t: f64| 3.0 * (2.0 * t).sin() + pushed((t - AT).max(0.0));
        let x: Vec<f64> = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i, 0.004)).collect();
        let derived = from_displacement(&time, &x);
        assert_eq!(derived.corners, []);
        let doubted = derived.unresolved(&time, &x);
        let at = (AT * RATE) as usize;
        assert!(matches!(&doubted[..], [one] if one.contains(&at) && one.len() < 150), "{doubted:?}");
    }
}
