//! What the recordings cannot show: effects whose trace, at a stated size, would stay below the threshold of
//! detection, because the parameters of the base bend to hide it or the noise covers it.

use super::distribution::chi_square_tail;
use super::screen::{Score, Trace};
use super::search::Named;
use crate::assembly::Campaign;
use crate::effect::MEAN;
use crate::recording::mean;
use crate::transient::is_steady;

/// Share of the force's rms that an effect is imagined to carry.
pub(super) const SHARE: f64 = 0.05;
/// Squared standard deviations in shares of the threshold below which an effect is absorbed whatever its size: half of the
/// force would be hidden, and more is no small change any more.
const NOTHING: f64 = 1e-2;

/// A range that begins at a larger share of its end is nowhere near zero.
const NEAR_ZERO: f64 = 0.2;
/// Stands for the size of a law that has none.
const RMS: &str = "rms";

/// A parameter of a law with its value: name, value, unit.
pub type Quantity = (String, f64, &'static str);

/// An effect that the recordings would hide.
#[derive(Debug, Clone, PartialEq)]
pub struct Absorbed {
    /// Id of the effect.
    pub effect: &'static str,
    /// Its law.
    pub law: &'static str,
    /// When that cannot be told from the base model or from other effects.
    pub limit: &'static str,
    /// Up to this size it has less than an even chance of being detected.
    pub up_to: Quantity,
    /// The other parameters of the law there: those at which it is most visible.
    pub with: Vec<Quantity>,
    /// True where half of the force, or the largest that the law may be, would be hidden; `up_to` is then the size at which
    /// it carries a twentieth of the force's rms.
    pub whatever_its_size: bool,
}

/// What a trace is compared with.
pub(super) struct Detection {
    /// Effects that are tested.
    effects: usize,
    false_alarm: f64,
    /// True where the recordings known so far are cut from steady motions: what they would show of a run-in is not known.
    steady: bool,
}

impl Detection {
    /// Of what was tested beside a model.
    pub(super) fn beside(named: &Named, false_alarm: f64) -> Self {
        let mut effects: Vec<&str> = named.scores.iter().map(|s| s.effect.about().effect).collect();
        effects.dedup();
        let steady = named.assembly.campaign().recordings().iter().all(|r| is_steady(r));
        Self { effects: effects.len(), false_alarm, steady }
    }

    /// Effects with less than an even chance of detection even when they carry a twentieth of the force's rms.
    pub(super) fn hidden(&self, scores: &[Score], campaign: &Campaign) -> Vec<Absorbed> {
        let recordings = campaign.recordings().iter();
        let squares: Vec<f64> =
            recordings.flat_map(|r| r.force().unwrap_or_default().iter().map(|f| f * f)).collect();
        let size = SHARE * mean(&squares).sqrt();
        scores
            .chunk_by(|a, b| a.effect.about().effect == b.effect.about().effect)
            .filter_map(|laws| {
                let seen = |law: &Score| {
                    let tests = self.effects as f64 * laws.len() as f64 * law.tests;
                    let threshold = quantile(self.false_alarm / tests, law.freedom.min(3));
                    law.trace.left * size * size / threshold
                };
                let decisive = laws.iter().filter(|law| self.decides(law, laws)).map(|law| (law, seen(law)));
                let (law, chance) = decisive.min_by(|a, b| a.1.total_cmp(&b.1))?;
                (chance < 1.0).then(|| absorbed_as(law, campaign, size, chance))
            })
            .collect()
    }

    /// That a bent law would be seen does not say that the plain one would. A zero that is off is part of the base; what does
    /// nothing to a simulation that is given is not tested at all.
    fn decides(&self, law: &Score, laws: &[Score]) -> bool {
        let is_offset = |law: &&Score| law.effect.slow() == Some(MEAN);
        let plainest = laws.iter().find(|law| !is_offset(law));
        law.trace.of_a_unit > 0.0
            && (plainest.is_some_and(|plain| std::ptr::eq(plain, law))
                || (self.steady && law.effect.is_of_steady_motion()))
    }
}

/// An effect that is hidden, where a force of rms `size` has `chance` in squared standard deviations of the threshold.
fn absorbed_as(law: &Score, campaign: &Campaign, size: f64, chance: f64) -> Absorbed {
    let about = law.effect.about();
    let Trace { of_a_unit, shape, coefficient, .. } = &law.trace;
    let mut shapes = law.effect.shape(campaign.sizes()).into_iter().zip(shape);
    let coefficient = law.effect.coefficients().into_iter().nth(*coefficient).map(|p| (p, f64::INFINITY));
    let sized = coefficient.or_else(|| shapes.next().map(|(p, _)| (p.clone(), p.upper)));
    // One that is nowhere near zero is no size of its effect.
    let sized = sized.filter(|(p, _)| p.lower <= NEAR_ZERO * p.upper);
    let (name, unit, rms, largest) =
        sized.map_or((RMS.to_owned(), "N", 1.0, f64::INFINITY), |(p, end)| (p.name, p.unit, *of_a_unit, end));
    let (at_share, up_to) = (size / rms, size / rms / chance.sqrt());
    let whatever_its_size = chance < NOTHING || up_to > largest;
    Absorbed {
        effect: about.effect,
        law: about.law,
        limit: about.limit,
        up_to: (name, if whatever_its_size { at_share } else { up_to }, unit),
        with: shapes.map(|(p, value)| (p.name, *value, p.unit)).collect(),
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
