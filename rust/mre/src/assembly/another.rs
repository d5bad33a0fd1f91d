//! An assembly with one more recording, of which nothing is known yet.

use std::sync::Arc;

use super::base::Base;
use super::campaign::Campaign;
use super::in_series::InSeries;
use super::layout::Assembly;
use super::simulate::{PASSES, distance};

/// Share of a force, rms, by which two that agree differ.
const AGREED: f64 = 1e-6;

impl Assembly<'_> {
    /// The same on a campaign with one recording more at its end, at these parameters, and the base on it; what effects
    /// see of the others stays.
    pub(crate) fn with_another<'w>(
        &self,
        (campaign, base): (&'w Campaign, &'w Base),
        unit: &[f64],
        coefficients: &[f64],
    ) -> Assembly<'w> {
        let last = campaign.recordings().len() - 1;
        let nothing = vec![0.0; campaign.recordings()[last].len()];
        let (mut reference, mut whole) = ((*self.reference).clone(), (*self.whole).clone());
        reference.push(nothing.clone());
        whole.push(nothing);
        let mut wider = Assembly::new(campaign, base, self.effects.clone(), Arc::new(reference));
        let alone = wider.base_force_in(last, unit, coefficients);
        let flexibility = wider.flexibility(&wider.physical(unit));
        whole[last] = InSeries::first(&campaign.recordings()[last], &alone, flexibility.unwrap_or_default());
        // Nothing else holds them yet.
        Arc::make_mut(&mut wider.reference)[last] = alone;
        wider.whole = Arc::new(whole);
        for _ in 0..PASSES {
            let force = wider.force_seen(last, unit, coefficients);
            let off = distance(&wider.whole[last], &force);
            Arc::make_mut(&mut wider.whole)[last] = force;
            if flexibility.is_none() || off <= AGREED {
                break;
            }
        }
        wider
    }
}
