//! Swarming behaviour (section 3.1.2): towards the centre of the fellows.

use super::view::{View, attracts};
use super::{FishSettings, Neighbourhood};

/// The centres whose costs have to be known, and which of them each fish would head for.
#[derive(Debug, Clone, Default)]
pub(super) struct Centres {
    /// Centres, one row each.
    pub(super) rows: Vec<f64>,
    /// Row of each fish; `None` for a fish that does not swarm or has no fellow.
    pub(super) of_fish: Vec<Option<usize>>,
}

impl Centres {
    /// Centres for the fish that want to swarm, in place of those before.
    pub(super) fn find(&mut self, view: &View, wants: impl Fn(usize) -> bool) {
        self.rows.clear();
        self.rows.reserve(view.positions.len());
        self.of_fish.clear();
        self.of_fish.resize(view.costs.len(), None);
        let mut count = 0;
        for fish in (0..view.costs.len()).filter(|fish| wants(*fish)) {
            match view.neighbourhood {
                Neighbourhood::Swarm => {
                    if count == 0 {
                        view.push_centre(&mut self.rows);
                        count = 1;
                    }
                    self.of_fish[fish] = Some(0);
                }
                Neighbourhood::Visual => {
                    if view.push_centre_within_sight(fish, &mut self.rows) {
                        self.of_fish[fish] = Some(count);
                        count += 1;
                    }
                }
            }
        }
    }

    /// Where a swarming fish heads for; `None` where the place is too crowded or there is no fellow.
    pub(super) fn target(
        &self,
        view: &View,
        costs: &[f64],
        fish: usize,
        settings: &FishSettings,
    ) -> Option<&[f64]> {
        let row = self.of_fish[fish]?;
        let fellows = view.crowd(fish, settings.crowd);
        attracts(costs[row], view.costs[fish], fellows, settings.delta, settings.crowd)
            .then(|| &self.rows[row * view.dimension..(row + 1) * view.dimension])
    }
}
