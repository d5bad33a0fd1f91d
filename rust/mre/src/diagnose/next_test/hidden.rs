//! Effects that the recordings hide: which of them a test would still hide.

use super::excitation::Signal;
use super::world::World;
use crate::assembly::Base;
use crate::diagnose::absorbed::{hidden_among, ids_of};
use crate::diagnose::least_squares::{Data, refine};
use crate::diagnose::monitor::Monitor;
use crate::diagnose::normal::Rows;
use crate::diagnose::null::Null;
use crate::diagnose::screen::Score;
use crate::diagnose::search::Named;
use crate::diagnose::settings::Settings;
use crate::effect::Effect;

/// For each of these effects one where the test shows it, and nothing where it does not.
pub(super) fn shown(
    named: &Named,
    base: &Base,
    hidden: &[&'static str],
    rows: &[Rows],
    settings: &Settings,
    signal: &Signal,
    monitor: &dyn Monitor,
) -> Option<Vec<(&'static str, f64)>> {
    if hidden.is_empty() {
        return Some(Vec::new());
    }
    let (known, model) = (named.assembly.campaign(), named.itself());
    let force = World::new(known, base, signal, None, None)?.simulated(&model)?;
    let world = World::new(known, base, signal, None, Some(force))?;
    let noise = named.noise.with_another_like(0);
    let mut rows = rows.to_vec();
    rows.push(vec![world.test().scored()]);
    let data = Data { noise: &noise, rows: &rows, monitor };
    let assembly = world.assembly(&model);
    let fitted = refine(&assembly, data, &model.fitted.unit);
    let null = Null::new(&assembly, data, &fitted.unit)?;
    let laws: Vec<&'static dyn Effect> =
        settings.laws.iter().copied().filter(|e| hidden.contains(&e.about().effect)).collect();
    let scores: Vec<Score> = laws.iter().filter_map(|law| null.score(*law, settings.seed)).collect();
    let count = ids_of(&named.scores).len();
    let still = hidden_among(&scores, count, world.campaign(), settings.false_alarm);
    let chance = |id: &'static str| if still.iter().any(|h| h.effect == id) { 0.0 } else { 1.0 };
    Some(hidden.iter().map(|id| (*id, chance(id))).collect())
}
