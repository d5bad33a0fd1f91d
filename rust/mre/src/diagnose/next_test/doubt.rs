//! What is in doubt: effects that may stand in the place of one that was named, and the models of each.

use crate::diagnose::alternatives::may_fit_better;
use crate::diagnose::candidates::{Candidate, akaike_of_the_smallest, smallest};
use crate::diagnose::search::Named;

/// A law with a smaller share of the likelihood is not imagined.
const UNLIKELY: f64 = 0.1;
/// Laws of an effect that are imagined at most beside the likeliest.
const OTHER_LAWS: usize = 3;

/// A model that fits about as well as the one named, or nearly where no law is exact, with a law in the place of one of its own.
pub(in super::super) struct Rival<'a> {
    /// Effect of this law.
    pub(in super::super) effect: &'static str,
    /// Place of the effect named, instead of which it stands.
    pub(in super::super) place: usize,
    pub(in super::super) model: Candidate<'a>,
}

/// What is in doubt.
pub(in super::super) struct Doubt<'a> {
    /// Other effects, of which some come with several laws.
    pub(in super::super) rivals: Vec<Rival<'a>>,
    /// Other laws of the effects named.
    pub(in super::super) laws: Vec<Rival<'a>>,
    /// Ids of effects that the recordings would hide.
    pub(in super::super) hidden: Vec<&'static str>,
    /// What the model named leaves of the recordings beyond chance, in squared standard deviations: where no law is exact, a
    /// difference below that tells nothing.
    pub(in super::super) left: f64,
}

impl<'a> Doubt<'a> {
    /// All models: the one named, other laws of its effects, rivals.
    pub(super) fn models(&self, named: &Named<'a>) -> Vec<Candidate<'a>> {
        let others = self.laws.iter().chain(&self.rivals).map(|rival| rival.model.clone());
        std::iter::once(named.itself()).chain(others).collect()
    }

    /// By how much each of these lacks what the one named has by Akaike's criterion.
    pub(super) fn lacks(&self, named: &Named<'a>) -> Vec<f64> {
        let others = self.laws.iter().chain(&self.rivals).map(|Rival { model, place, .. }| {
            model.akaike_as_the_smallest() - akaike_of_the_smallest(&named.assembly, &named.fitted, *place)
        });
        std::iter::once(0.0).chain(others).collect()
    }

    /// By how much each is less likely: what a parameter more costs where one law is to be named makes it no less likely, unless
    /// the noise is not known. None is likelier than the one named, whose law has stood what a rival has not: that it is not
    /// pressed to an end of its range, and what was held out.
    pub(super) fn behind(&self, named: &Named<'a>, lacks: &[f64]) -> Vec<f64> {
        let others = self.laws.iter().chain(&self.rivals).zip(&lacks[1..]);
        let others = others.map(|(Rival { model, place, .. }, akaike)| {
            let bayesian = || model.as_the_smallest() - smallest(&named.assembly, &named.fitted, *place);
            let lack = if may_fit_better(model, &named.noise) { *akaike } else { bayesian() };
            counted(lack, self.left)
        });
        std::iter::once(0.0).chain(others).collect()
    }

    /// What may stand in each place in doubt, the effect named first.
    pub(super) fn places(&self, named: &Named, lacks: &[f64]) -> Vec<Vec<Member>> {
        let mut places: Vec<usize> = self.rivals.iter().map(|rival| rival.place).collect();
        places.dedup();
        let effects = named.assembly.effects();
        places.into_iter().map(|place| self.members(effects[place].about().effect, place, lacks)).collect()
    }

    fn members(&self, effect: &'static str, place: usize, lacks: &[f64]) -> Vec<Member> {
        let first = 1 + self.laws.len();
        let laws = self.laws.iter().enumerate().filter(|(_, law)| law.place == place).map(|(i, _)| 1 + i);
        let mut found =
            vec![Member { effect, likeliest: 0, models: std::iter::once(0).chain(laws).collect() }];
        for (i, rival) in self.rivals.iter().enumerate().filter(|(_, rival)| rival.place == place) {
            match found.iter_mut().find(|member| member.effect == rival.effect) {
                Some(member) => member.models.push(first + i),
                None => {
                    found.push(Member {
                        effect: rival.effect,
                        likeliest: first + i,
                        models: vec![first + i],
                    });
                }
            }
        }
        for member in &mut found[1..] {
            let likeliest = member.models.iter().min_by(|a, b| lacks[**a].total_cmp(&lacks[**b]));
            member.likeliest = *likeliest.unwrap_or(&member.likeliest);
        }
        found
    }
}

/// One of the effects that may stand in a place.
pub(super) struct Member {
    pub(super) effect: &'static str,
    /// Its likeliest model.
    pub(super) likeliest: usize,
    /// All of its models.
    pub(super) models: Vec<usize>,
}

impl Member {
    /// Its likeliest model, and those of its other laws that may best be true, each with its share of the likelihood: what
    /// a parameter more costs where a law is to be named says little of which is true, but that it fits better by chance.
    /// `lacks` is by Akaike's criterion.
    pub(super) fn may_be_true(&self, lacks: &[f64]) -> Vec<(usize, f64)> {
        let share = |model: usize| (0.5 * (lacks[self.likeliest] - lacks[model])).exp().min(1.0);
        let others = self.models.iter().copied().filter(|model| *model != self.likeliest);
        let mut others: Vec<(usize, f64)> =
            others.map(|model| (model, share(model))).filter(|(_, share)| *share > UNLIKELY).collect();
        others.sort_by(|(a, _), (b, _)| lacks[*a].total_cmp(&lacks[*b]));
        others.truncate(OTHER_LAWS);
        std::iter::once((self.likeliest, 1.0)).chain(others).collect()
    }
}

/// What a lack counts, where no law is exact by so much.
fn counted(lack: f64, left: f64) -> f64 {
    (lack - left).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_inexact_law_leaves_speaks_against_none_and_none_is_likelier_than_the_one_named() {
        let counted = |left| [-40.0, -3.0, 5.0, 40.0].map(|lack| counted(lack, left));
        assert_eq!(counted(0.0), [0.0, 0.0, 5.0, 40.0]);
        assert_eq!(counted(30.0), [0.0, 0.0, 0.0, 10.0]);
    }

    #[test]
    fn another_law_may_be_true_as_far_as_it_fits() {
        let member = Member { effect: "thermal_softening", likeliest: 0, models: vec![0, 1, 2] };
        let with = |lacks: [f64; 3]| member.may_be_true(&lacks);
        assert_eq!(with([10.0, 12.0, 9.0]), [(0, 1.0), (2, 1.0), (1, (-1.0_f64).exp())]);
        assert_eq!(with([10.0, 40.0, f64::INFINITY]), [(0, 1.0)]);
        let many = Member { effect: "thermal_softening", likeliest: 0, models: (0..9).collect() };
        assert_eq!(many.may_be_true(&[1.0; 9]).len(), 1 + OTHER_LAWS);
    }
}
