//! An assembly on motions that are a little other than its own.

use std::sync::Arc;

use super::campaign::Campaign;
use super::layout::Assembly;

impl<'a> Assembly<'a> {
    /// The same on a campaign of the same recordings with other motions, at these parameters; what effects see of the
    /// forces changes as the forces do.
    pub(crate) fn on_motions(&self, campaign: &'a Campaign, unit: &[f64], coefficients: &[f64]) -> Self {
        let mut there = Self { campaign, known: None, ..self.clone() };
        let changed = |of: &dyn Fn(&Self, usize) -> Vec<f64>, before: &[Vec<f64>], there: &Self| {
            let one = |r: usize| {
                let change = of(there, r).into_iter().zip(of(self, r)).map(|(after, own)| after - own);
                before[r].iter().zip(change).map(|(force, change)| force + change).collect()
            };
            Arc::new((0..before.len()).map(one).collect::<Vec<Vec<f64>>>())
        };
        let base = |of: &Self, r: usize| of.base_force_in(r, unit, coefficients);
        there.reference = changed(&base, &self.reference, &there);
        if self.effects.is_empty() || self.known_whole_is_reference() {
            there.whole = there.reference.clone();
            return there;
        }
        let whole = |of: &Self, r: usize| of.force_seen(r, unit, coefficients);
        there.whole = changed(&whole, &self.whole, &there);
        there
    }

    fn known_whole_is_reference(&self) -> bool {
        Arc::ptr_eq(&self.whole, &self.reference)
    }
}
