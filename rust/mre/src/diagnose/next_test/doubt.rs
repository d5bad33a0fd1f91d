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
/// A law with a smaller share of the likelihood is not imagined.
const UNLIKELY: f64 = 0.1;
/// Laws of an effect that are imagined at most beside the likeliest.
const OTHER_LAWS: usize = 3;
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
    likeliest: usize,
    /// All of its models.
    pub(super) models: Vec<usize>,
}

impl Member {
    /// Its likeliest model, and those of its other laws that may best be true, each with its share of the likelihood: what
    /// a parameter more costs where a law is to be named says little of which is true, but that it fits better by chance
    /// (Akaike, IEEE Trans. Autom. Control 19 (1974) 716). `lacks` is that criterion.
    pub(super) fn may_be_true(&self, lacks: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let share = |model: usize| (0.5 * (lacks(self.likeliest) - lacks(model))).exp().min(1.0);
        let others = self.models.iter().copied().filter(|model| *model != self.likeliest);
        let mut others: Vec<(usize, f64)> = others
            .filter(|model| lacks(*model).is_finite())
            .map(|model| (model, share(model)))
            .filter(|(_, share)| *share > UNLIKELY)
            .collect();
        others.sort_by(|(a, _), (b, _)| lacks(*a).total_cmp(&lacks(*b)));
        others.truncate(OTHER_LAWS);
        std::iter::once((self.likeliest, 1.0)).chain(others).collect()
    }
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

/// What evidence tells of what may stand in each place, given the criteria of all models, what may be true as a model and
/// its weight, and the difference in the criterion by which each of those rules out a model.
pub(super) fn told(
    places: &[Vec<Member>],
    criteria: &[f64],
    truths: &[(usize, f64)],
    against: impl Fn(usize, usize) -> f64,
) -> Told {
    let mut all = Told { chances: Vec::new(), leaves: Vec::new(), certainty: 1.0, worth: 0.0 };
    // Mean over the parameters at which a member may be true.
    let mean = |truth: &Member, of: &dyn Fn(usize) -> f64| {
        let own = || truths.iter().enumerate().filter(|(_, (model, _))| truth.models.contains(model));
        let whole: f64 = own().map(|(_, (_, weight))| weight).sum();
        own().map(|(t, (_, weight))| weight / whole * of(t)).sum::<f64>()
    };
    // The evidence against the likeliest law of the other.
    let evidence =
        |t: usize, other: &Member| other.models.iter().map(|m| against(t, *m)).fold(f64::INFINITY, f64::min);
    for members in places {
        let odds: Vec<f64> = members
            .iter()
            .map(|m| (0.5 * (criteria[0] - criteria[m.likeliest])).min(MOST_ODDS).exp())
            .collect();
        let whole: f64 = odds.iter().sum();
        let found = |truth: &Member, other: &Member| mean(truth, &|t| chance(evidence(t, other)));
        let mut certainty = 0.0;
        for (truth, odds) in members.iter().zip(&odds) {
            let others = || members.iter().filter(|other| other.likeliest != truth.likeliest);
            let doubted = others().filter(|other| found(truth, other) < EVEN).map(|other| other.effect);
            match all.leaves.iter_mut().find(|(known, _)| *known == truth.effect) {
                Some((_, left)) => {
                    let more: Vec<&str> = doubted.filter(|id| !left.contains(id)).collect();
                    left.extend(more);
                }
                None => all.leaves.push((truth.effect, doubted.collect())),
            }
            let least = |t: usize| others().map(|other| chance(evidence(t, other))).fold(1.0, f64::min);
            certainty += odds / whole * mean(truth, &least);
            let of = |e: f64| chance(e) + surer(e);
            let worth = |t: usize| others().map(|other| of(evidence(t, other))).sum::<f64>();
            all.worth += odds / whole * mean(truth, &worth);
        }
        all.certainty *= certainty;
        for (member, odds) in members.iter().zip(&odds).skip(1) {
            let effect = member.effect;
            let (own, other) = (found(&members[0], member), found(member, &members[0]));
            let chance = (own + odds * other) / (1.0 + odds);
            match all.chances.iter_mut().find(|(known, _)| *known == effect) {
                Some((_, least)) => *least = least.min(chance),
                None => all.chances.push((effect, chance)),
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
    fn what_the_recordings_leave_open_of_a_truth_counts_by_its_likelihood() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("thermal_softening", 0), member("cyclic_degradation", 1)];
        // Without cooling the two are twins; with it, half as likely, they are not.
        let truths = [(0, 1.0), (0, 0.5), (1, 1.0)];
        let against = |t: usize, other: usize| match (t, other) {
            (1, 1) | (2, 0) => 1e3,
            _ => 0.0,
        };
        let found = told(&[members], &[7.0; 2], &truths, against);
        assert!((found.certainty - 2.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert_eq!(
            found.leaves,
            [("thermal_softening", vec!["cyclic_degradation"]), ("cyclic_degradation", vec![])]
        );
    }

    #[test]
    fn another_law_may_be_true_as_far_as_it_fits() {
        let member = Member { effect: "thermal_softening", likeliest: 0, models: vec![0, 1, 2] };
        let with = |lacks: [f64; 3]| member.may_be_true(|model| lacks[model]);
        assert_eq!(with([10.0, 12.0, 9.0]), [(0, 1.0), (2, 1.0), (1, (-1.0_f64).exp())]);
        assert_eq!(with([10.0, 40.0, f64::INFINITY]), [(0, 1.0)]);
        let many = Member { effect: "thermal_softening", likeliest: 0, models: (0..9).collect() };
        assert_eq!(many.may_be_true(|_| 1.0).len(), 1 + OTHER_LAWS);
    }

    #[test]
    fn a_twin_of_a_rival_leaves_a_doubt_unless_the_one_named_is_true() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("time_delay", 0), member("filter_lag", 1), member("rig_compliance", 2)];
        let twins = |truth: usize, other: usize| if truth > 0 && other > 0 { 0.0 } else { 1e3 };
        let truths = [(0, 1.0), (1, 1.0), (2, 1.0)];
        let found = told(&[members], &[7.0; 3], &truths, twins);
        assert!((found.certainty - 1.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert!(found.chances.iter().all(|(_, chance)| *chance > 0.999));
        let left: Vec<&[&str]> = found.leaves.iter().map(|(_, left)| left.as_slice()).collect();
        assert_eq!(left, [&[] as &[&str], &["rig_compliance"], &["filter_lag"]]);
        // The one named is told from both, each of the others from it.
        assert!((found.worth - 4.0 / 3.0 * (1.0 + SURER)).abs() < 1e-3, "{}", found.worth);
    }
}
