//! Moments at which effects that were named happen, among the places where the mismatch is: a joint fit finds
//! them more exactly than columns beside a base that has bent.

use super::locate::{Finding, MOMENTS, MOST, Place, overlap};
use super::search::{Named, Search};
use crate::assembly::Assembly;

/// Places with those of named effects instead of what they overlap, strongest first.
pub(super) fn with_moments(mut places: Vec<Finding>, search: &Search, named: &Named) -> Vec<Finding> {
    for place in search.given()..named.assembly.effects().len() {
        let Some(at) = moment(&named.assembly, &named.fitted.unit, place) else { continue };
        let gain = search.drop(named, place).fitted.left - named.fitted.left;
        if gain <= 0.0 {
            continue;
        }
        let found = Finding { place: at, strength: gain.sqrt() };
        places.retain(|other| !overlap(&other.place, &found.place));
        let before = places.partition_point(|other| other.strength > found.strength);
        places.insert(before, found);
        places.truncate(MOST);
    }
    places
}

/// When an effect of a model happens, if its parameters tell, in its recording.
fn moment(assembly: &Assembly, unit: &[f64], place: usize) -> Option<Place> {
    let campaign = assembly.campaign();
    let shapes = assembly.physical(unit);
    let widths = assembly.effects().iter().map(|e| e.shape(campaign.sizes()).len());
    let skipped: usize = assembly.base_shapes() + widths.take(place).sum::<usize>();
    let (from, to) = assembly.effects()[place].moment(&shapes[skipped..])?;
    let recordings = campaign.recordings();
    let r = (0..recordings.len()).rfind(|r| campaign.before(*r) <= from)?;
    let time = recordings[r].time();
    let (first, last) = (time[0], time[time.len() - 1]);
    let around = (last - first) / MOMENTS as f64;
    let own = |t: f64| (first + t - campaign.before(r)).clamp(first, last);
    let place = Place::Time { recording: r, from: own(from - around), to: own(to + around) };
    (from - campaign.before(r) < last - first).then_some(place)
}
