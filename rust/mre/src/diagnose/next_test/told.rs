//! What a test would tell of what is in doubt: the chance that evidence settles it.

use super::doubt::Member;
use crate::diagnose::alternatives::APART;
use crate::diagnose::distribution::normal_tail;

/// Difference in the criterion beyond which more is no better.
const PLENTY: f64 = 100.0;
/// What that is worth beside a chance.
const SURER: f64 = 0.05;
/// A rival with a smaller chance of being ruled out is expected to be left.
pub(super) const EVEN: f64 = 0.5;

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

/// What a test says against a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Evidence {
    /// By how much its criterion is behind that of what is true.
    difference: f64,
    /// By how much it has to be, to be ruled out.
    least: f64,
}

impl Evidence {
    /// Against a model that cannot follow the test.
    pub(super) const ALL: Self = Self { difference: f64::INFINITY, least: APART };

    /// `spared` is what the parameters that the model has more cost beyond Akaike's criterion, which keeps it in doubt as long
    /// as it is better by that; `left` what the form of what is true is wrong by, where less tells nothing.
    pub(super) fn new(difference: f64, spared: f64, left: f64) -> Self {
        // Where neither can follow the test, it tells nothing.
        let difference = if difference.is_nan() { 0.0 } else { difference };
        Self { difference, least: APART.max(spared).max(left) }
    }

    fn beyond(self) -> f64 {
        self.difference - self.least
    }

    /// That it is enough: the difference varies with the noise like a normal variable of four times its size as variance.
    fn chance(self) -> f64 {
        if self.difference == f64::INFINITY {
            return 1.0;
        }
        1.0 - normal_tail(self.beyond() / (2.0 * self.difference.max(1.0).sqrt()))
    }

    /// What it is worth: where chances are even, more is better.
    fn worth(self) -> f64 {
        self.chance() + SURER * ((self.beyond() + APART) / PLENTY).clamp(0.0, 1.0)
    }
}

/// What evidence tells of what may stand in each place, given by how much each model is behind, what may be true as a model
/// and its weight, and what each of those says against a model.
pub(super) fn told(
    places: &[Vec<Member>],
    behind: &[f64],
    truths: &[(usize, f64)],
    against: impl Fn(usize, usize) -> Evidence,
) -> Told {
    let mut all = Told { chances: Vec::new(), leaves: Vec::new(), certainty: 1.0, worth: 0.0 };
    // Mean over the parameters at which a member may be true.
    let mean = |truth: &Member, of: &dyn Fn(usize) -> f64| {
        let own = || truths.iter().enumerate().filter(|(_, (model, _))| truth.models.contains(model));
        let whole: f64 = own().map(|(_, (_, weight))| weight).sum();
        own().map(|(t, (_, weight))| weight / whole * of(t)).sum::<f64>()
    };
    // The evidence against the likeliest law of the other.
    let evidence = |t: usize, other: &Member| {
        let all = other.models.iter().map(|m| against(t, *m));
        all.fold(Evidence::ALL, |least, one| if one.beyond() < least.beyond() { one } else { least })
    };
    for members in places {
        let odds: Vec<f64> = members.iter().map(|m| (-0.5 * behind[m.likeliest]).exp()).collect();
        let whole: f64 = odds.iter().sum();
        let found = |truth: &Member, other: &Member| mean(truth, &|t| evidence(t, other).chance());
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
            let least = |t: usize| others().map(|other| evidence(t, other).chance()).fold(1.0, f64::min);
            certainty += odds / whole * mean(truth, &least);
            let worth = |t: usize| others().map(|other| evidence(t, other).worth()).sum::<f64>();
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

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(difference: f64) -> Evidence {
        Evidence::new(difference, 0.0, 0.0)
    }

    #[test]
    fn evidence_is_enough_with_an_even_chance_at_the_threshold() {
        assert!((plain(APART).chance() - 0.5).abs() < 1e-9);
        assert!(plain(0.0).chance() < 1e-5 && plain(60.0).chance() > 0.999);
        assert_eq!(plain(f64::NAN), plain(0.0));
        assert_eq!(plain(f64::INFINITY).chance(), 1.0);
    }

    #[test]
    fn one_with_more_parameters_is_ruled_out_where_it_fits_no_better() {
        // Two parameters more at a price of eight each, two of it Akaike's.
        let spared = 2.0 * 6.0;
        let chance = |difference| Evidence::new(difference, spared, 0.0).chance();
        // It leaves as much as what is true, and pays for both: by Akaike's criterion it is worse.
        assert!(chance(16.0) > 0.5);
        // It leaves less by more than both may by chance.
        assert!(chance(11.0) < 0.5 && plain(11.0).chance() > 0.5);
    }

    #[test]
    fn where_no_law_is_exact_more_is_needed_and_it_varies_as_much() {
        let chance = |difference, left| Evidence::new(difference, 0.0, left).chance();
        assert!((chance(200.0, 200.0) - 0.5).abs() < 1e-9);
        // Fifty of 250 are 1.6 standard deviations.
        assert!((chance(250.0, 200.0) - 0.943).abs() < 1e-3);
        assert_eq!(chance(60.0, 5.0), plain(60.0).chance());
    }

    #[test]
    fn what_the_recordings_leave_open_of_a_truth_counts_by_its_likelihood() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("thermal_softening", 0), member("cyclic_degradation", 1)];
        // Without cooling the two are twins; with it, half as likely, they are not.
        let truths = [(0, 1.0), (0, 0.5), (1, 1.0)];
        let against = |t: usize, other: usize| match (t, other) {
            (1, 1) | (2, 0) => plain(1e3),
            _ => plain(0.0),
        };
        let found = told(&[members], &[0.0; 2], &truths, against);
        assert!((found.certainty - 2.0 / 3.0).abs() < 1e-4, "{}", found.certainty);
        assert_eq!(
            found.leaves,
            [("thermal_softening", vec!["cyclic_degradation"]), ("cyclic_degradation", vec![])]
        );
    }

    #[test]
    fn a_twin_of_a_rival_leaves_a_doubt_unless_the_one_named_is_true() {
        let member = |effect, model| Member { effect, likeliest: model, models: vec![model] };
        let members = vec![member("time_delay", 0), member("filter_lag", 1), member("rig_compliance", 2)];
        let twins = |truth: usize, other: usize| plain(if truth > 0 && other > 0 { 0.0 } else { 1e3 });
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
