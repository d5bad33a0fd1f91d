//! Effects that the recordings hide: which of them a test would still hide.

use super::bench::Bench;
use super::imagined::Imagined;
use crate::diagnose::absorbed::Detection;
use crate::diagnose::least_squares::refine;
use crate::diagnose::null::Null;
use crate::diagnose::screen::Score;
use crate::diagnose::search::Named;
use crate::diagnose::settings::Settings;

/// Effects that the recordings hide.
pub(super) struct Hidden<'h> {
    /// Their ids.
    pub(super) ids: &'h [&'static str],
    detection: Detection,
    settings: &'h Settings,
}

impl<'h> Hidden<'h> {
    pub(super) fn new(ids: &'h [&'static str], named: &Named, settings: &'h Settings) -> Self {
        Self { ids, detection: Detection::beside(named, settings.false_alarm), settings }
    }

    /// For each of them one where the test shows it, and nothing where it does not.
    pub(super) fn shown(&self, bench: &Bench, test: &Imagined) -> Option<Vec<(&'static str, f64)>> {
        if self.ids.is_empty() {
            return Some(Vec::new());
        }
        let (model, force) = bench.named(test);
        let world = bench.world(test, Some(force))?;
        let rows = bench.rows_with(&world);
        let data = bench.data(&rows);
        let assembly = world.assembly(model);
        let fitted = refine(&assembly, data, &model.fitted.unit);
        let null = Null::new(&assembly, data, &fitted.unit)?;
        let laws = self.settings.laws.iter().filter(|e| self.ids.contains(&e.about().effect));
        let scores: Vec<Score> = laws.filter_map(|law| null.score(*law, self.settings.seed)).collect();
        let still = self.detection.hidden(&scores, world.campaign());
        let chance = |id: &'static str| if still.iter().any(|h| h.effect == id) { 0.0 } else { 1.0 };
        Some(self.ids.iter().map(|id| (*id, chance(id))).collect())
    }
}
