//! A or B: effects that the recordings cannot tell from one that was named.

use super::candidates::{candidates, scores};
use super::least_squares::Data;
use super::search::{Named, REFITTED, Search};

/// A rival that leaves less than this much more (in squared standard deviations, a parameter's price
/// included) cannot be told apart: the odds against it are below 150 to 1.
const APART: f64 = 10.0;

/// Ids of effects that, in the place of one that was named, fit as well within the noise.
pub(super) fn rivals(search: &Search, named: &Named, place: usize, data: Data) -> Vec<&'static str> {
    let without = search.drop(named, place);
    let id = named.assembly.effects()[place].about().effect;
    let found = scores(&without.assembly, data, &without.fitted.unit, search.settings);
    let price = (named.fitted.rows as f64).ln();
    let parameters = named.fitted.coefficients.len() + named.fitted.unit.len();
    let own = named.fitted.left + price * parameters as f64;
    let mut ids: Vec<&'static str> = Vec::new();
    for candidate in candidates(&without.assembly, data, &without.fitted.unit, &found, REFITTED) {
        let Some(last) = candidate.assembly.effects().last() else { continue };
        let rival = last.about().effect;
        if rival != id && candidate.criterion() <= own + APART && !ids.contains(&rival) {
            ids.push(rival);
        }
    }
    ids
}
