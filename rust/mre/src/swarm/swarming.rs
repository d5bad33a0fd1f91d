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

/// Centres for the fish that want to swarm.
pub(super) fn centres(view: &View, wants: impl Fn(usize) -> bool) -> Centres {
    let mut centres = Centres { rows: Vec::new(), of_fish: vec![None; view.costs.len()] };
    let mut count = 0;
    for fish in (0..view.costs.len()).filter(|fish| wants(*fish)) {
        match view.neighbourhood {
            Neighbourhood::Swarm => {
                if count == 0 {
                    centres.rows = view.centre();
                    count = 1;
                }
                centres.of_fish[fish] = Some(0);
            }
            Neighbourhood::Visual => {
                if let Some(centre) = view.centre_within_sight(fish) {
                    centres.rows.extend(centre);
                    centres.of_fish[fish] = Some(count);
                    count += 1;
                }
            }
        }
    }
    centres
}

impl Centres {
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
