//! Models that are in doubt, on an imagined test.

use rayon::prelude::*;

use super::doubt::{Doubt, Member, Told, told};
use super::excitation::{Kind, Signal};
use super::limits::Limits;
use super::truth::{Truth, truths};
use super::view::{Held, View};
use super::world::World;
use crate::assembly::Base;
use crate::diagnose::candidates::Candidate;
use crate::diagnose::joint::{begun_anew, fit};
use crate::diagnose::least_squares::Data;
use crate::diagnose::monitor::Monitor;
use crate::diagnose::noise::Noise;
use crate::diagnose::normal::Rows;
use crate::diagnose::search::Named;

/// Samples of the fastest cycle of a device that moves on between the samples of a recording.
const FINE: f64 = 100.0;
/// Most such samples for each of the recording.
const FINEST: f64 = 8.0;

/// The models, and what the recordings know of them.
pub(super) struct Bench<'b, 'a> {
    base: &'b Base,
    rows: &'b [Rows],
    monitor: &'b dyn Monitor,
    /// Of the recordings and of the test.
    noise: Noise,
    models: Vec<Candidate<'a>>,
    /// What may stand in each place in doubt.
    places: Vec<Vec<Member>>,
    /// What may be true, the model named at its best fit first.
    truths: Vec<Truth<'a>>,
    held: Vec<Held>,
}

/// A test as it is imagined: each model that may be true moves finely, and is seen at the samples of a recording.
pub(super) struct Imagined {
    signal: Signal,
    velocity: Option<Vec<f64>>,
    /// Force in N of each of [`Bench::truths`].
    forces: Vec<Vec<f64>>,
}

impl<'b, 'a> Bench<'b, 'a> {
    pub(super) fn new(
        named: &Named<'a>,
        base: &'b Base,
        doubt: &Doubt<'a>,
        rows: &'b [Rows],
        monitor: &'b dyn Monitor,
    ) -> Self {
        let models = doubt.models(named);
        let data = Data { noise: &named.noise, rows, monitor };
        let held: Vec<Held> = models.par_iter().map(|model| Held::of(model, data)).collect();
        let places = doubt.places(named, &criteria(&models));
        let lacks = |model: usize| models[model].fitted.beyond_chance();
        let in_doubt = places.iter().flatten().flat_map(|member| member.may_be_true(lacks));
        let mut true_ones: Vec<(usize, f64)> = std::iter::once((0, 1.0)).chain(in_doubt).collect();
        true_ones.sort_by_key(|(model, _)| *model);
        true_ones.dedup_by_key(|(model, _)| *model);
        let truths =
            true_ones.par_iter().flat_map(|(i, share)| truths(*i, *share, &models[*i], &held[*i], data));
        let truths = truths.collect();
        let noise = named.noise.with_another_like(0);
        Self { base, rows, monitor, noise, models, places, truths, held }
    }

    /// A test; `None` where the limits leave no room for it, or a model cannot follow it.
    pub(super) fn imagine(&self, kind: Kind, limits: &Limits) -> Option<Imagined> {
        let times = (FINE * limits.highest / limits.rate).clamp(1.0, FINEST).ceil();
        let fine = kind.signal(&Limits { rate: times * limits.rate, ..limits.clone() })?;
        let known = self.models[0].assembly.campaign();
        let world = World::new(known, self.base, &fine, None, None)?;
        let every = |series: &[f64]| series.iter().step_by(times as usize).copied().collect::<Vec<f64>>();
        let forces = self
            .truths
            .par_iter()
            .map(|truth| world.simulated(&truth.candidate).map(|force| every(&force)))
            .collect::<Option<Vec<Vec<f64>>>>()?;
        // A velocity that was recorded will be again.
        let derived = known.recordings()[0].velocity_window().is_some();
        let velocity = (!derived).then(|| every(world.test().velocity()));
        let signal = Signal {
            time: every(&fine.time),
            displacement: every(&fine.displacement),
            current: fine.current.as_deref().map(every),
            ..fine
        };
        self.monitor.whole(Imagined { signal, velocity, forces })
    }

