//! A or B: effects that the recordings cannot tell from one that was named.

use super::candidates::{Candidate, candidates, scores};
use super::least_squares::Data;
use super::search::{Named, REFITTED, Search};

/// A rival that leaves less than this much more (in squared standard deviations, a parameter's price
/// included) cannot be told apart: the odds against it are below 150 to 1.
const APART: f64 = 10.0;

/// Models with another effect in the place of one that was named, which fit as well within the noise; with the
/// ids of these effects.
pub(super) fn rivals<'a>(
    search: &Search<'_, 'a>,
    named: &Named<'a>,
    place: usize,
    data: Data,
) -> Vec<(&'static str, Candidate<'a>)> {
    let without = search.drop(named, place);
    let id = named.assembly.effects()[place].about().effect;
    let scored = scores(&without.assembly, data, &without.fitted.unit, search.settings);
    let price = (named.fitted.rows as f64).ln();
    let parameters = named.fitted.coefficients.len() + named.fitted.unit.len();
    let own = named.fitted.left + price * parameters as f64;
    let mut found: Vec<(&'static str, Candidate)> = Vec::new();
    for candidate in candidates(&without.assembly, data, &without.fitted.unit, &scored, REFITTED) {
        let Some(last) = candidate.assembly.effects().last() else { continue };
        let rival = last.about().effect;
        let known = found.iter().any(|(known, _)| *known == rival);
        if rival != id && candidate.criterion() <= own + APART && !known {
            found.push((rival, candidate));
        }
    }
    found
}
