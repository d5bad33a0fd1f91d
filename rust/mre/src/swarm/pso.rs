//! Particle swarm optimisation with inertia weight (Shi and Eberhart 1998,
//! <https://doi.org/10.1109/ICEC.1998.699146>).
//!
//! A particle that would leave the box stops at its wall and loses its speed across it.

use super::{Bulletin, History, PsoSettings, Stream, Swarm};
use crate::error::Result;

/// A swarm of particles.
#[derive(Debug, Clone)]
pub struct ParticleSwarm {
    settings: PsoSettings,
    dimension: usize,
    streams: Vec<Stream>,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    best_positions: Vec<f64>,
    best_costs: Vec<f64>,
    iteration: usize,
    finished: bool,
    /// Costs told last, NaN replaced.
    known: Vec<f64>,
    bulletin: Bulletin,
    history: History,
}

impl ParticleSwarm {
    /// A swarm at random positions with random velocities; the first particle stands at `start` if one
    /// is given.
    ///
    /// # Errors
    /// A setting outside its range.
    pub fn new(settings: PsoSettings, dimension: usize, seed: u64, start: Option<&[f64]>) -> Result<Self> {
        settings.check()?;
        let mut streams: Vec<Stream> = (0..settings.particles).map(|p| Stream::new(seed, p)).collect();
        let (mut positions, mut velocities) = (Vec::new(), Vec::new());
        for stream in &mut streams {
            positions.extend((0..dimension).map(|_| stream.uniform()));
            velocities.extend((0..dimension).map(|_| settings.speed * stream.symmetric()));
        }
        if let Some(start) = start {
            positions[..dimension].copy_from_slice(start);
        }
        Ok(Self {
            best_positions: positions.clone(),
            best_costs: vec![f64::INFINITY; settings.particles],
            iteration: 0,
            finished: false,
            known: Vec::new(),
            bulletin: Bulletin::new(dimension),
            history: History::with_room(settings.iterations),
            settings,
            dimension,
            streams,
            positions,
            velocities,
        })
    }

    fn inertia(&self) -> f64 {
        let [start, end] = self.settings.inertia;
        let share = if self.settings.iterations > 1 {
            (self.iteration as f64 - 1.0) / (self.settings.iterations as f64 - 1.0)
        } else {
            0.0
        };
        start + (end - start) * share.max(0.0)
    }

    fn fly(&mut self) {
        let (inertia, d) = (self.inertia(), self.dimension);
        let PsoSettings { cognitive, social, speed, .. } = self.settings;
        for (particle, stream) in self.streams.iter_mut().enumerate() {
            for k in 0..d {
                let i = particle * d + k;
                let own = cognitive * stream.uniform() * (self.best_positions[i] - self.positions[i]);
                let all = social * stream.uniform() * (self.bulletin.position[k] - self.positions[i]);
                let velocity = (inertia * self.velocities[i] + own + all).clamp(-speed, speed);
                let wished = self.positions[i] + velocity;
                self.positions[i] = wished.clamp(0.0, 1.0);
                self.velocities[i] = if self.positions[i] == wished { velocity } else { 0.0 };
            }
        }
    }
}

impl Swarm for ParticleSwarm {
    fn asked(&self) -> usize {
        if self.finished { 0 } else { self.settings.particles }
    }

    fn ask(&mut self) -> &[f64] {
        if self.finished { &[] } else { &self.positions }
    }

    fn tell(&mut self, costs: &[f64]) {
        let mut known = std::mem::take(&mut self.known);
        known.clear();
        known.extend(costs.iter().map(|c| if c.is_finite() { *c } else { f64::INFINITY }));
        self.bulletin.note(&self.positions, &known);
        for (particle, cost) in known.iter().enumerate() {
            if *cost < self.best_costs[particle] {
                self.best_costs[particle] = *cost;
                let range = particle * self.dimension..(particle + 1) * self.dimension;
                self.best_positions[range.clone()].copy_from_slice(&self.positions[range]);
            }
        }
        self.history.record(&self.bulletin, &known, self.inertia(), self.settings.speed);
        self.known = known;
        if self.iteration == self.settings.iterations {
            self.finished = true;
        } else {
            self.iteration += 1;
            self.fly();
        }
    }

    fn tell_some(&mut self, costs: &[f64]) {
        self.bulletin.note(&self.positions[..costs.len() * self.dimension], costs);
    }

    fn finished(&self) -> bool {
        self.finished
    }

    fn bulletin(&self) -> &Bulletin {
        &self.bulletin
    }

    fn history(&self) -> &History {
        &self.history
    }
}
