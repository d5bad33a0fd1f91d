//! Effects that fit only where their law ends: the form of what is there is another's.

use std::ops::Range;

use super::intervals::{Estimate, Estimates, estimates};
use super::least_squares::Data;
use super::search::Named;
use crate::assembly::Assembly;

/// True where one of the effects at these places does.
pub(super) fn any_strained(named: &Named, data: Data, mut places: Range<usize>) -> bool {
    if places.is_empty() {
        return false;
    }
    let known = estimates(&named.assembly, data, &named.fitted.unit);
    places.any(|place| !strained(&named.assembly, &known, place).is_empty())
}

/// Symbols of an effect's parameters that the recordings press to the end of their range, or without which the law is
/// that of another effect and which cannot be told from nothing.
pub fn strained<'e>(assembly: &Assembly, estimates: &'e Estimates, place: usize) -> Vec<&'e str> {
    let (coefficients, shapes) = assembly.of_effect(place);
    let own = assembly.effects()[place].own();
    let nothing = |e: &Estimate, none: f64| own == Some(e.name.as_str()) && e.low <= none;
    let absent = estimates.coefficients[coefficients].iter().filter(|e| nothing(e, 0.0));
    let boxes = &assembly.shapes()[shapes.clone()];
    let ends = estimates.shapes[shapes].iter().zip(boxes);
    let at_the_end = ends.filter(|(e, p)| e.pressed || nothing(e, p.lower)).map(|(e, _)| e);
    absent.chain(at_the_end).map(|e| e.name.as_str()).collect()
}
