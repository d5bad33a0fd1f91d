//! Where the mismatch is: local columns (a moment, a stretch of the displacement, a recording, a harmonic of
//! the drive) scored beside the base model; the strongest first.

use rayon::prelude::*;

use super::distribution::chi_square_tail;
use super::lasting::lasting;
use super::null::Null;
use super::projection::Projection;
use crate::effect::Scene;

/// Moments of each recording at which the stiffness may change.
pub(super) const MOMENTS: usize = 40;
/// Stretches of the displacement, each a hat that spans two of them.
const STRETCHES: usize = 20;
/// Highest harmonic of the drive.
const HARMONICS: usize = 7;
/// A moment explains so many times as much as its whole recording.
pub(super) const CLEARLY: f64 = 1.3;
/// Entries at most.
pub(super) const MOST: usize = 12;
/// Share of a column's square that the base model has to leave.
pub(super) const SMALLEST_SHARE: f64 = 1e-6;

/// What a place is a place in.
#[derive(Debug, Clone, PartialEq)]
pub enum Place {
    /// Around a moment of a recording, s.
    Time {
        /// Place of the recording in the campaign.
        recording: usize,
        /// s.
        from: f64,
        /// s.
        to: f64,
    },
    /// In a stretch of the displacement.
    State {
        /// mm.
        x: [f64; 2],
        /// mm/s.
        v: [f64; 2],
    },
    /// At a harmonic of the drive of a recording.
    Harmonic {
        /// Place of the recording in the campaign.
        recording: usize,
        /// Multiple of the drive's frequency.
        harmonic: usize,
        /// Frequency of the drive, Hz.
        drive: f64,
        /// Share of the amplitude that is in phase with the displacement, -1 to 1.
        in_phase: f64,
    },
    /// In one recording against the others.
    Recording {
        /// Place of the recording in the campaign.
        recording: usize,
        /// True for damping, false for stiffness.
        damping: bool,
    },
}

/// A place with its strength.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Where.
    pub place: Place,
    /// Square root of the squared standard deviations that the place explains.
    pub strength: f64,
}

/// Places whose strength no noise would reach at a false-alarm rate over all of them, strongest first.
pub(super) fn locate(null: &Null, false_alarm: f64) -> Vec<Finding> {
    let recordings = null.assembly().campaign().recordings().len();
    let mut found: Vec<Vec<Finding>> =
        (0..recordings).into_par_iter().map(|r| in_recording(null, r)).collect();
    found.push(in_state(null));
    found.push(lasting(null));
    let all: Vec<Finding> = found.into_iter().flatten().collect();
    let tests = all.len() as f64;
    let mut significant: Vec<Finding> = all
        .into_iter()
        .filter(|f| chi_square_tail(f.strength * f.strength, 2) * tests <= false_alarm)
        .collect();
    significant.sort_by(|a, b| b.strength.total_cmp(&a.strength));
    let mut kept: Vec<Finding> = Vec::new();
    for finding in significant {
        if kept.len() < MOST && !kept.iter().any(|k| overlap(&k.place, &finding.place)) {
            kept.push(finding);
        }
    }
    kept
}

/// True where two places are about one.
pub(super) fn overlap(a: &Place, b: &Place) -> bool {
    match (a, b) {
        (Place::Time { recording: r, from, to }, Place::Time { recording: s, from: start, to: end }) => {
            r == s && from < end && start < to
        }
        (Place::State { x, v }, Place::State { x: y, v: w }) => {
            x[0] < y[1] && y[0] < x[1] && v[0] < w[1] && w[0] < v[1]
        }
        _ => a == b,
    }
}

/// Strength of single columns on one recording.
pub(super) fn strengths(
    null: &Null,
    (r, count): (usize, usize),
    columns: &dyn Fn(&Scene) -> Vec<Vec<f64>>,
) -> Vec<f64> {
    let projected = null.project(count, |view, s| {
        if s == r { columns(&view.scene(r)).into_iter().enumerate().collect() } else { Vec::new() }
    });
    (0..count)
        .map(|i| {
            let left = projected.gram[(i, i)];
            if left > SMALLEST_SHARE * projected.squares[i] { projected.strength(i) } else { 0.0 }
        })
        .collect()
}

