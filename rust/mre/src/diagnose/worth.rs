//! Whether a further effect is worth adding: it has to help on data that took no part.

use super::candidates::Candidate;
use super::monitor::Stage;
use super::needless::beside_a_hum;
use super::noise::Noise;
use super::prove::prove;
use super::search::{MOST, Named, Search};
use super::splits::Split;

/// A further effect lowers the held-out rms by more than this share of the noise's rms,
const LEAST_OF_NOISE: f64 = 0.1;
/// or, beside a first that is as weak, by this share of what the first one lowered it;
const BESIDE_A_WEAK: f64 = 0.25;
/// And by more than this share of that, unless it leaves next to nothing: what patches the form of the first leaves
/// some.
const LEAST_OF_FIRST: f64 = 0.2;
/// Share of the mean square beyond the noise's that is next to nothing.
const NOTHING: f64 = 0.1;
/// And, where the noise is hidden, by more than this share of itself: every model of a real device can be bent a
/// little closer.
const LEAST_OF_REST: f64 = 0.1;
/// With its best law an effect improves no more than so many times what its first law does.
const BEST_LAW: f64 = 2.0;
/// Share of a held-out rms that does not count.
pub(super) const SLIGHT: f64 = 0.03;

/// What a model improves, N.
pub(super) struct Improvement {
    /// By how much it lowers the held-out rms.
    pub(super) held_out: f64,
    /// The same on the samples trained on.
    pub(super) trained: f64,
    /// Held-out rms before.
    pub(super) rest: f64,
    /// Rms of the noise.
    pub(super) noise: f64,
}

impl Improvement {
    /// True where next to nothing is left beyond the noise.
    fn whole(&self) -> bool {
        let beyond = |rms: f64| rms * rms - self.noise * self.noise;
        beyond(self.rest - self.held_out) < NOTHING * beyond(self.rest)
    }
}

/// True for a candidate whose own effect follows the motion.
fn moves(next: &Candidate) -> bool {
    next.assembly.effects().last().is_some_and(|effect| effect.follows_the_motion())
}

