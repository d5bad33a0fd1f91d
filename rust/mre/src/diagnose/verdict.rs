//! Verdict: what the tests beside the final model say.

use super::agreed::Agreed;
use super::candidates::by_effect;
use super::missing::Mismatch;
use super::refitted::Refitted;
use super::search::{Named, WAYS};
use super::uneven::Uneven;

/// Shares of the rest above which names are not trusted, for one effect and for several: effects that are not
/// there, bent towards one that is in no catalogue, leave more. Several bend further, and so have to fit better.
const TRUSTED: [f64; 2] = [0.3, 0.03];
/// A rest above these shares is more than an inexact form.
const FORM: [f64; 2] = [0.02, 0.0025];
/// So is a smaller one of a single effect that is plainly seen: above this share, and more than this share of the noise.
const SEEN: [f64; 2] = [0.005, 0.1];

/// Sizes of their own take off at least this share of what the effects explain: an inexact form has slightly another in
/// every recording too.
const APART: f64 = 0.1;

/// A rms error on held-out data that grows by so much is worse: by less it does in a slow noise by chance.
const WORSE: f64 = 1.001;

/// Tests of any mismatch.
const OF_ANY: f64 = 7.0;

/// Names are doubted only where the rest is beyond chance by far: a small one may be the noise's.
pub(super) const BEYOND_CHANCE: f64 = 1e-3;

/// The noise has swallowed a mismatch where its size follows the motion beyond chance by as far.
const PLAINLY_UNEVEN: f64 = 1e-6;

/// The verdicts of `diagnosis.json`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The base model explains the recordings down to their noise.
    Adequate,
    /// The effects named explain the mismatch.
    MissingPhysics,
    /// Effects were found, and a mismatch is left that nothing in the catalogue explains, or one of them fits only
    /// where its law ends, or they worsen the prediction of data that took no part.
    PartlyExplained,
    /// A mismatch, and nothing in the catalogue explains it.
    Unexplained,
}

impl Verdict {
    /// As in `diagnosis.json`.
    pub fn id(self) -> &'static str {
        match self {
            Self::Adequate => "adequate",
            Self::MissingPhysics => "missing_physics",
            Self::PartlyExplained => "partly_explained",
            Self::Unexplained => "unexplained",
        }
    }

    /// Where other parameters of the base that were kept leave no more, an effect is a hint.
    #[must_use]
    pub(super) fn beside_refitted(self, refitted: Option<Refitted>) -> Self {
        match self {
            Self::MissingPhysics if refitted.is_some_and(|r| r.as_well) => Self::PartlyExplained,
            told => told,
        }
    }

    /// The verdict, once it is known how the rms error on held-out data changes: effects that worsen the prediction of data
    /// that took no part may stand for another, however much of the mismatch they explain.
    pub(super) fn beside_proofs(self, before: f64, after: f64) -> Self {
        match self {
            Self::MissingPhysics if after > WORSE * before => Self::PartlyExplained,
            told => told,
        }
    }
}

/// What is left beside the final model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// Chance of the base model's mismatch under the null.
    pub p_base: f64,
    /// Chance of the final model's.
    pub p_rest: f64,
    /// Chance that the noise is of even size over the motion: no evidence of missing physics.
    pub p_even: f64,
    /// Stated chance of a false alarm.
    pub false_alarm: f64,
    /// Share of the rest in all that can be explained, in squared standard deviations.
    pub share: f64,
    /// What is left beyond chance, in squared standard deviations.
    pub left: f64,
    /// Rms in N of the force that the best further candidate would add.
    pub lack_of_fit: f64,
    /// Rms in N of the noise.
    pub noise: f64,
    /// True where the base plainly misses.
    pub plain: bool,
    /// True where what is left hides the noise.
    pub hidden: bool,
    /// What speaks against the effects named, whatever they leave.
    pub against: Against,
}

/// What speaks against the effects named, whatever they leave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// Nothing.
    Nothing,
    /// An effect fits only where its law ends.
    AtTheEnd,
    /// A smooth force that no effect has explains more.
    Surpassed,
}

/// What a judgement is made of.
pub(super) struct Tests {
    /// Mismatch of the base model.
    pub(super) first: Mismatch,
    /// Mismatch of the final model.
    pub(super) rest: Mismatch,
    /// Chance of the strongest smooth force that no effect has, beside the final model.
    pub(super) smooth: f64,
    /// A stiffness that comes and goes in each recording on its own, beside the final model.
    pub(super) wandering: Mismatch,
    /// A recording that does not agree with the others, beside the final model.
    pub(super) odd: Mismatch,
    /// A stiffness or a strength that oscillates, beside the final model.
    pub(super) oscillating: Mismatch,
    /// Sizes of the effects that differ from recording to recording, or from part to part.
    pub(super) agreed: Agreed,
    /// What is left goes on where the force is large.
    pub(super) in_step: Mismatch,
    /// The size of what is left, over the motion.
    pub(super) uneven: Uneven,
    /// Chance that its neighbouring samples go together over the motion.
    pub(super) linked: f64,
    /// Squared standard deviations that the effects explain.
    pub(super) explained: f64,
    /// Rms in N of the force that the best further candidate would add.
    pub(super) change: f64,
    /// Rms in N of the noise.
    pub(super) noise: f64,
    /// What speaks against the effects named.
    pub(super) against: Against,
    /// True where no more is left than the rounding of the force.
    pub(super) nothing_left: bool,
}

