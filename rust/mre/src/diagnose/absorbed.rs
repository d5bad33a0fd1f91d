//! What the recordings cannot show: effects whose trace, at a stated size, would stay below the threshold of
//! detection, because the parameters of the base bend to hide it or the noise covers it.

use super::distribution::chi_square_tail;
use super::screen::Score;
use super::search::Named;
use crate::assembly::Campaign;
use crate::recording::mean;

/// Share of the force's rms that an effect is imagined to carry.
pub(super) const SHARE: f64 = 0.05;

/// An effect that the recordings would hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Absorbed {
    /// Id of the effect.
    pub effect: &'static str,
    /// Name and unit of the parameter that its size is given in.
    pub parameter: (String, &'static str),
    /// Up to this size it has less than an even chance of being detected.
    pub up_to: f64,
    /// True where the model absorbs it whatever its size; `up_to` is then the size at which it carries
    /// a twentieth of the force's rms.
    pub whatever_its_size: bool,
}

/// Effects with less than an even chance of detection even when they carry a twentieth of the force's rms.
pub(super) fn absorbed(named: &Named, campaign: &Campaign, false_alarm: f64) -> Vec<Absorbed> {
    hidden_among(&named.scores, ids_of(&named.scores).len(), campaign, false_alarm)
}

/// Ids of the effects of some scores, each once.
pub(super) fn ids_of(scores: &[Score]) -> Vec<&'static str> {
    let mut ids: Vec<&'static str> = scores.iter().map(|s| s.effect.about().effect).collect();
    ids.dedup();
    ids
}

/// The same among the effects of some scores, where so many effects are tested in all.
pub(super) fn hidden_among(
    scores: &[Score],
    effects: usize,
    campaign: &Campaign,
    false_alarm: f64,
) -> Vec<Absorbed> {
    let squares: Vec<f64> = campaign
        .recordings()
        .iter()
        .flat_map(|r| r.force().unwrap_or_default().iter().map(|f| f * f))
        .collect();
    let size = SHARE * mean(&squares).sqrt();
    ids_of(scores)
        .into_iter()
        .filter_map(|id| {
            let laws: Vec<&Score> = scores.iter().filter(|s| s.effect.about().effect == id).collect();
            let seen = |s: &Score| {
                let tests = effects as f64 * laws.len() as f64 * s.tests;
                let threshold = quantile(false_alarm / tests, s.freedom.min(3));
                s.trace.0 * size * size / threshold
            };
            let plain = laws.iter().filter(|s| !s.effect.plain_when_small());
            let best = plain.max_by(|a, b| seen(a).total_cmp(&seen(b)))?;
            let chance = seen(best);
            if chance >= 1.0 {
                return None;
            }
            let sizes = campaign.sizes();
            let parameter = best
                .effect
                .coefficients()
                .into_iter()
                .chain(best.effect.shape(sizes))
                .next()
                .map_or((String::new(), ""), |p| (p.name, p.unit));
            let at_share = if best.trace.1 > 0.0 { size / best.trace.1 } else { 0.0 };
            let whatever = chance < 1e-4;
            let up_to = if whatever { at_share } else { at_share / chance.sqrt() };
            Some(Absorbed { effect: id, parameter, up_to, whatever_its_size: whatever })
        })
        .collect()
}

/// The value that a chi-square variable exceeds with a given chance.
fn quantile(chance: f64, freedom: usize) -> f64 {
    let (mut low, mut high) = (0.0, 1e4);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if chi_square_tail(middle, freedom) > chance { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
