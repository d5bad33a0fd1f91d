//! What is in doubt, and the chance that evidence settles it.

use crate::diagnose::candidates::Candidate;
use crate::diagnose::distribution::normal_tail;
use crate::diagnose::search::Named;

/// Difference in the criterion from which two effects are told apart.
const APART: f64 = 10.0;
/// Logarithm of the highest odds that are told of a rival: where it is as good as certain.
const MOST_ODDS: f64 = 50.0;

/// A model that fits about as well as the one named, with a law in the place of one of its own.
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
}

/// What an excitation is expected to tell of an effect in doubt.
#[derive(Debug, Clone, Copy)]
pub(super) struct Told {
    pub(super) effect: &'static str,
    /// Chance that it is told from the one named, whichever of the two is true.
    pub(super) chance: f64,
    /// Least difference in the criterion that is expected.
    pub(super) evidence: f64,
}

impl<'a> Doubt<'a> {
    /// All models: the one named, other laws of its effects, rivals.
    pub(super) fn models(&self, named: &Named<'a>) -> Vec<Candidate<'a>> {
        let others = self.laws.iter().chain(&self.rivals).map(|rival| rival.model.clone());
        std::iter::once(named.itself()).chain(others).collect()
    }

    /// Ids of the effects in doubt.
    fn effects(&self) -> Vec<&'static str> {
        let mut found: Vec<&'static str> = Vec::new();
        for rival in &self.rivals {
            if !found.contains(&rival.effect) {
                found.push(rival.effect);
            }
        }
        found
    }

    /// Places among the models of those of an effect.
    fn of(&self, effect: &'static str) -> impl Iterator<Item = usize> {
        let own = self.rivals.iter().enumerate().filter(move |(_, rival)| rival.effect == effect);
        own.map(|(i, _)| 1 + self.laws.len() + i)
    }

    /// The likeliest model of an effect.
    fn likeliest(&self, effect: &'static str, models: &[Candidate]) -> Option<usize> {
        self.of(effect).min_by(|a, b| models[*a].criterion().total_cmp(&models[*b].criterion()))
    }

    /// Places of the models that may be true: the one named, and the likeliest of each effect; with those that evidence
    /// has to rule out then.
    pub(super) fn truths(&self, models: &[Candidate]) -> Vec<(usize, Vec<usize>)> {
        let rivals = (1 + self.laws.len()..models.len()).collect();
        let mut found = vec![(0, rivals)];
        for effect in self.effects() {
            let Some(truth) = self.likeliest(effect, models) else { continue };
            let place = self.rivals[truth - 1 - self.laws.len()].place;
            let laws = self.laws.iter().enumerate().filter(|(_, law)| law.place == place);
            found.push((truth, std::iter::once(0).chain(laws.map(|(i, _)| 1 + i)).collect()));
        }
        found
    }

    /// What evidence tells, given the difference in the criterion by which a first model that is true rules out a second.
    pub(super) fn told(
        &self,
        models: &[Candidate],
        against: impl Fn(usize, usize) -> Option<f64>,
    ) -> Vec<Told> {
        let truths = self.truths(models);
        let least = |truth: usize, others: &mut dyn Iterator<Item = usize>| {
            others.filter_map(|other| against(truth, other)).fold(f64::INFINITY, f64::min)
        };
        let told = |effect: &'static str| {
            let own = least(0, &mut self.of(effect));
            let truth = self.likeliest(effect, models)?;
            let ruled_out = truths.iter().find(|(t, _)| *t == truth).map(|(_, others)| others.clone())?;
            let other = least(truth, &mut ruled_out.into_iter());
            let odds = (0.5 * (models[0].criterion() - models[truth].criterion())).min(MOST_ODDS).exp();
            let chance = (chance(own) + odds * chance(other)) / (1.0 + odds);
            Some(Told { effect, chance, evidence: own.min(other) })
        };
        self.effects().into_iter().filter_map(told).collect()
    }
}

/// That so much evidence is enough: it varies with the noise like a normal variable of four times its size as variance.
/// A model that cannot follow the excitation at all is ruled out.
fn chance(evidence: f64) -> f64 {
    if evidence == f64::INFINITY {
        return 1.0;
    }
    1.0 - normal_tail((evidence - APART) / (2.0 * evidence.max(1.0).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evidence_is_enough_with_an_even_chance_at_the_threshold() {
        assert!((chance(APART) - 0.5).abs() < 1e-9);
        assert!(chance(0.0) < 1e-5 && chance(60.0) > 0.999);
    }
}
