//! p-values of effects that are as slow as slow noise.

use super::candidates::{joint, residuals};
use super::drift::{chance, chance_beside};
use super::least_squares::Data;
use super::null::Null;
use super::screen::Score;
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
    let left = null.residuals();
    let mut slow = chance(&left);
    let strongest = scores.iter().filter(|s| s.effect.slow() && s.p_value < level && slow > s.p_value);
    if let Some(strongest) = strongest.max_by(|a, b| a.gain.total_cmp(&b.gain)) {
        let beside = joint(assembly, data, unit, strongest.effect, &strongest.start);
        slow = slow.min(chance_beside(&left, &residuals(&beside.assembly, data, &beside.fitted)));
    }
    for score in scores.iter_mut().filter(|s| s.effect.slow() && s.p_value < slow) {
        score.p_value = slow;
    }
}
