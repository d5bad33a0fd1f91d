//! The test that tells most of what is in doubt: all are looked at to first order, the easiest limits first, and those
//! that promise most closely.

use rayon::prelude::*;

use super::bench::Bench;
use super::excitation::{KINDS, Kind};
use super::hidden::Hidden;
use super::limits::Limits;
use super::told::Told;
use super::{NextTest, Prospect};

/// A test that is harder to make has to rule out so many more effects.
const WORTH: f64 = 0.1;
/// Chance that nothing is in doubt any more that is enough.
const ENOUGH: f64 = 0.95;
/// Tests that are looked at closely at most.
const CLOSELY: usize = 4;

/// A kind of test within limits, and what it tells.
struct Telling {
    kind: Kind,
    level: usize,
    told: Told,
    /// What a glance had said, of one that was looked at closely.
    glance: Option<Told>,
}

/// The easiest test that tells enough, or the one that tells most; with what it shows besides of what is hidden.
pub(super) fn to_tell(bench: &Bench, wider: &[Limits], hidden: &Hidden) -> Option<NextTest> {
    let mut all: Vec<Telling> = Vec::new();
    look_until_enough(bench, wider, &mut all)?;
    let enough = |telling: &Telling| telling.glance.is_some() && telling.told.certainty >= ENOUGH;
    let best = match all.iter().position(enough) {
        Some(found) => found,
        None => tells_most(bench, wider, &mut all)?,
    };
    proposed(bench, wider, hidden, &all, best)
}

/// Looks at tests, the easiest first, until one tells enough or as many as may be were looked at closely; `None` where that
/// is broken off.
fn look_until_enough(bench: &Bench, wider: &[Limits], all: &mut Vec<Telling>) -> Option<()> {
    let mut next = 0;
    for last in std::iter::once(0).chain(hardest(wider)) {
        let these = glances(bench, wider, last);
        // Where not even these promise enough, none that is easier does.
        let enough = these.iter().any(|telling| telling.told.certainty >= ENOUGH);
        let easier = if enough { next..last } else { last..last };
        for glances in easier.map(|level| glances(bench, wider, level)).chain([these]) {
            all.extend(glances);
            while let Some(i) = most(all, |told| told.certainty, ENOUGH) {
                look(bench, wider, &mut all[i])?;
                if all[i].told.certainty >= ENOUGH {
                    return Some(());
                }
            }
            if closely(all).count() >= CLOSELY {
                return Some(());
            }
        }
        next = last + 1;
    }
    Some(())
}

/// The test that tells most of those that were looked at closely, and of those that promise more.
fn tells_most(bench: &Bench, wider: &[Limits], all: &mut [Telling]) -> Option<usize> {
    let known = |all: &[Telling]| closely(all).map(|(t, _)| t.told.worth).fold(-WORTH, f64::max);
    while let Some(i) = most(all, |told| told.worth, known(all) + WORTH) {
        look(bench, wider, &mut all[i])?;
    }
    let mut best: Option<usize> = None;
    for i in (0..all.len()).filter(|i| all[*i].glance.is_some()) {
        let easier = best.filter(|known| {
            let more = if all[*known].level < all[i].level { WORTH } else { 0.0 };
            all[i].told.worth <= all[*known].told.worth + more
        });
        best = easier.or(Some(i));
    }
    best
}

/// The longest of the slowest tests, of the fastest, and of those of the highest frequency.
fn hardest(wider: &[Limits]) -> Vec<usize> {
    let last = |alike: &dyn Fn(&Limits) -> bool| wider.iter().rposition(alike);
    let (first, end) = (&wider[0], &wider[wider.len() - 1]);
    let slowest = last(&|limits| limits.speed == first.speed && limits.highest == first.highest);
    let fastest = last(&|limits| limits.speed == end.speed && limits.highest == first.highest);
    let mut levels: Vec<usize> = slowest.into_iter().chain(fastest).chain([wider.len() - 1]).collect();
    levels.dedup();
    levels.retain(|level| *level > 0);
    levels
}

/// All kinds within some limits.
fn glances(bench: &Bench, wider: &[Limits], level: usize) -> Vec<Telling> {
    KINDS.par_iter().filter_map(|kind| glance(bench, wider, level, *kind)).collect()
}

fn glance(bench: &Bench, wider: &[Limits], level: usize, kind: Kind) -> Option<Telling> {
    let told = bench.glance(&bench.imagine(kind, &wider[level])?)?;
    Some(Telling { kind, level, told, glance: None })
}

fn look(bench: &Bench, wider: &[Limits], telling: &mut Telling) -> Option<()> {
    let told = bench.look(&bench.imagine(telling.kind, &wider[telling.level])?)?;
    telling.glance = Some(std::mem::replace(&mut telling.told, told));
    Some(())
}

