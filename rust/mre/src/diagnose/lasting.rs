//! Moments after which the whole campaign differs: a change in one recording that all later ones keep.

use nalgebra::DVector;

use super::locate::{CLEARLY, Finding, Place, SMALLEST_SHARE};
use super::null::Null;
use super::projection::{Projection, smaller};

/// Parts of a recording between which the stiffness may change for good.
const PARTS: usize = 20;
/// So many squared standard deviations more than a change between recordings tell a moment too, where the other
/// recordings show so much that their share in it is small.
const BEYOND: f64 = 50.0;
/// Recordings at most: the work grows with their square.
const MOST: usize = 60;

/// Strength of a change of the force at moments of each recording but the last, in the order of the recordings.
pub(super) fn lasting(null: &Null) -> Vec<Finding> {
    let recordings = null.assembly().campaign().recordings().len();
    if !(2..=MOST).contains(&recordings) {
        return Vec::new();
    }
    // Of each recording: the force from a moment on, the whole force first.
    let count = recordings * PARTS;
    let projected = null.project_as_they_are(count, |view, r| {
        let scene = view.scene(r);
        let n = scene.len();
        let from = |part: usize| {
            let start = n * part / PARTS;
            (0..n).map(|i| if i >= start { scene.force[i] } else { 0.0 }).collect()
        };
        (0..PARTS).map(|part| (r * PARTS + part, from(part))).collect()
    });
    let Projection { gram, right, tame, squares, .. } = projected;
    let squares = DVector::from(squares);
    let mut found = Vec::new();
    for r in 0..recordings - 1 {
        let mut later = DVector::<f64>::zeros(count);
        (r + 1..recordings).for_each(|s| later[s * PARTS] = 1.0);
        let (bent, shown) = (&gram * &later, later.dot(&squares));
        let strength = |i: Option<usize>| {
            let (cross, itself, square) = i.map_or((0.0, 0.0, 0.0), |i| (bent[i], gram[(i, i)], squares[i]));
            let left = itself + 2.0 * cross + later.dot(&bent);
            let score = |of: &DVector<f64>| later.dot(of) + i.map_or(0.0, |i| of[i]);
            let told = smaller(score(&right), score(&tame)) / left.sqrt();
            if left > SMALLEST_SHARE * (square + shown) { told } else { 0.0 }
        };
        // Between two recordings is another place.
        let between = strength(None).powi(2).max(strength(Some(r * PARTS)).powi(2));
        let scene = null.scene(r);
        let width = scene.duration() / PARTS as f64;
        for part in 1..PARTS {
            let own = strength(Some(r * PARTS + part));
            if own * own > (CLEARLY * between).min(between + BEYOND) {
                let at = scene.time[scene.len() * part / PARTS];
                let (first, last) = (scene.time[0], scene.time[scene.len() - 1]);
                let (from, to) = ((at - width).max(first), (at + width).min(last));
                let place = Place::Time { recording: r, from, to };
                found.push(Finding { place, strength: own.abs() });
            }
        }
    }
    found
}
