//! The artificial fish swarm: AFSA (section 3.1 of the paper) and MAFSA (section 3.2), which differ in
//! their settings.

use super::batch::Batch;
use super::random::{around, towards};
use super::search::{self, Outcome, Wait};
use super::swarming::Centres;
use super::view::{View, food};
use super::{Behaviours, Bulletin, FishSettings, History, Shared, Stream, Swarm, follow};
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
    /// What is asked for; of the centres nobody waits for the rows.
    asked: Batch,
    centres: Centres,
    /// Buffers, so that iterations do not allocate: a batch and costs while they are worked on.
    told: Batch,
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
        let mut positions = vec![0.0; settings.fish * dimension];
        for (stream, position) in streams.iter_mut().zip(positions.chunks_exact_mut(dimension)) {
            stream.fill(position);
        }
        if let Some(start) = start {
            positions[..dimension].copy_from_slice(start);
        }
        let room = settings.fish * search::first_round(&settings).rows();
        let mut asked = Batch::with_room(settings.fish, room, dimension);
        asked.extend(&positions);
        Ok(Self {
            positions,
            costs: vec![f64::INFINITY; settings.fish],
            visual: settings.visual,
            step: settings.step,
            iteration: 0,
            stage: Stage::Hatch,
            asked,
            told: Batch::with_room(settings.fish, room, dimension),
            centres: Centres::default(),
            known: Vec::with_capacity(settings.fish),
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

    /// Work on what is asked for, beside the swarm as it stands.
    fn with_batch(&mut self, work: impl FnOnce(&mut Batch, &View, &mut [Stream])) {
        let (mut asked, mut streams) = (std::mem::take(&mut self.asked), std::mem::take(&mut self.streams));
        work(&mut asked, &self.view(), &mut streams);
        (self.asked, self.streams) = (asked, streams);
    }

    /// Mean energy of the swarm, eq. 7.
    fn mean_food(&self) -> f64 {
        self.costs.iter().map(|cost| food(*cost)).sum::<f64>() / self.costs.len() as f64
    }

    fn begin_iteration(&mut self) {
        self.history.record(&self.bulletin, &self.costs, self.visual, self.step);
        self.asked.clear();
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
        self.asked.extend(&centres.rows);
        self.centres = centres;
        if self.asked.count() == 0 {
            self.choose(&[]);
        } else {
            self.stage = Stage::Centres;
        }
    }

    /// Every fish chooses its behaviour by its energy (section 3.1.4).
    fn choose(&mut self, centre_costs: &[f64]) {
        let mean = self.mean_food();
        let (mut asked, mut streams) = (std::mem::take(&mut self.asked), std::mem::take(&mut self.streams));
        asked.clear();
        let leader = self.view().best(0..self.settings.fish);
        for (fish, stream) in streams.iter_mut().enumerate() {
            let follows = food(self.costs[fish]) < mean;
            let view = self.view();
            let target = if follows {
                follow::target(&view, leader, fish, &self.settings)
            } else {
                self.centres.target(&view, centre_costs, fish, &self.settings)
            };
            if let Some(target) = target {
                let place = asked.add(fish, Wait::Arrival);
                towards(view.position(fish), target, self.step, stream, place);
                let counter = if follows { &mut self.behaviours.follow } else { &mut self.behaviours.swarm };
                *counter += 1;
            } else {
                asked.add(fish, search::first_round(&self.settings));
            }
        }
        (self.asked, self.streams) = (asked, streams);
        self.stage = Stage::Acts;
    }

    fn position(&self, fish: usize) -> std::ops::Range<usize> {
        fish * self.dimension..(fish + 1) * self.dimension
    }

    /// Fish that know their costs move, look again, or are done.
    fn act(&mut self, costs: &[f64]) {
        self.asked.see(costs);
        std::mem::swap(&mut self.asked, &mut self.told);
        let (mut asked, mut streams) = (std::mem::take(&mut self.asked), std::mem::take(&mut self.streams));
        let told = std::mem::take(&mut self.told);
        asked.clear();
        for (fish, wait, rows, seen) in told.with_what_was_seen() {
            self.bulletin.note_seen(rows, seen);
            let Wait::Looks { count, before } = wait else {
                self.stand(fish, rows, seen.least);
                continue;
            };
            let at = |look: usize| &rows[look * self.dimension..(look + 1) * self.dimension];
            let own = &self.positions[self.position(fish)];
            match search::judge(seen, before, count, self.costs[fish], &self.settings) {
                Outcome::Jump(look) => {
                    self.behaviours.search += 1;
                    self.stand(fish, at(look), seen.least);
                }
                Outcome::StepTowards(look) => {
                    self.behaviours.search += 1;
                    let place = asked.add(fish, Wait::Arrival);
                    towards(own, at(look), self.step, &mut streams[fish], place);
                }
                Outcome::LookAgain => {
                    asked.add(fish, Wait::Looks { count, before: before + count });
                }
                Outcome::GiveUp => {
                    self.behaviours.random += 1;
                    around(own, self.step, &mut streams[fish], asked.add(fish, Wait::Arrival));
                }
            }
        }
        (self.asked, self.told, self.streams) = (asked, told, streams);
        if self.asked.is_empty() {
            self.begin_iteration();
        }
    }

    fn stand(&mut self, fish: usize, place: &[f64], cost: f64) {
        let range = self.position(fish);
        self.positions[range].copy_from_slice(&place[..self.dimension]);
        self.costs[fish] = cost;
    }
}

impl Swarm for FishSwarm {
    fn asked(&self) -> usize {
        self.asked.count()
    }

    fn ask(&mut self) -> &[f64] {
        self.with_batch(Batch::draw);
        self.asked.rows()
    }

    fn ask_and_evaluate(&mut self, fitness: &dyn Shared, costs: &mut [f64]) {
        self.with_batch(|asked, view, streams| asked.evaluate(view, streams, fitness, costs));
    }

    fn tell(&mut self, costs: &[f64]) {
        // Costs of points that nobody has asked for yet: of a run that is repeated.
        self.with_batch(Batch::draw);
        if let Stage::Acts = self.stage {
            self.act(costs);
            return;
        }
        let mut known = std::mem::take(&mut self.known);
        known.clear();
        known.extend(costs.iter().map(|c| if c.is_finite() { *c } else { f64::INFINITY }));
        self.bulletin.note(self.asked.rows(), &known);
        if let Stage::Hatch = self.stage {
            self.costs.copy_from_slice(&known);
            self.begin_iteration();
        } else {
            self.choose(&known);
        }
        self.known = known;
    }

    fn tell_some(&mut self, costs: &[f64]) {
        self.asked.forget();
        self.bulletin.note(&self.asked.rows()[..costs.len() * self.dimension], costs);
    }

    fn finished(&self) -> bool {
        self.asked.count() == 0
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