impl Evidence {
    pub(super) fn new(tests: &Tests, named: &Named, plain: bool, false_alarm: f64) -> Self {
        let Tests {
            first, rest, smooth, wandering, odd, oscillating, agreed, in_step, uneven, linked, ..
        } = *tests;
        let Tests { explained, change, noise, against, nothing_left, .. } = *tests;
        let apart = agreed.mismatch.excess() > APART * explained;
        let agreed = if apart { agreed } else { Agreed::NONE };
        let catalogue = by_effect(&named.scores);
        let holm = catalogue.iter().map(|(_, p)| *p).fold(1.0, f64::min) * catalogue.len().max(1) as f64;
        let of_places = [wandering, odd, oscillating, agreed.mismatch, in_step]
            .map(|m| m.p_value)
            .into_iter()
            .fold(1.0, f64::min);
        let tests = OF_ANY + agreed.tests as f64;
        let any = tests * rest.cautious().min(smooth).min(of_places).min(linked);
        let p_rest = if nothing_left { 1.0 } else { (WAYS * any.min(holm)).min(1.0) };
        let gain = named.next.as_ref().map_or(0.0, |n| (named.fitted.left - n.fitted.left).max(0.0));
        let swallowed = if uneven.p_value < PLAINLY_UNEVEN { uneven.swallowed } else { 0.0 };
        let left = rest
            .excess()
            .max(wandering.excess())
            .max(odd.excess())
            .max(oscillating.excess())
            .max(agreed.mismatch.excess())
            .max(in_step.excess())
            .max(gain)
            .max(swallowed);
        let share = if left > 0.0 { left / (left + explained) } else { 0.0 };
        let significant = p_rest <= false_alarm;
        Self {
            p_base: first.p_value,
            p_rest,
            p_even: uneven.p_value,
            false_alarm,
            share,
            left: if significant { left } else { 0.0 },
            lack_of_fit: if significant { change } else { 0.0 },
            noise,
            plain,
            hidden: named.noise.hidden(),
            against,
        }
    }

    /// The verdict on so many effects that follow the motion, and on a hum.
    pub(super) fn verdict(&self, effects: usize, hum: bool) -> Verdict {
        let several = usize::from(effects > 1);
        let trusted = TRUSTED[if self.plain { 0 } else { several }];
        match (effects, self.approximate()) {
            (0, false) if hum => Verdict::MissingPhysics,
            (0, true) if hum => Verdict::PartlyExplained,
            (0, false) => Verdict::Adequate,
            (0, true) => Verdict::Unexplained,
            _ if self.against == Against::Surpassed => Verdict::Unexplained,
            (_, true) if self.share > trusted && self.p_rest < BEYOND_CHANCE => Verdict::Unexplained,
            (_, true) if self.hidden || self.share > FORM[several] => Verdict::PartlyExplained,
            _ if self.against == Against::AtTheEnd => Verdict::PartlyExplained,
            (1, true) if self.plainly_inexact() => Verdict::PartlyExplained,
            _ => Verdict::MissingPhysics,
        }
    }

    /// The verdict, once it is known whether effects of another kind may stand in the place of one that is named: a
    /// form that is not exact is a form of that effect only where they may not.
    pub(super) fn beside_rivals(&self, verdict: Verdict, rivals: bool) -> Verdict {
        match verdict {
            Verdict::MissingPhysics if rivals && self.approximate() => Verdict::PartlyExplained,
            told => told,
        }
    }

    /// True where what is left would be seen beside the noise, however much was explained.
    fn plainly_inexact(&self) -> bool {
        self.share > SEEN[0] && self.lack_of_fit > SEEN[1] * self.noise
    }

    /// True where a mismatch is left: the law of the named effects is not exactly the catalogue's.
    pub fn approximate(&self) -> bool {
        self.p_rest <= self.false_alarm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_that_worsens_the_prediction_of_held_out_data_is_a_hint() {
        let told = |after| Verdict::MissingPhysics.beside_proofs(2.0, after);
        assert_eq!(told(1.9), Verdict::MissingPhysics);
        assert_eq!(told(2.001), Verdict::MissingPhysics);
        assert_eq!(told(2.01), Verdict::PartlyExplained);
        assert_eq!(Verdict::Adequate.beside_proofs(2.0, 3.0), Verdict::Adequate);
    }
}
