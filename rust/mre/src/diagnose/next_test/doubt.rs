//! What is in doubt, and the chance that evidence settles it.

use crate::diagnose::alternatives::APART;
use crate::diagnose::candidates::Candidate;
use crate::diagnose::distribution::normal_tail;
use crate::diagnose::search::Named;

/// Difference in the criterion beyond which more is no better.
const PLENTY: f64 = 100.0;
/// What that is worth beside a chance.
const SURER: f64 = 0.05;
/// Logarithm of the highest odds that are told of a rival: where it is as good as certain.
const MOST_ODDS: f64 = 50.0;
/// A rival with a smaller chance of being ruled out is expected to be left.
const EVEN: f64 = 0.5;

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

/// One of the effects that may stand in a place.
pub(super) struct Member {
    effect: &'static str,
    /// Its likeliest model.
    pub(super) likeliest: usize,
    /// All of its models.
    pub(super) models: Vec<usize>,
}

/// What an excitation is expected to tell of effects in doubt.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Told {
    /// Chance that each is told from the one named, whichever of the two is true.
    pub(super) chances: Vec<(&'static str, f64)>,
    /// For each that may be true, what would probably be left in doubt beside it.
    pub(super) leaves: Vec<(&'static str, Vec<&'static str>)>,
    /// Chance that nothing is in doubt any more.
    pub(super) certainty: f64,
    /// How many effects are ruled out, and a little for more evidence than that takes.
    pub(super) worth: f64,
}

impl<'a> Doubt<'a> {
    /// All models: the one named, other laws of its effects, rivals.
    pub(super) fn models(&self, named: &Named<'a>) -> Vec<Candidate<'a>> {
        let others = self.laws.iter().chain(&self.rivals).map(|rival| rival.model.clone());
        std::iter::once(named.itself()).chain(others).collect()
    }

    /// What may stand in each place in doubt, the effect named first.
    pub(super) fn places(&self, named: &Named, criteria: &[f64]) -> Vec<Vec<Member>> {
        let mut places: Vec<usize> = self.rivals.iter().map(|rival| rival.place).collect();
        places.dedup();
        let effects = named.assembly.effects();
        places.into_iter().map(|place| self.members(effects[place].about().effect, place, criteria)).collect()
    }

    fn members(&self, effect: &'static str, place: usize, criteria: &[f64]) -> Vec<Member> {
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
            let likeliest = member.models.iter().min_by(|a, b| criteria[**a].total_cmp(&criteria[**b]));
            member.likeliest = *likeliest.unwrap_or(&member.likeliest);
        }
        found
    }
}

/// What evidence tells of what may stand in each place, given the criteria of all models, and the difference in the
/// criterion by which a first model that is true rules out a second.
pub(super) fn told(places: &[Vec<Member>], criteria: &[f64], against: impl Fn(usize, usize) -> f64) -> Told {
    let mut all = Told { chances: Vec::new(), leaves: Vec::new(), certainty: 1.0, worth: 0.0 };
    for members in places {
        let odds: Vec<f64> = members
            .iter()
            .map(|m| (0.5 * (criteria[0] - criteria[m.likeliest])).min(MOST_ODDS).exp())
            .collect();
        let whole: f64 = odds.iter().sum();
        // By truth and other: the evidence against the likeliest law of the other.
        let evidence = |truth: &Member, other: &Member| {
            other.models.iter().map(|m| against(truth.likeliest, *m)).fold(f64::INFINITY, f64::min)
        };
        let mut certainty = 0.0;
        for (truth, odds) in members.iter().zip(&odds) {
            let others = || members.iter().filter(|other| other.likeliest != truth.likeliest);
            let against: Vec<f64> = others().map(|other| evidence(truth, other)).collect();
            let doubted = others().zip(&against).filter(|(_, e)| chance(**e) < EVEN);
            let doubted = doubted.map(|(other, _)| other.effect);
            match all.leaves.iter_mut().find(|(known, _)| *known == truth.effect) {
                Some((_, left)) => {
                    let more: Vec<&str> = doubted.filter(|id| !left.contains(id)).collect();
                    left.extend(more);
                }
                None => all.leaves.push((truth.effect, doubted.collect())),
            }
            certainty += odds / whole * against.iter().map(|e| chance(*e)).fold(1.0, f64::min);
            all.worth += odds / whole * against.iter().map(|e| chance(*e) + surer(*e)).sum::<f64>();
        }
        all.certainty *= certainty;
        for (member, odds) in members.iter().zip(&odds).skip(1) {
            let effect = member.effect;
            let (own, other) = (evidence(&members[0], member), evidence(member, &members[0]));
            let found = (chance(own) + odds * chance(other)) / (1.0 + odds);
            match all.chances.iter_mut().find(|(known, _)| *known == effect) {
                Some((_, least)) => *least = least.min(found),
                None => all.chances.push((effect, found)),
            }
        }
    }
    all
}

/// Where chances are even, more evidence is better.
fn surer(evidence: f64) -> f64 {
    SURER * (evidence / PLENTY).clamp(0.0, 1.0)
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

    #[test]
    fn a_twin_of_a_rival_leaves_a_doubt_unless_the_one_named_is_true() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("time_delay", 0), member("filter_lag", 1), member("rig_compliance", 2)];
        let twins = |truth: usize, other: usize| if truth > 0 && other > 0 { 0.0 } else { 1e3 };
        let found = told(&[members], &[7.0; 3], twins);
        assert!((found.certainty - 1.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert!(found.chances.iter().all(|(_, chance)| *chance > 0.999));
        let left: Vec<&[&str]> = found.leaves.iter().map(|(_, left)| left.as_slice()).collect();
        assert_eq!(left, [&[] as &[&str], &["rig_compliance"], &["filter_lag"]]);
        // The one named is told from both, each of the others from it.
        assert!((found.worth - 4.0 / 3.0 * (1.0 + SURER)).abs() < 1e-3, "{}", found.worth);
    }
}
