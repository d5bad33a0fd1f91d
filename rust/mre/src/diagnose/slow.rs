//! p-values of effects that are as slow as slow noise.

use super::candidates::{joint, residuals};
use super::drift::{beside, chance_beside};
use super::least_squares::Data;
use super::null::Null;
use super::screen::Score;
use super::starts::calm;
use crate::assembly::Assembly;

/// A slow effect also has to exceed what the noise's spectrum extends to.
///
/// Where its score does and its residual does not, that may be the base: bent by a drift, it leaves what looks like
/// slow noise. The noise is then what the base leaves beside the effect.
pub(super) fn temper(
    scores: &mut [Score],
    null: &Null,
    assembly: &Assembly,
    data: Data,
    unit: &[f64],
    level: f64,
) {
    // Of all residuals, what unknown initial states explain is taken off.
    let left = residuals(assembly, data, &null.point.fitted);
    let mut slow = chance_beside(&left, &beside(&left, &calm(assembly, &left)));
    let strongest = scores.iter().filter(|s| s.effect.slow() && s.p_value < level && slow > s.p_value);
    if let Some(strongest) = strongest.max_by(|a, b| a.gain.total_cmp(&b.gain)) {
        let wider = joint(assembly, data, unit, strongest.effect, &strongest.start);
        slow = slow.min(chance_beside(&left, &residuals(&wider.assembly, data, &wider.fitted)));
    }
    for score in scores.iter_mut().filter(|s| s.effect.slow() && s.p_value < slow) {
        score.p_value = slow;
    }
}
