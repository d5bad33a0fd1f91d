//! What the recordings cannot show: effects whose trace, at a stated size, would stay below the threshold of
//! detection, because the parameters of the base bend to hide it or the noise covers it.

use super::distribution::chi_square_tail;
use super::screen::{Score, Trace};
use super::search::Named;
use crate::assembly::Campaign;
use crate::effect::starts_in_motion;
use crate::recording::mean;

/// Share of the force's rms that an effect is imagined to carry.
pub(super) const SHARE: f64 = 0.05;
/// Squared standard deviations in shares of the threshold below which an effect is absorbed whatever its size: half of the
/// force would be hidden, and more is no small change any more.
const NOTHING: f64 = 1e-2;

/// A parameter of a law with its value: name, value, unit.
pub type Quantity = (String, f64, &'static str);

/// An effect that the recordings would hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Absorbed {
    /// Id of the effect.
    pub effect: &'static str,
    /// Its law.
    pub law: &'static str,
    /// Up to this size it has less than an even chance of being detected.
    pub up_to: Quantity,
    /// The other parameters of the law there: those at which it is most visible.
    pub with: Vec<Quantity>,
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
    // What such a recording shows of a run-in is not known.
    let steady = campaign.recordings().iter().all(|r| starts_in_motion(r));
    let hidden = |laws: &[Score]| {
        let seen = |s: &Score| {
            let tests = effects as f64 * laws.len() as f64 * s.tests;
            s.trace.left * size * size / quantile(false_alarm / tests, s.freedom.min(3))
        };
        // That a bent law would be seen does not say that the plain one would.
        let plain = laws.first().map(|s| (s, seen(s)))?;
        let others = laws.iter().filter(|s| steady && s.effect.is_of_steady_motion());
        let all = std::iter::once(plain).chain(others.map(|s| (s, seen(s))));
        let (law, chance) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        (chance < 1.0).then(|| absorbed_as(law, campaign, size, chance))
    };
    scores.chunk_by(|a, b| a.effect.about().effect == b.effect.about().effect).filter_map(hidden).collect()
}

/// An effect that is hidden, where a force of rms `size` has `chance` in squared standard deviations of the threshold.
fn absorbed_as(law: &Score, campaign: &Campaign, size: f64, chance: f64) -> Absorbed {
    let about = law.effect.about();
    let Trace { of_a_unit, shape, .. } = &law.trace;
    let shapes = law.effect.shape(campaign.sizes()).into_iter().zip(shape);
    let mut values = shapes.map(|(p, value)| (p.name, *value, p.unit));
    let at_share = if *of_a_unit > 0.0 { size / of_a_unit } else { 0.0 };
    let whatever_its_size = chance < NOTHING;
    let size = if whatever_its_size { at_share } else { at_share / chance.sqrt() };
    let coefficient = law.effect.coefficients().into_iter().next().map(|p| (p.name, p.unit));
    let first = coefficient.or_else(|| values.next().map(|(name, _, unit)| (name, unit)));
    let (name, unit) = first.unwrap_or_default();
    Absorbed {
        effect: about.effect,
        law: about.law,
        up_to: (name, size, unit),
        with: values.collect(),
        whatever_its_size,
    }
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
