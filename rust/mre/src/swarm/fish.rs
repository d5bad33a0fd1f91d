//! The artificial fish swarm: AFSA (section 3.1 of the paper) and MAFSA (section 3.2), which differ in
//! their settings.

use super::random::{around, towards};
use super::search::{self, Outcome, Wait};
use super::swarming::Centres;
use super::view::{View, food};
use super::{Behaviours, Bulletin, FishSettings, History, Stream, Swarm, follow};
use crate::error::Result;

/// What the rows asked for are.
#[derive(Debug, Clone, Copy)]
enum Stage {
    /// The initial positions.
    Hatch,
    /// Centres that swarming fish think of heading for.
    Centres,
    /// Looks and arrivals, fish by fish.
    Acts,
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
    /// Fish that wait for costs, in the order of the rows.
    waiting: Vec<(usize, Wait)>,
    centres: Centres,
    /// Buffers, so that iterations do not allocate: rows, fish and costs while they are worked on.
    told: Vec<f64>,
    waited: Vec<(usize, Wait)>,
    known: Vec<f64>,
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
        let positions = rows.clone();
        let room = settings.fish * search::most_rows(&settings);
        rows.reserve_exact(room * dimension - rows.len());
        Ok(Self {
            positions,
            costs: vec![f64::INFINITY; settings.fish],
            visual: settings.visual,
            step: settings.step,
            iteration: 0,
            stage: Stage::Hatch,
            rows,
            told: Vec::with_capacity(room * dimension),
            waiting: Vec::with_capacity(settings.fish),
            waited: Vec::with_capacity(settings.fish),
            centres: Centres::default(),
            known: Vec::with_capacity(room),
            bulletin: Bulletin::new(dimension),
            history: History::with_room(settings.iterations),
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
        let mut centres = std::mem::take(&mut self.centres);
        centres.find(&self.view(), |fish| food(self.costs[fish]) > mean);
        self.rows.extend_from_slice(&centres.rows);
        self.centres = centres;
        if self.rows.is_empty() {
            self.choose(&[]);
        } else {
            self.stage = Stage::Centres;
        }
    }

    /// Every fish chooses its behaviour by its energy (section 3.1.4).
    fn choose(&mut self, centre_costs: &[f64]) {
        let mean = self.mean_food();
        let mut rows = std::mem::take(&mut self.rows);
        rows.clear();
        self.waiting.clear();
        for fish in 0..self.settings.fish {
            let follows = food(self.costs[fish]) < mean;
            let view = View {
                positions: &self.positions,
                costs: &self.costs,
                dimension: self.dimension,
                visual: self.visual,
                neighbourhood: self.settings.neighbourhood,
            };
            let target = if follows {
                follow::target(&view, fish, &self.settings)
            } else {
                self.centres.target(&view, centre_costs, fish, &self.settings)
            };
            let wait = if let Some(target) = target {
                let counter = if follows { &mut self.behaviours.follow } else { &mut self.behaviours.swarm };
                *counter += 1;
                towards(view.position(fish), target, self.step, &mut self.streams[fish], &mut rows);
                Wait::Arrival
            } else {
                let wait = search::first_round(&self.settings);
                look(wait, view.position(fish), self.visual, &mut self.streams[fish], &mut rows);
                wait
            };
            self.waiting.push((fish, wait));
        }
        self.rows = rows;
        self.stage = Stage::Acts;
    }

    fn position(&self, fish: usize) -> std::ops::Range<usize> {
        fish * self.dimension..(fish + 1) * self.dimension
    }

    /// Fish that know their costs move, look again, or are done.
    fn act(&mut self, costs: &[f64]) {
        std::mem::swap(&mut self.rows, &mut self.told);
        std::mem::swap(&mut self.waiting, &mut self.waited);
        self.rows.clear();
        self.waiting.clear();
        let (told, waited) = (std::mem::take(&mut self.told), std::mem::take(&mut self.waited));
        let mut row = 0;
        for &(fish, wait) in &waited {
            let Wait::Looks { count, before } = wait else {
                self.stand(fish, &told[row * self.dimension..], costs[row]);
                row += 1;
                continue;
            };
            let at = |look: usize| &told[(row + look) * self.dimension..(row + look + 1) * self.dimension];
            let outcome = search::judge(&costs[row..row + count], before, self.costs[fish], &self.settings);
            let own = &self.positions[self.position(fish)];
            let (stream, rows) = (&mut self.streams[fish], &mut self.rows);
            let next = match outcome {
                Outcome::Jump(look) => {
                    self.behaviours.search += 1;
                    self.stand(fish, at(look), costs[row + look]);
                    None
                }
                Outcome::StepTowards(look) => {
                    self.behaviours.search += 1;
                    towards(own, at(look), self.step, stream, rows);
                    Some(Wait::Arrival)
                }
                Outcome::LookAgain => {
                    let wait = Wait::Looks { count, before: before + count };
                    look(wait, own, self.visual, stream, rows);
                    Some(wait)
                }
                Outcome::GiveUp => {
                    self.behaviours.random += 1;
                    around(own, self.step, stream, rows);
                    Some(Wait::Arrival)
                }
            };
            self.waiting.extend(next.map(|wait| (fish, wait)));
            row += count;
        }
        (self.told, self.waited) = (told, waited);
        if self.waiting.is_empty() {
            self.begin_iteration();
        }
    }

    fn stand(&mut self, fish: usize, place: &[f64], cost: f64) {
        let range = self.position(fish);
        self.positions[range].copy_from_slice(&place[..self.dimension]);
        self.costs[fish] = cost;
    }
}

/// Looks of one fish, if it waits for some.
fn look(wait: Wait, own: &[f64], visual: f64, stream: &mut Stream, rows: &mut Vec<f64>) {
    if let Wait::Looks { count, .. } = wait {
        for _ in 0..count {
            around(own, visual, stream, rows);
        }
    }
}

impl Swarm for FishSwarm {
    fn ask(&self) -> &[f64] {
        &self.rows
    }

    fn tell(&mut self, costs: &[f64]) {
        let mut known = std::mem::take(&mut self.known);
        known.clear();
        known.extend(costs.iter().map(|c| if c.is_nan() { f64::INFINITY } else { *c }));
        self.bulletin.note(&self.rows, &known);
        match self.stage {
            Stage::Hatch => {
                self.costs.copy_from_slice(&known);
                self.begin_iteration();
            }
            Stage::Centres => self.choose(&known),
            Stage::Acts => self.act(&known),
        }
        self.known = known;
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