impl<'a> Search<'_, 'a> {
    /// Rms of a candidate on held-out samples, N.
    pub(super) fn held_out(&self, noise: &Noise, c: &Candidate<'a>) -> f64 {
        let splits = self.splits.fit_for(&c.assembly);
        prove(&c.assembly, noise, splits, &c.fitted, self.monitor).held_out_rms
    }

    /// Candidates beside a model in the order of trying: where the likelihood of a hidden noise says little, that of
    /// what they improve on held-out samples, of those that promise enough; of equals the plainest first.
    pub(super) fn in_turn<'n>(&self, here: &'n Named<'a>) -> Vec<&'n Candidate<'a>> {
        let all = here.next.iter().chain(&here.later);
        if here.later.is_empty() {
            return all.collect();
        }
        let error = |splits: &[Split]| {
            prove(&here.assembly, &here.noise, splits, &here.fitted, self.monitor).held_out_rms
        };
        // Errors of this model, once for each kind of split.
        let mut before: Vec<(&[Split], f64)> = Vec::new();
        // By what share a candidate lowers them.
        let mut gain = |c: &Candidate<'a>| {
            let splits = self.splits.fit_for(&c.assembly);
            let known = before.iter().find(|(of, _)| std::ptr::eq(*of, splits)).map(|(_, known)| *known);
            let known = known.unwrap_or_else(|| {
                before.push((splits, error(splits)));
                before[before.len() - 1].1
            });
            1.0 - self.held_out(&here.noise, c) / known
        };
        let mut tried: Vec<_> = all.map(|c| (gain(c), c)).collect();
        tried.sort_by(|a, b| b.0.total_cmp(&a.0));
        if self.moved(here) > 0 {
            tried.retain(|(gain, _)| *gain > LEAST_OF_REST / BEST_LAW);
        }
        let best = tried.first().map_or(0.0, |(gain, _)| *gain);
        let tied = tried.partition_point(|(gain, _)| *gain >= best - SLIGHT);
        tried[..tied].sort_by_key(|(_, c)| c.fitted.parameters());
        tried.into_iter().map(|(_, c)| c).collect()
    }

    /// The same with the first further effect, under its best law, that also helps on data that took no part: by
    /// much, where it could patch the form of the others. Or with two, where one alone is not worth adding.
    pub(super) fn worth_adding(&self, here: &Named<'a>, by_first: f64) -> Option<Named<'a>> {
        let mut refused = None;
        for next in self.in_turn(here) {
            let Some(best) = self.further(here, next) else { continue };
            if self.worth(here, next, &best, by_first) == Some(true) && !self.patches_the_others(&best, next)
            {
                return Some(best);
            }
            refused = moves(next).then_some(best);
        }
        self.two_worth_adding(here, &refused?, by_first)
    }

    /// True where the effect of a candidate, under its best law, only patches the form of the others.
    fn patches_the_others(&self, named: &Named<'a>, next: &Candidate<'a>) -> bool {
        let effects = named.assembly.effects();
        let place = effects.iter().position(|effect| Some(effect.about().effect) == next.added());
        place.is_some_and(|place| {
            let patches = || self.patches(named, place, || self.drop(named, place));
            self.monitor.stage(Stage::Needless, patches) == Some(true)
        })
    }

    /// A model with one more effect under its best law, if that is significant.
    fn further(&self, here: &Named<'a>, next: &Candidate<'a>) -> Option<Named<'a>> {
        self.best_law(self.wider(here, next)?)
    }

    /// The same with one effect and the best beside it, where both together are worth it: as long as one is missing,
    /// the other looks like a patch on the form of the first.
    fn two_worth_adding(&self, here: &Named<'a>, one: &Named<'a>, by_first: f64) -> Option<Named<'a>> {
        if here.noise.hidden() || self.found(here) + 2 > MOST {
            return None;
        }
        let two = self.further(one, one.next.as_ref().filter(|next| moves(next))?)?;
        let both = self.improvement(here, &two)?;
        let least = LEAST_OF_NOISE * both.noise;
        let enough = |improved: Option<Improvement>| improved.is_some_and(|i| i.held_out >= least);
        let each = enough(self.improvement(here, one)) && enough(self.improvement(one, &two));
        (each && both.whole() && both.held_out >= LEAST_OF_FIRST * by_first).then_some(two)
    }

    /// True where a model, which comes of a candidate, is worth its effects beyond those of another.
    pub(super) fn worth(
        &self,
        here: &Named<'a>,
        next: &Candidate<'a>,
        best: &Named<'a>,
        by_first: f64,
    ) -> Option<bool> {
        let improved = self.improvement(here, best)?;
        let Improvement { held_out, rest, noise, .. } = improved;
        let of_rest = if best.noise.hidden() { LEAST_OF_REST * rest } else { 0.0 };
        let of_first = if improved.whole() { 0.0 } else { LEAST_OF_FIRST * by_first };
        let follows = moves(next);
        let weak = if by_first > 0.0 { BESIDE_A_WEAK * by_first } else { f64::INFINITY };
        let of_noise = weak.min(LEAST_OF_NOISE * noise);
        let least = if follows { of_noise.max(of_first).max(of_rest) } else { 0.0 };
        let plain = || follows && !best.noise.hidden() && self.share(here, next) >= BESIDE_A_WEAK;
        Some(held_out >= least || (held_out >= 0.0 && plain()))
    }

    /// What a candidate takes off, as a share of what the effects before it do beside a hum, in squared standard
    /// deviations: in slow noise these tell what no rms does.
    pub(super) fn share(&self, here: &Named<'a>, next: &Candidate<'a>) -> f64 {
        let before = beside_a_hum(here, self.data(&here.noise), self.given());
        (here.fitted.left - next.fitted.left) / (before.fitted.left - here.fitted.left).max(f64::MIN_POSITIVE)
    }

    /// What one model improves of another.
    pub(super) fn improvement(&self, before: &Named<'a>, after: &Named<'a>) -> Option<Improvement> {
        let splits = self.splits.fit_for(&after.assembly);
        let proof = |n: &Named<'a>| prove(&n.assembly, &after.noise, splits, &n.fitted, self.monitor);
        let data = self.data(&after.noise);
        self.monitor.stage(Stage::Proof, || {
            let (a, b) = (proof(before), proof(after));
            Improvement {
                held_out: a.held_out_rms - b.held_out_rms,
                trained: a.train_rms - b.train_rms,
                rest: a.held_out_rms,
                noise: after.noise_rms(data),
            }
        })
    }
}