fn in_recording(null: &Null, r: usize) -> Vec<Finding> {
    let scene = null.scene(r);
    let (time, n) = (scene.time, scene.len());
    let width = scene.duration() / MOMENTS as f64;
    let drive = drive(&scene);
    let columns = |scene: &Scene| {
        let from = |k: usize| {
            let start = n * k / MOMENTS;
            (0..n).map(|i| if i >= start { scene.force[i] } else { 0.0 }).collect()
        };
        let mut columns: Vec<Vec<f64>> = (1..MOMENTS).map(from).collect();
        columns.push(scene.force.to_vec());
        columns.push(scene.velocity.to_vec());
        for h in drive.iter().flat_map(|drive| (1..=HARMONICS).map(move |h| drive * h as f64)) {
            let phase = |t: &f64| std::f64::consts::TAU * h * t;
            columns.push(time.iter().map(|t| phase(t).sin()).collect());
            columns.push(time.iter().map(|t| phase(t).cos()).collect());
        }
        columns
    };
    let count = MOMENTS + 1 + drive.map_or(0, |_| 2 * HARMONICS);
    let scores = strengths(null, (r, count), &columns);
    // A change at a moment says more than the whole recording only where it explains clearly more.
    let whole = scores[MOMENTS - 1].powi(2);
    let mut found: Vec<Finding> = (1..MOMENTS)
        .filter(|k| scores[k - 1].powi(2) > CLEARLY * whole)
        .map(|k| {
            let at = time[n * k / MOMENTS];
            let place = Place::Time { recording: r, from: at - width, to: at + width };
            Finding { place, strength: scores[k - 1].abs() }
        })
        .collect();
    if null.assembly().campaign().recordings().len() > 1 {
        for (k, damping) in [(0, false), (1, true)] {
            let strength = scores[MOMENTS - 1 + k].abs();
            found.push(Finding { place: Place::Recording { recording: r, damping }, strength });
        }
    }
    if let Some(drive) = drive {
        for h in 1..=HARMONICS {
            let first = MOMENTS + 1 + 2 * (h - 1);
            let strength = scores[first].hypot(scores[first + 1]);
            let in_phase = if strength > 0.0 {
                phase_share(&scene, drive * h as f64, scores[first], scores[first + 1])
            } else {
                0.0
            };
            found.push(Finding {
                place: Place::Harmonic { recording: r, harmonic: h, drive, in_phase },
                strength,
            });
        }
    }
    found
}

/// Cosine of the phase between a harmonic and the displacement's own at that frequency.
fn phase_share(scene: &Scene, frequency: f64, sine: f64, cosine: f64) -> f64 {
    let (s, c) = fourier(scene.time, scene.displacement, frequency);
    let size = s.hypot(c) * sine.hypot(cosine);
    if size > 0.0 { (s * sine + c * cosine) / size } else { 0.0 }
}

fn fourier(time: &[f64], series: &[f64], frequency: f64) -> (f64, f64) {
    time.iter().zip(series).fold((0.0, 0.0), |(s, c), (t, x)| {
        let (sin, cos) = (std::f64::consts::TAU * frequency * t).sin_cos();
        (s + x * sin, c + x * cos)
    })
}

/// Frequency of a sinusoidal drive, Hz; `None` where the motion is no sine.
pub(super) fn drive(scene: &Scene) -> Option<f64> {
    let (time, x) = (scene.time, scene.displacement);
    let crossings: Vec<f64> = (1..x.len())
        .filter(|i| x[i - 1] <= 0.0 && x[*i] > 0.0)
        .map(|i| time[i - 1] - x[i - 1] * (time[i] - time[i - 1]) / (x[i] - x[i - 1]))
        .collect();
    if crossings.len() < 4 {
        return None;
    }
    let mut periods: Vec<f64> = crossings.windows(2).map(|p| p[1] - p[0]).collect();
    periods.sort_by(f64::total_cmp);
    let typical = periods[periods.len() / 2];
    let near = periods.iter().filter(|p| (*p - typical).abs() < 0.05 * typical).count();
    (near as f64 >= 0.8 * periods.len() as f64).then(|| 1.0 / typical)
}

fn in_state(null: &Null) -> Vec<Finding> {
    let sizes = null.assembly().campaign().sizes();
    let (far, fast) = (sizes.displacement, sizes.velocity);
    let step = 2.0 * far / STRETCHES as f64;
    // The middle is zero to the last bit.
    let centre = |k: usize| far * (2.0 * k as f64 / STRETCHES as f64 - 1.0);
    // Every hat in each band of velocities.
    let bands = [[-fast, fast], [0.0, fast], [-fast, 0.0], [-fast, -0.5 * fast], [0.5 * fast, fast]];
    let count = bands.len() * (STRETCHES + 1);
    let projected = null.project_as_they_are(count, |view, r| {
        let scene = view.scene(r);
        (0..count)
            .map(|place| {
                let (k, [low, high]) = (place / bands.len(), bands[place % bands.len()]);
                // What is faster than anything fitted belongs to the outer bands; what rests, to both ways.
                let moves = |v: f64| match (low < 0.0, high > 0.0) {
                    (true, true) => true,
                    (true, false) => v < 0.0 && v <= high,
                    _ => v > 0.0 && v >= low,
                };
                let column = (0..scene.len()).map(|i| {
                    let hat = 1.0 - (scene.displacement[i] - centre(k)).abs() / step;
                    if moves(scene.velocity[i]) { hat.max(0.0) } else { 0.0 }
                });
                (place, column.collect())
            })
            .collect()
    });
    let Projection { gram, squares, .. } = &projected;
    (0..count)
        .filter(|i| gram[(*i, *i)] > SMALLEST_SHARE * squares[*i] && squares[*i] > 0.0)
        .map(|i| {
            let (k, v) = (i / bands.len(), bands[i % bands.len()]);
            let x = [centre(k.saturating_sub(1)), centre((k + 1).min(STRETCHES))];
            Finding {
                place: Place::State { x, v },
                strength: projected.counted(i).abs() / gram[(i, i)].sqrt(),
            }
        })
        .collect()
}
