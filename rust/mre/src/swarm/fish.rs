//! The artificial fish swarm: AFSA (section 3.1 of the paper) and MAFSA (section 3.2), which differ in
//! their settings.

use super::random::{around, towards};
use super::search::{self, Outcome, Wait};
use super::swarming::{self, Centres};
use super::view::{View, food};
use super::{Behaviours, Bulletin, FishSettings, History, Stream, Swarm, follow};
use crate::error::Result;

/// What the rows asked for are.
#[derive(Debug, Clone)]
enum Stage {
    /// The initial positions.
    Hatch,
    /// Centres that swarming fish think of heading for.
    Centres(Centres),
    /// Looks and arrivals, fish by fish.
    Acts(Vec<(usize, Wait)>),
}

/// A swarm of artificial fish.
#[derive(Debug, Clone)]
pub struct FishSwarm {
    settings: FishSettings,
    dimension: usize,
    streams: Vec<Stream>,
    positions: Vec<f64>,
    costs: Vec<f64>,
    visual: f64,
    step: f64,
    iteration: usize,
    stage: Stage,
    rows: Vec<f64>,
    bulletin: Bulletin,
    history: History,
    behaviours: Behaviours,
}

impl FishSwarm {
    /// A swarm at random positions; the first fish stands at `start` if one is given.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(settings: FishSettings, dimension: usize, seed: u64, start: Option<&[f64]>) -> Result<Self> {
        settings.check()?;
        let mut streams: Vec<Stream> = (0..settings.fish).map(|fish| Stream::new(seed, fish)).collect();
        let mut rows: Vec<f64> = streams
            .iter_mut()
            .flat_map(|stream| (0..dimension).map(|_| stream.uniform()).collect::<Vec<_>>())
            .collect();
        if let Some(start) = start {
            rows[..dimension].copy_from_slice(start);
        }
        Ok(Self {
            positions: rows.clone(),
            costs: vec![f64::INFINITY; settings.fish],
            visual: settings.visual,
            step: settings.step,
            iteration: 0,
            stage: Stage::Hatch,
            rows,
            bulletin: Bulletin::new(dimension),
            history: History::default(),
            behaviours: Behaviours::default(),
            settings,
            dimension,
            streams,
        })
    }

    fn view(&self) -> View<'_> {
        View {
            positions: &self.positions,
            costs: &self.costs,
            dimension: self.dimension,
            visual: self.visual,
            neighbourhood: self.settings.neighbourhood,
        }
    }

    /// Mean energy of the swarm, eq. 7.
    fn mean_food(&self) -> f64 {
        self.costs.iter().map(|cost| food(*cost)).sum::<f64>() / self.costs.len() as f64
    }

    fn begin_iteration(&mut self) {
        self.history.record(&self.bulletin, &self.costs, self.visual, self.step);
        self.rows.clear();
        if self.iteration == self.settings.iterations {
            return;
        }
        self.iteration += 1;
        (self.visual, self.step) = self.settings.schedule.next(
            self.iteration,
            self.settings.iterations,
            (self.settings.visual, self.settings.step),
            (self.visual, self.step),
        );
        let mean = self.mean_food();
        let centres = swarming::centres(&self.view(), |fish| food(self.costs[fish]) > mean);
        if centres.rows.is_empty() {
            self.choose(&centres, &[]);
        } else {
            self.rows.extend_from_slice(&centres.rows);
            self.stage = Stage::Centres(centres);
        }
    }

    /// Every fish chooses its behaviour by its energy (section 3.1.4).
    fn choose(&mut self, centres: &Centres, centre_costs: &[f64]) {
        let mean = self.mean_food();
        let mut acts = Vec::with_capacity(self.settings.fish);
        self.rows.clear();
        for fish in 0..self.settings.fish {
            let own = food(self.costs[fish]);
            let view = self.view();
            let target = if own < mean {
                follow::target(&view, fish, &self.settings).map(<[f64]>::to_vec)
            } else {
                centres.target(&view, centre_costs, fish, &self.settings).map(<[f64]>::to_vec)
            };
            if let Some(target) = target {
                let counter =
                    if own < mean { &mut self.behaviours.follow } else { &mut self.behaviours.swarm };
                *counter += 1;
                self.go_towards(fish, &target);
                acts.push((fish, Wait::Arrival));
            } else {
                let wait = search::first_round(&self.settings);
                self.look(fish, wait);
                acts.push((fish, wait));
            }
        }
        self.stage = Stage::Acts(acts);
    }

    fn position(&self, fish: usize) -> std::ops::Range<usize> {
        fish * self.dimension..(fish + 1) * self.dimension
    }

    fn look(&mut self, fish: usize, wait: Wait) {
        if let Wait::Looks { count, .. } = wait {
            let own = &self.positions[self.position(fish)];
            for _ in 0..count {
                around(own, self.visual, &mut self.streams[fish], &mut self.rows);
            }
        }
    }

    fn go_towards(&mut self, fish: usize, target: &[f64]) {
        let own = &self.positions[self.position(fish)];
        towards(own, target, self.step, &mut self.streams[fish], &mut self.rows);
    }

    /// Fish that know their costs move, look again, or are done.
    fn act(&mut self, acts: &[(usize, Wait)], costs: &[f64]) {
        let rows = std::mem::take(&mut self.rows);
        let mut next = Vec::new();
        let mut row = 0;
        for &(fish, wait) in acts {
            let Wait::Looks { count, before } = wait else {
                self.stand(fish, &rows[row * self.dimension..], costs[row]);
                row += 1;
                continue;
            };
            let at = |look: usize| &rows[(row + look) * self.dimension..(row + look + 1) * self.dimension];
            match search::judge(&costs[row..row + count], before, self.costs[fish], &self.settings) {
                Outcome::Jump(look) => {
                    self.behaviours.search += 1;
                    self.stand(fish, at(look), costs[row + look]);
                }
                Outcome::StepTowards(look) => {
                    self.behaviours.search += 1;
                    self.go_towards(fish, at(look));
                    next.push((fish, Wait::Arrival));
                }
                Outcome::LookAgain => {
                    let wait = Wait::Looks { count, before: before + count };
                    self.look(fish, wait);
                    next.push((fish, wait));
                }
                Outcome::GiveUp => {
                    self.behaviours.random += 1;
                    let own = &self.positions[self.position(fish)];
                    around(own, self.step, &mut self.streams[fish], &mut self.rows);
                    next.push((fish, Wait::Arrival));
                }
            }
            row += count;
        }
        if next.is_empty() {
            self.begin_iteration();
        } else {
            self.stage = Stage::Acts(next);
        }
    }

    fn stand(&mut self, fish: usize, place: &[f64], cost: f64) {
        let range = self.position(fish);
        self.positions[range].copy_from_slice(&place[..self.dimension]);
        self.costs[fish] = cost;
    }
}

impl Swarm for FishSwarm {
    fn ask(&self) -> &[f64] {
        &self.rows
    }

    fn tell(&mut self, costs: &[f64]) {
        let costs: Vec<f64> = costs.iter().map(|c| if c.is_nan() { f64::INFINITY } else { *c }).collect();
        self.bulletin.note(&self.rows, &costs);
        match std::mem::replace(&mut self.stage, Stage::Hatch) {
            Stage::Hatch => {
                self.costs = costs;
                self.begin_iteration();
            }
            Stage::Centres(centres) => self.choose(&centres, &costs),
            Stage::Acts(acts) => self.act(&acts, &costs),
        }
    }

    fn tell_some(&mut self, costs: &[f64]) {
        self.bulletin.note(&self.rows[..costs.len() * self.dimension], costs);
    }

    fn finished(&self) -> bool {
        self.rows.is_empty()
    }

    fn bulletin(&self) -> &Bulletin {
        &self.bulletin
    }

    fn history(&self) -> &History {
        &self.history
    }

    fn behaviours(&self) -> Behaviours {
        self.behaviours
    }
}
