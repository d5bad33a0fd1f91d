//! p-values of effects that are as slow as slow noise.

use super::candidates::residuals;
use super::drift::{beside, chance_beside};
use super::joint::joint;
use super::least_squares::Data;
use super::null::Null;
use super::screen::Score;
use super::starts::calm;
use crate::assembly::Assembly;
use crate::effect::{DRIFT, MEAN};

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
    let noise = beside(&left, &calm(assembly, &left));
    for waves in [MEAN, DRIFT] {
        let own = |s: &Score| s.effect.slow() == Some(waves.clone());
        let mut chance = chance_beside(&left, &noise, &waves);
        let strongest = scores.iter().filter(|s| own(s) && s.p_value < level && chance > s.p_value);
        if let Some(strongest) = strongest.max_by(|a, b| a.gain.total_cmp(&b.gain)) {
            let wider = joint(assembly, data, unit, strongest.effect, &strongest.start);
            let noise = residuals(&wider.assembly, data, &wider.fitted);
            chance = chance.min(chance_beside(&left, &noise, &waves));
        }
        for score in scores.iter_mut().filter(|s| own(s) && s.p_value < chance) {
            score.p_value = chance;
        }
    }
}
