//! Following behaviour (section 3.1.3): towards the fellow with the most food.

use super::FishSettings;
use super::view::{View, attracts};

/// Where a following fish heads for; `None` where the place is too crowded or there is no fellow.
pub(super) fn target<'a>(view: &View<'a>, fish: usize, settings: &FishSettings) -> Option<&'a [f64]> {
    let best = view.best(fish)?;
    let fellows = view.crowd(fish, settings.crowd);
    attracts(view.costs[best], view.costs[fish], fellows, settings.delta, settings.crowd)
        .then(|| view.position(best))
}
