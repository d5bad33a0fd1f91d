//! Velocity halfway between the samples of a motion.

use super::interval::Interval;

/// The velocity halfway is off the straight line by at most this share of the larger speed: a cubic through
/// samples at uneven times knows no limits.
const MOST_BENT: f64 = 0.25;

/// Way of a velocity without corners from the first sample to every one, mm.
pub(crate) fn way(time: &[f64], velocity: &[f64]) -> Vec<f64> {
    let spans = time.windows(2).zip(velocity.windows(2)).zip(middles(time, velocity, &[]));
    let ways = spans.scan(0.0, |way, ((t, v), middle)| {
        *way += Interval::new([v[0], middle, v[1]], t[1] - t[0]).far();
        Some(*way)
    });
    std::iter::once(0.0).chain(ways).collect()
}

/// Velocity halfway between samples: the mean of the parabolas through the sample before and the one after, which at
/// even times is the cubic through all four; one parabola at the ends and beside jumps. Where it jumps between two samples,
/// the velocity there.
///
/// On the straight line between two samples, with 22 samples a cycle, the path would be 0.7 % short: more than
/// the noise of a good recording.
pub(crate) fn middles(time: &[f64], velocity: &[f64], jumps: &[(usize, f64)]) -> Vec<f64> {
    let Some(spans) = time.len().checked_sub(1) else { return Vec::new() };
    let slopes: Vec<f64> =
        time.windows(2).zip(velocity.windows(2)).map(|(t, v)| (v[1] - v[0]) / (t[1] - t[0])).collect();
    // Half the second derivative at a sample; at an end that of the next.
    let mut bends = vec![0.0; spans + 1];
    for ((bend, slope), t) in bends.iter_mut().skip(1).zip(slopes.windows(2)).zip(time.windows(3)) {
        *bend = (slope[1] - slope[0]) / (t[2] - t[0]);
    }
    for (i, _) in jumps {
        bends[*i..=i + 1].fill(f64::NAN);
    }
    if spans > 1 {
        (bends[0], bends[spans]) = (bends[1], bends[spans - 1]);
    }
    let bent = |ends: &[f64]| match [ends[0], ends[1]] {
        [a, b] if a.is_nan() && b.is_nan() => 0.0,
        [a, b] if a.is_nan() => b,
        [a, b] if b.is_nan() => a,
        [a, b] => 0.5 * (a + b),
    };
    let ends = time.windows(2).zip(velocity.windows(2)).zip(bends.windows(2));
    let middle = ends.map(|((t, v), bend)| {
        let h = t[1] - t[0];
        let most = MOST_BENT * v[0].abs().max(v[1].abs());
        // No clamp: it panics where a diverged motion is not a number.
        0.5 * (v[0] + v[1]) - (0.25 * h * h * bent(bend)).max(-most).min(most)
    });
    let mut middle: Vec<f64> = middle.collect();
    for (i, share) in jumps {
        middle[*i] = velocity[if *share < 0.5 { i + 1 } else { *i }];
    }
    middle
}
