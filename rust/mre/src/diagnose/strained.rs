//! Effects that fit only where their law ends: the form of what is there is another's.

use std::ops::Range;

use super::intervals::{Estimate, Estimates, estimates};
use super::least_squares::Data;
use super::search::Named;
use crate::assembly::Assembly;
use crate::parameter::Parameter;

/// A moment whose interval is a larger share of its range is none.
const ADRIFT: f64 = 0.5;

/// True where one of the effects at these places does.
pub(super) fn any_strained(named: &Named, data: Data, mut places: Range<usize>) -> bool {
    if places.is_empty() {
        return false;
    }
    let known = estimates(&named.assembly, data, &named.fitted.unit);
    places.any(|place| !strained(&named.assembly, &known, place).is_empty())
}

/// Symbols of an effect's parameters that the recordings press to the end of their range, or without which the law is
/// that of another effect and which cannot be told from nothing, or of a moment that may lie between two recordings.
pub fn strained<'e>(assembly: &Assembly, estimates: &'e Estimates, place: usize) -> Vec<&'e str> {
    let effect = assembly.effects()[place];
    // A hum goes on whatever moves: it stands for no other effect.
    if !effect.follows_the_motion() {
        return Vec::new();
    }
    let (coefficients, shapes) = assembly.of_effect(place);
    let nothing = |e: &Estimate, none: f64| effect.own() == Some(e.name.as_str()) && e.low <= none;
    let absent = estimates.coefficients[coefficients].iter().filter(|e| nothing(e, 0.0));
    let boxes = &assembly.shapes()[shapes.clone()];
    let ends = estimates.shapes[shapes.clone()].iter().zip(boxes);
    // The interval of one at its end is open on both sides: as much of it as there can be is not nothing.
    let shapeless =
        |(e, p): &(&Estimate, &Parameter)| e.at_an_end || (e.value < p.upper && nothing(e, p.lower));
    // A change at any moment is no change at one, and between two recordings more changes than the device.
    let values: Vec<f64> = estimates.shapes[shapes.clone()].iter().map(|e| e.value).collect();
    let moment = effect.moment(&values);
    let campaign = assembly.campaign();
    let begins = |from: f64, to: f64| {
        (0..campaign.recordings().len()).any(|r| (from..=to).contains(&campaign.before(r)))
    };
    let no_moment = |(e, p): &(&Estimate, &Parameter)| {
        moment.filter(|(from, _)| *from == e.value).is_some_and(|(_, to)| {
            e.high - e.low > ADRIFT * (p.upper - p.lower) || begins(e.low, e.high.max(to))
        })
    };
    let spoken = ends.filter(|end| shapeless(end) || no_moment(end)).map(|(e, _)| e);
    absent.chain(spoken).map(|e| e.name.as_str()).collect()
}