    /// What the test tells to first order: every model bends as far as the recordings let it.
    pub(super) fn glance(&self, test: &Imagined) -> Option<Told> {
        let world = self.world(test, None)?;
        let views: Vec<View> = self
            .models
            .par_iter()
            .zip(&self.held)
            .map(|(model, held)| View::new(&world, model, held, &self.noise))
            .collect();
        let seen: Vec<Vec<f64>> =
            self.truths.par_iter().map(|truth| world.simulated(&truth.candidate)).collect::<Option<_>>()?;
        let more = (self.known_samples() + test.signal.time.len()) as f64 / self.known_samples() as f64;
        let criterion = |t: usize, model: usize| {
            let fitted = &self.models[model].fitted;
            let price = fitted.parameters() as f64 * more.ln();
            let truth = &self.truths[t];
            let lack = if truth.model == model {
                // Between its samples it may move on.
                truth.behind + views[model].lack(&test.forces[t], &seen[t], &self.noise)
            } else {
                views[model].lack(&test.forces[t], &views[model].force, &self.noise)
            };
            fitted.criterion() + price + lack
        };
        self.monitor.whole(self.told(criterion))
    }

    /// What the test tells when every model is fitted to it and the recordings.
    pub(super) fn look(&self, test: &Imagined) -> Option<Told> {
        let worlds: Vec<World> =
            test.forces.iter().map(|force| self.world(test, Some(force))).collect::<Option<_>>()?;
        self.monitor.whole(self.told(|t, model| self.fitted(&worlds[t], model, &self.truths[t])))
    }

    /// What is told, given the criterion of a model where one of the truths shows its force.
    fn told(&self, criterion: impl Fn(usize, usize) -> f64 + Sync) -> Told {
        let of = |(t, truth): (usize, &Truth)| {
            let place = truth.model;
            let beside =
                self.places.iter().filter(move |members| members.iter().any(|m| m.models.contains(&place)));
            let mut models: Vec<usize> = beside.flatten().flat_map(|m| m.models.iter().copied()).collect();
            models.sort_unstable();
            models.dedup();
            models.into_iter().map(move |model| (t, model))
        };
        let jobs: Vec<(usize, usize)> = self.truths.iter().enumerate().flat_map(of).collect();
        let found: Vec<f64> = jobs.par_iter().map(|(t, model)| criterion(*t, *model)).collect();
        let known = |job: (usize, usize)| jobs.iter().position(|j| *j == job).map(|place| found[place]);
        let weights: Vec<(usize, f64)> = self.truths.iter().map(|t| (t.model, t.weight)).collect();
        told(&self.places, &criteria(&self.models), &weights, |t, other| {
            let own = self.truths[t].model;
            let difference = known((t, other)).zip(known((t, own))).map_or(0.0, |(o, own)| o - own);
            // Where neither can follow the test, it tells nothing.
            if difference.is_nan() { 0.0 } else { difference }
        })
    }

    fn fitted(&self, world: &World, model: usize, truth: &Truth<'a>) -> f64 {
        let is_true = truth.model == model;
        let (rows, known) =
            (self.rows_with(world), if is_true { &truth.candidate } else { &self.models[model] });
        let data = self.data(&rows);
        let fitted = fit(world.assembly(known), data, &known.fitted.unit);
        // What the recordings leave open may lie far from what the test asks of another model.
        if is_true { fitted.criterion() } else { begun_anew(fitted, data).criterion() }
    }

    /// The model named, and its force in N in a test.
    pub(super) fn named<'t>(&self, test: &'t Imagined) -> (&Candidate<'a>, &'t [f64]) {
        (&self.models[0], &test.forces[0])
    }

    /// Samples that count, those of a test among them.
    pub(super) fn rows_with(&self, world: &World) -> Vec<Rows> {
        self.rows.iter().cloned().chain([vec![world.test().scored()]]).collect()
    }

    pub(super) fn data<'d>(&'d self, rows: &'d [Rows]) -> Data<'d> {
        Data { noise: &self.noise, rows, monitor: self.monitor }
    }

    /// The recordings with a test that shows a force in N.
    pub(super) fn world(&self, test: &Imagined, force: Option<&[f64]>) -> Option<World> {
        let known = self.models[0].assembly.campaign();
        World::new(known, self.base, &test.signal, test.velocity.clone(), force.map(<[f64]>::to_vec))
    }

    fn known_samples(&self) -> usize {
        self.models[0].fitted.rows.max(1)
    }
}

/// Criteria of models on the recordings.
fn criteria(models: &[Candidate]) -> Vec<f64> {
    models.iter().map(Candidate::criterion).collect()
}

impl Imagined {
    pub(super) fn signal(&self) -> &Signal {
        &self.signal
    }
}
