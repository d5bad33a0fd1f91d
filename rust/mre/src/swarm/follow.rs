//! Following behaviour (section 3.1.3): towards the fellow with the most food.

use super::view::{View, attracts};
use super::{FishSettings, Neighbourhood};

/// Where a following fish heads for; `None` where the place is too crowded or there is no fellow.
///
/// `leader` is the fish with the most food of the whole swarm, which is found once for all that follow it.
pub(super) fn target<'a>(
    view: &View<'a>,
    leader: Option<usize>,
    fish: usize,
    settings: &FishSettings,
) -> Option<&'a [f64]> {
    let best = match view.neighbourhood {
        // In a swarm equally fed, the mean may be rounded to more than the leader has.
        Neighbourhood::Swarm if leader == Some(fish) => {
            view.best((0..view.costs.len()).filter(|other| *other != fish))
        }
        Neighbourhood::Swarm => leader,
        Neighbourhood::Visual => view.best(view.within_sight(fish)),
    }?;
    let fellows = view.crowd(fish, settings.crowd);
    attracts(view.costs[best], view.costs[fish], fellows, settings.delta, settings.crowd)
        .then(|| view.position(best))
}