/// Tests that were looked at closely, each with its glance.
fn closely(all: &[Telling]) -> impl Iterator<Item = (&Telling, &Told)> {
    all.iter().filter_map(|telling| Some((telling, telling.glance.as_ref()?)))
}

/// The test, of those seen at a glance, that promises most, where that is so much at least; a kind that told less than
/// its glance had said will again. `None` where enough were looked at closely.
fn most(all: &[Telling], of: impl Fn(&Told) -> f64, least: f64) -> Option<usize> {
    if closely(all).count() >= CLOSELY {
        return None;
    }
    let promise = |telling: &Telling| {
        let same = closely(all).filter(|(known, _)| known.kind == telling.kind);
        let kept = same.map(|(known, glance)| of(&known.told) / of(glance).max(f64::MIN_POSITIVE));
        of(&telling.told) * kept.fold(1.0, f64::min)
    };
    let open = all.iter().enumerate().filter(|(_, telling)| telling.glance.is_none());
    let promises = open.map(|(i, telling)| (i, promise(telling))).filter(|(_, promise)| *promise >= least);
    // Of those that promise as much the first.
    promises.reduce(|best, other| if other.1 > best.1 { other } else { best }).map(|(i, _)| i)
}

/// A test, and the others within its limits, the best first.
fn proposed(
    bench: &Bench,
    wider: &[Limits],
    hidden: &Hidden,
    all: &[Telling],
    best: usize,
) -> Option<NextTest> {
    let limits = &wider[all[best].level];
    let mut others: Vec<&Telling> =
        (0..all.len()).filter(|i| *i != best && all[*i].level == all[best].level).map(|i| &all[i]).collect();
    others.sort_by(|a, b| {
        (b.glance.is_some(), b.told.worth)
            .partial_cmp(&(a.glance.is_some(), a.told.worth))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    let prospect = |t: &Telling| {
        let signal = t.kind.signal(limits, 1)?;
        let prospect = Prospect::new(t.kind, &signal, limits, t.told.chances.clone());
        Some(Prospect { certainty: Some(t.told.certainty), leaves: t.told.leaves.clone(), ..prospect })
    };
    let tellings = std::iter::once(&all[best]).chain(others);
    let mut prospects: Vec<Prospect> = tellings.filter_map(prospect).collect();
    let shown = hidden.shown(bench, &bench.imagine(all[best].kind, limits)?);
    prospects.first_mut()?.chances.extend(shown.unwrap_or_default());
    Some(NextTest { limits: limits.clone(), prospects })
}

#[cfg(test)]
mod tests {
    use super::super::GivenLimits;
    use super::*;

    fn told(worth: f64) -> Told {
        Told { chances: Vec::new(), leaves: Vec::new(), certainty: worth, worth }
    }

    fn telling(kind: Kind, worth: f64, glance: Option<f64>) -> Telling {
        Telling { kind, level: 0, told: told(worth), glance: glance.map(told) }
    }

    fn promising(all: &[Telling], least: f64) -> Option<usize> {
        most(all, |told| told.worth, least)
    }

    #[test]
    fn a_kind_that_told_less_than_it_promised_is_expected_to_again() {
        let seen = vec![telling(Kind::Sweep, 0.9, None), telling(Kind::Hold, 0.8, None)];
        assert_eq!(promising(&seen, 0.5), Some(0));
        assert_eq!(promising(&seen, 0.95), None);
        let mut after = vec![telling(Kind::Sweep, 0.3, Some(1.0))];
        after.extend(seen);
        assert_eq!(promising(&after, 0.5), Some(2));
        // More than was promised is not expected anew.
        after[0] = telling(Kind::Sweep, 2.0, Some(1.0));
        assert_eq!(promising(&after, 0.5), Some(1));
        assert_eq!(promising(&after, 0.95), None);
    }

    #[test]
    fn the_hardest_are_the_longest_of_each() {
        let tested =
            Limits { stroke: 5.0, speed: 50.0, highest: 10.0, duration: 12.0, rate: 200.0, current: None };
        let wider = tested.wider(&GivenLimits::default());
        let sizes = |level: usize| (wider[level].duration, wider[level].speed, wider[level].highest);
        let hard: Vec<(f64, f64, f64)> = hardest(&wider).into_iter().map(sizes).collect();
        assert_eq!(hard, [(96.0, 50.0, 10.0), (96.0, 200.0, 10.0), (24.0, 200.0, 40.0)]);
        assert_eq!(hardest(&wider[..4]), [3]);
        assert!(hardest(&wider[..1]).is_empty());
    }

    #[test]
    fn of_equal_promises_the_first_is_looked_at_and_no_more_than_are_allowed() {
        let mut all: Vec<Telling> = (0..=CLOSELY).map(|_| telling(Kind::Hold, 0.5, None)).collect();
        assert_eq!(promising(&all, 0.0), Some(0));
        for one in &mut all[..CLOSELY] {
            one.glance = Some(told(0.5));
        }
        assert_eq!(promising(&all, 0.0), None);
    }
}
