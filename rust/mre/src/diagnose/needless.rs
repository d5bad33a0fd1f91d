//! Models without one of their effects.

use super::candidates::Candidate;
use super::joint::fit;
use super::least_squares::Data;
use super::monitor::Stage;
use super::noise::Noise;
use super::prove::prove;
use super::search::{Named, Search};
use super::strained::any_strained;

/// A model with those of its effects, by place, that are kept, refitted.
pub(super) fn keeping<'a>(named: &Named<'a>, data: Data, kept: impl Fn(usize) -> bool) -> Candidate<'a> {
    let sizes = named.assembly.campaign().sizes();
    let shapes = named.assembly.physical(&named.fitted.unit);
    let (base, mut rest) = shapes.split_at(named.assembly.base_shapes());
    let (mut effects, mut own) = (Vec::new(), base.to_vec());
    for (place, effect) in named.assembly.effects().iter().enumerate() {
        let (shape, others) = rest.split_at(effect.shape(sizes).len());
        rest = others;
        if kept(place) {
            effects.push(*effect);
            own.extend_from_slice(shape);
        }
    }
    let narrower = named.assembly.with(effects);
    let unit = narrower.unit(&own);
    fit(narrower, data, &unit)
}

/// A model with the effects that were given, `given` of them, and what does not follow the motion: a hum.
pub(super) fn beside_a_hum<'a>(named: &Named<'a>, data: Data, given: usize) -> Candidate<'a> {
    let effects = named.assembly.effects();
    keeping(named, data, |place| place < given || !effects[place].follows_the_motion())
}

impl<'a> Search<'_, 'a> {
    /// A model without one of its effects, refitted.
    pub(super) fn drop(&self, named: &Named<'a>, place: usize) -> Candidate<'a> {
        keeping(named, self.data(&named.noise), |other| other != place)
    }

    /// True where the effect at a place fits only where its law ends, and the others explain more than half without it:
    /// it patches their form. `without` makes the model without it.
    pub(super) fn patches(
        &self,
        named: &Named<'a>,
        place: usize,
        without: impl FnOnce() -> Candidate<'a>,
    ) -> bool {
        let data = self.data(&named.noise);
        // Where the base plainly misses, no law has the exact form.
        if self.begun.noise.hidden() || !any_strained(named, data, place..place + 1) {
            return false;
        }
        let alone = beside_a_hum(named, data, self.given());
        let taken_off = |c: &Candidate| alone.fitted.left - c.fitted.left;
        taken_off(&without()) > 0.5 * taken_off(&named.itself())
    }

    /// Remove effects that the others make unnecessary, or that only patch their form.
    pub(super) fn without_the_needless(&self, named: Named<'a>) -> Named<'a> {
        let mut here = named;
        let mut place = self.given();
        while self.found(&here) > 1 && place < here.assembly.effects().len() {
            let now = here.itself();
            let tried = self.monitor.stage(Stage::Needless, || {
                let without = self.drop(&here, place);
                let needless = without.criterion() < now.criterion()
                    || self.idle(&now, &without, &here.noise)
                    || self.patches(&here, place, || without.clone());
                (without, needless)
            });
            let Some((without, needless)) = tried else { break };
            if needless {
                let Some(mut narrower) = self.look(without.assembly, &without.fitted.unit, &here.noise)
                else {
                    break;
                };
                narrower.p_values.clone_from(&here.p_values);
                narrower.p_values.remove(place - self.given());
                here = narrower;
                place = self.given();
            } else {
                place += 1;
            }
        }
        here
    }

    /// True where the base plainly misses, and a model does no better on held-out data than one without an
    /// effect: its criterion only counts what is left.
    fn idle(&self, with: &Candidate<'a>, without: &Candidate<'a>, noise: &Noise) -> bool {
        let splits = self.splits.fit_for(&with.assembly);
        let held_out =
            |c: &Candidate<'a>| prove(&c.assembly, noise, splits, &c.fitted, self.monitor).held_out_rms;
        self.begun.noise.hidden() && held_out(without) <= held_out(with)
    }
}
