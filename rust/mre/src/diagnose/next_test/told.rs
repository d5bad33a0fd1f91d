//! What a test would tell of what is in doubt: the chance that evidence settles it.

use super::doubt::Member;
use crate::diagnose::alternatives::APART;
use crate::diagnose::distribution::normal_tail;

/// Difference in the criterion beyond which more is no better.
const PLENTY: f64 = 100.0;
/// What that is worth beside a chance.
const SURER: f64 = 0.05;
/// Logarithm of the highest odds that are told of a rival: where it is as good as certain.
const MOST_ODDS: f64 = 50.0;
/// A rival with a smaller chance of being ruled out is expected to be left.
const EVEN: f64 = 0.5;

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

/// What evidence tells of what may stand in each place, given by how much each model is behind, what may be true as a model
/// and its weight, and the difference in the criterion by which each of those rules out a model.
pub(super) fn told(
    places: &[Vec<Member>],
    behind: &[f64],
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
        let odds: Vec<f64> =
            members.iter().map(|m| (-0.5 * behind[m.likeliest]).min(MOST_ODDS).exp()).collect();
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

/// What a difference in the criterion is worth against a model that has parameters more, of which so much is spared by
/// Akaike's: it is in doubt as long as it is better by that.
pub(super) fn against(difference: f64, spared: f64) -> f64 {
    // Where neither can follow the test, it tells nothing.
    if difference.is_nan() { 0.0 } else { difference.min(difference - spared + APART) }
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
        let found = told(&[members], &[0.0; 2], &truths, against);
        assert!((found.certainty - 2.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert_eq!(
            found.leaves,
            [("thermal_softening", vec!["cyclic_degradation"]), ("cyclic_degradation", vec![])]
        );
    }

    #[test]
    fn one_with_more_parameters_is_ruled_out_where_it_fits_no_better() {
        // Two parameters more at a price of eight each, two of it Akaike's.
        let spared = 2.0 * 6.0;
        assert_eq!(against(50.0, 0.0), 50.0);
        // It leaves as much as what is true, and pays for both: by Akaike's criterion it is worse.
        assert!(chance(against(16.0, spared)) > 0.5);
        // It leaves less by twice what both may by chance.
        assert!(chance(against(8.0, spared)) < 0.5);
        // One that is ahead stays ahead, and what cannot be followed tells nothing.
        assert_eq!(against(-3.0, spared), -5.0);
        assert_eq!(against(f64::NAN, spared), 0.0);
        assert_eq!(against(f64::INFINITY, spared), f64::INFINITY);
    }

    #[test]
    fn a_twin_of_a_rival_leaves_a_doubt_unless_the_one_named_is_true() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("time_delay", 0), member("filter_lag", 1), member("rig_compliance", 2)];
        let twins = |truth: usize, other: usize| if truth > 0 && other > 0 { 0.0 } else { 1e3 };
        let truths = [(0, 1.0), (1, 1.0), (2, 1.0)];
        let found = told(&[members], &[0.0; 3], &truths, twins);
        assert!((found.certainty - 1.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert!(found.chances.iter().all(|(_, chance)| *chance > 0.999));
        let left: Vec<&[&str]> = found.leaves.iter().map(|(_, left)| left.as_slice()).collect();
        assert_eq!(left, [&[] as &[&str], &["rig_compliance"], &["filter_lag"]]);
        // The one named is told from both, each of the others from it.
        assert!((found.worth - 4.0 / 3.0 * (1.0 + SURER)).abs() < 1e-3, "{}", found.worth);
    }
}
