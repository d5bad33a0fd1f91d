//! Which cuts of a motion are worth their noise: slopes have more of it beside an end.

use std::ops::Range;

use super::cut;
use super::local::TERMS;
use super::window::Window;

/// Squares that a cut wins, over the variance of the noise, at least. Where an acceleration jumps, slopes win as much as they
/// lose at some 8 to 17 of them; ramps with round ends, that look alike in noise, lose at 30 and are not cut at 60.
const WON: f64 = 60.0;

/// Those after which a displacement in mm is worth being cut, in rising order; its noise has this `variance` in mm².
pub(super) fn worth(mut after: Vec<usize>, [time, displacement]: [&[f64]; 2], variance: f64) -> Vec<usize> {
    let part = |range: Range<usize>| {
        let cost = cost([&time[range.clone()], &displacement[range.clone()]], variance);
        Part { range, cost }
    };
    let joined = |pair: &[Part]| part(pair[0].range.start..pair[1].range.end);
    let mut parts: Vec<Part> = cut(&after, time.len()).map(part).collect();
    let mut joint: Vec<Part> = parts.windows(2).map(joined).collect();
    loop {
        let won = (0..after.len()).map(|k| (k, joint[k].cost - parts[k].cost - parts[k + 1].cost));
        let Some((k, _)) = won.min_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, won)| *won < WON * variance)
        else {
            return after;
        };
        after.remove(k);
        parts.remove(k + 1);
        parts[k] = joint.remove(k);
        for beside in k.saturating_sub(1)..(k + 1).min(joint.len()) {
            joint[beside] = joined(&parts[beside..beside + 2]);
        }
    }
}

/// Of a motion.
struct Part {
    range: Range<usize>,
    cost: f64,
}

/// Squares that the best window leaves of a part, and twice what it follows of the noise (Mallows 1973).
fn cost([time, displacement]: [&[f64]; 2], variance: f64) -> f64 {
    let chosen = || Window::knowing(variance, time, displacement, &[TERMS]);
    Window::of_few(time.len()).unwrap_or_else(chosen).cost(variance, time, displacement)
}

#[cfg(test)]
mod tests {
    use super::worth;

    const RATE: f64 = 120.0;
    /// Standard deviation of the noise in mm, white and even.
    const NOISE: f64 = 0.001;

    fn noisy(motion: impl Fn(f64) -> f64) -> [Vec<f64>; 2] {
        let time: Vec<f64> = (0..600).map(|i| f64::from(i) / RATE).collect();
        let noise = |i: usize| {
            let x = ((i * i) as f64 * 0.618 + 0.3 * i as f64).sin() * 43_758.545;
            12.0_f64.sqrt() * NOISE * (x - x.floor() - 0.5)
        };
        let x = time.iter().enumerate().map(|(i, t)| motion(*t) + noise(i)).collect();
        [time, x]
    }

    fn worthy(after: &[usize], motion: impl Fn(f64) -> f64) -> Vec<usize> {
        let [time, x] = noisy(motion);
        worth(after.to_vec(), [&time, &x], NOISE.powi(2))
    }

    #[test]
    fn a_quick_release_is_worth_a_cut_and_other_places_are_not() {
        let released = |t: f64| if t < 2.0 { 5.0 } else { 5.0 * (9.0 * (t - 2.0)).cos() };
        assert_eq!(worthy(&[100, 240, 400, 500], released), [240]);
    }

    #[test]
    fn ramps_with_round_ends_are_not_cut_in_noise() {
        let turn = std::f64::consts::TAU;
        let ramp = |t: f64| {
            let s = ((t - 2.0) / 0.5).clamp(0.0, 1.0);
            4.0 * (s - (turn * s).sin() / turn)
        };
        for aside in [0, 2, 4] {
            assert_eq!(worthy(&[240 + aside, 300 - aside], ramp), [], "{aside} samples aside");
        }
    }
}
