//! A mismatch that nothing in the catalogue explains: what it depends on, and its shape as a map.

use nalgebra::{DMatrix, DVector};

use super::features::On;
use super::null::Null;
use super::projection::Projection;
use super::verdict::BEYOND_CHANCE;
use crate::effect::Scene;

/// Stretches of the displacement in the map.
const ACROSS: usize = 12;
/// Stretches of the velocity.
const UP: usize = 4;
/// Things named at most.
const MOST: usize = 4;
/// A thing is named if it carries this share of what the strongest does.
const WORTH_NAMING: f64 = 0.5;
/// Keeps stretches that the recordings hardly visit near zero: a share of what a typical one weighs.
const RIDGE: f64 = 1e-2;

/// What the mismatch depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dependence {
    /// The thing.
    pub on: On,
    /// Share of what all features, a wave in time, or what comes and goes, take off that this thing alone does.
    pub share: f64,
}

/// The mismatch as a force over displacement and velocity.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// mm.
    pub displacement: Vec<f64>,
    /// mm/s.
    pub velocity: Vec<f64>,
    /// N, row by row of the velocity; `None` where the recordings have not been.
    pub force: Vec<Vec<Option<f64>>>,
}

/// An unexplained mismatch.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// The strongest first.
    pub depends_on: Vec<Dependence>,
    /// Its shape over displacement and velocity.
    pub map: Map,
    /// Share of the map's square that is odd: changes sign with the motion.
    pub odd: f64,
    /// Correlation of the map's force with the velocity: near one it dissipates, near zero it stores.
    pub dissipative: f64,
    /// Rms of the map's force over the recordings, N.
    pub rms: f64,
    /// Chance under the null that the size of what is left follows motion and time as much; `None` where that cannot be
    /// told.
    pub p_even: Option<f64>,
}

/// Describe what is left beside a fitted model.
pub(super) fn describe(null: &Null) -> Unknown {
    let generic = null.generic();
    let oscillating = null.oscillating().filter(|found| found.mismatch.p_value < BEYOND_CHANCE);
    let of_waves = oscillating.map_or(0.0, |found| found.mismatch.excess());
    // What oscillates comes and goes too.
    let in_step = null.in_step();
    let passes = oscillating.is_none()
        && in_step.p_value < BEYOND_CHANCE
        && in_step.excess() > generic.mismatch().excess();
    let of_moments = if passes { in_step.excess() } else { 0.0 };
    let all = generic.mismatch().excess().max(of_waves).max(of_moments).max(f64::MIN_POSITIVE);
    let share = |excess: f64| (excess / all).min(1.0);
    let mut depends_on: Vec<Dependence> = generic
        .things()
        .into_iter()
        .map(|on| Dependence { on, share: share(generic.of(|other| other == on).excess()) })
        .collect();
    depends_on.extend(
        oscillating.map(|found| Dependence { on: On::Oscillation(found.frequency), share: share(of_waves) }),
    );
    depends_on.extend(passes.then_some(Dependence { on: On::Moments, share: share(of_moments) }));
    depends_on.sort_by(|a, b| b.share.total_cmp(&a.share));
    let strongest = depends_on.first().map_or(0.0, |d| d.share);
    depends_on.retain(|d| d.share > 0.0 && d.share >= WORTH_NAMING * strongest);
    depends_on.truncate(MOST);
    let (map, odd, dissipative, rms) = surface(null);
    Unknown { depends_on, map, odd, dissipative, rms, p_even: null.uneven().map(|u| u.p_value) }
}

/// Hats on a grid of displacement and velocity that bear on a state, with their values.
fn hats(scene: &Scene, i: usize) -> [(usize, f64); 4] {
    let sizes = scene.sizes;
    let place = |value: f64, size: f64, count: usize| {
        let at = ((value / size).clamp(-1.0, 1.0) + 1.0) * 0.5 * count as f64;
        let k = (at as usize).min(count - 1);
        (k, at - k as f64)
    };
    let (k, a) = place(scene.displacement[i], sizes.displacement, ACROSS);
    let (m, b) = place(scene.velocity[i], sizes.velocity, UP);
    let at = |k: usize, m: usize| m * (ACROSS + 1) + k;
    [
        (at(k, m), (1.0 - a) * (1.0 - b)),
        (at(k + 1, m), a * (1.0 - b)),
        (at(k, m + 1), (1.0 - a) * b),
        (at(k + 1, m + 1), a * b),
    ]
}

/// The map, the share of it that is odd, its correlation with the velocity, and its rms in N.
fn surface(null: &Null) -> (Map, f64, f64, f64) {
    let count = (ACROSS + 1) * (UP + 1);
    let recordings = null.assembly().campaign().recordings().len();
    let mut visits = vec![0.0; count];
    let Projection { gram, right, .. } = null.project_as_they_are(count, |view, r| {
        let scene = view.scene(r);
        let mut columns: Vec<(usize, Vec<f64>)> = (0..count).map(|k| (k, vec![0.0; scene.len()])).collect();
        for i in 0..scene.len() {
            for (k, value) in hats(&scene, i) {
                columns[k].1[i] += value;
                visits[k] += value;
            }
        }
        columns.retain(|(_, column)| column.iter().any(|v| *v != 0.0));
        columns
    });
    let typical = gram.diagonal().iter().sum::<f64>() / count as f64;
    let ridged =
        DMatrix::from_fn(count, count, |i, j| gram[(i, j)] + if i == j { RIDGE * typical } else { 0.0 });
    let values = ridged.cholesky().map_or_else(|| DVector::zeros(count), |factor| factor.solve(&right));
    let (mut even, mut total) = (0.0, 0.0);
    for k in 0..count {
        let mirrored = values[count - 1 - k];
        let weight = visits[k].min(visits[count - 1 - k]);
        even += weight * (0.5 * (values[k] + mirrored)).powi(2);
        total += weight * values[k].powi(2);
    }
    let (mut square, mut power, mut speed, mut samples) = (0.0, 0.0, 0.0, 0.0);
    for r in 0..recordings {
        let scene = null.scene(r);
        for i in 0..scene.len() {
            let force: f64 = hats(&scene, i).iter().map(|(k, value)| value * values[*k]).sum();
            square += force * force;
            power += force * scene.velocity[i];
            speed += scene.velocity[i].powi(2);
            samples += 1.0;
        }
    }
    let sizes = null.assembly().campaign().sizes();
    let grid = |size: f64, count: usize| {
        (0..=count).map(|k| size * (2.0 * k as f64 / count as f64 - 1.0)).collect::<Vec<f64>>()
    };
    let force = (0..=UP)
        .map(|m| {
            let row = m * (ACROSS + 1)..(m + 1) * (ACROSS + 1);
            row.map(|k| (visits[k] > 1.0).then_some(values[k])).collect()
        })
        .collect();
    let map =
        Map { displacement: grid(sizes.displacement, ACROSS), velocity: grid(sizes.velocity, UP), force };
    let odd = if total > 0.0 { 1.0 - (even / total).min(1.0) } else { 1.0 };
    let dissipative = if square > 0.0 && speed > 0.0 { power / (square * speed).sqrt() } else { 0.0 };
    (map, odd, dissipative, (square / samples).sqrt())
}
