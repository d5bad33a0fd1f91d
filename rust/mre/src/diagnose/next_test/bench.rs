//! Models that are in doubt, on an imagined test.

use rayon::prelude::*;

use super::doubt::{Doubt, Told};
use super::excitation::{Kind, Signal};
use super::limits::Limits;
use super::view::{Held, View};
use super::world::World;
use crate::assembly::Base;
use crate::diagnose::candidates::{Candidate, fit};
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
    doubt: &'b Doubt<'a>,
    rows: &'b [Rows],
    monitor: &'b dyn Monitor,
    /// Of the recordings and of the test.
    noise: Noise,
    models: Vec<Candidate<'a>>,
    held: Vec<Held>,
}

/// A test as it is imagined: each model that may be true moves finely, and is seen at the samples of a recording.
pub(super) struct Imagined {
    signal: Signal,
    velocity: Option<Vec<f64>>,
    /// Force in N of each of [`Doubt::truths`].
    forces: Vec<Vec<f64>>,
}

impl<'b, 'a> Bench<'b, 'a> {
    pub(super) fn new(
        named: &Named<'a>,
        base: &'b Base,
        doubt: &'b Doubt<'a>,
        rows: &'b [Rows],
        monitor: &'b dyn Monitor,
    ) -> Self {
        let models = doubt.models(named);
        let data = Data { noise: &named.noise, rows, monitor };
        let held = models.par_iter().map(|model| Held::of(model, data)).collect();
        Self { base, doubt, rows, monitor, noise: named.noise.with_another_like(0), models, held }
    }

    /// A test; `None` where the limits leave no room for it, or a model cannot follow it.
    pub(super) fn imagine(&self, kind: Kind, limits: &Limits) -> Option<Imagined> {
        let times = (FINE * limits.highest / limits.rate).clamp(1.0, FINEST).ceil();
        let fine = kind.signal(&Limits { rate: times * limits.rate, ..limits.clone() })?;
        let known = self.models[0].assembly.campaign();
        let world = World::new(known, self.base, &fine, None, None)?;
        let truths = self.doubt.truths(&self.models);
        let every = |series: &[f64]| series.iter().step_by(times as usize).copied().collect::<Vec<f64>>();
        let forces = truths
            .par_iter()
            .map(|(truth, _)| world.simulated(&self.models[*truth]).map(|force| every(&force)))
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
    pub(super) fn glance(&self, test: &Imagined) -> Option<Vec<Told>> {
        let world = self.world(test, None)?;
        let views: Vec<View> = self
            .models
            .par_iter()
            .zip(&self.held)
            .map(|(model, held)| View::new(&world, model, held, &self.noise))
            .collect();
        let more = (self.known_samples() + test.signal.time.len()) as f64 / self.known_samples() as f64;
        let criterion = |model: usize, force: &[f64]| {
            let fitted = &self.models[model].fitted;
            let price = fitted.parameters() as f64 * more.ln();
            fitted.criterion() + price + views[model].lack(force, &self.noise)
        };
        self.monitor.whole(self.told(test, |_, force, model| Some(criterion(model, force))))
    }

    /// What the test tells when every model is fitted to it and the recordings.
    pub(super) fn look(&self, test: &Imagined) -> Option<Vec<Told>> {
        let truths = self.doubt.truths(&self.models);
        let worlds: Vec<World> =
            test.forces.iter().map(|force| self.world(test, Some(force))).collect::<Option<_>>()?;
        let jobs: Vec<(usize, usize)> = truths
            .iter()
            .enumerate()
            .flat_map(|(t, (truth, others))| {
                std::iter::once(*truth).chain(others.iter().copied()).map(move |model| (t, model))
            })
            .collect();
        let fitted: Vec<f64> = jobs.par_iter().map(|(t, model)| self.fitted(&worlds[*t], *model)).collect();
        let known = |t: usize, model: usize| {
            jobs.iter().position(|job| *job == (t, model)).map(|place| fitted[place])
        };
        self.monitor.whole(self.told(test, |t, _, model| known(t, model)))
    }

    /// What each effect in doubt is told by, given the criterion of a model where a truth shows a force.
    fn told(&self, test: &Imagined, criterion: impl Fn(usize, &[f64], usize) -> Option<f64>) -> Vec<Told> {
        let truths = self.doubt.truths(&self.models);
        self.doubt.told(&self.models, |truth, other| {
            let t = truths.iter().position(|(known, _)| *known == truth)?;
            let of = |model| criterion(t, &test.forces[t], model);
            let difference = of(other)? - of(truth)?;
            // Where neither can follow the test, it tells nothing.
            Some(if difference.is_nan() { 0.0 } else { difference })
        })
    }

    fn fitted(&self, world: &World, model: usize) -> f64 {
        let assembly = world.assembly(&self.models[model]);
        let mut rows = self.rows.to_vec();
        rows.push(vec![world.test().scored()]);
        let data = Data { noise: &self.noise, rows: &rows, monitor: self.monitor };
        fit(assembly, data, &self.models[model].fitted.unit).criterion()
    }

    fn world(&self, test: &Imagined, force: Option<&Vec<f64>>) -> Option<World> {
        let known = self.models[0].assembly.campaign();
        World::new(known, self.base, &test.signal, test.velocity.clone(), force.cloned())
    }

    fn known_samples(&self) -> usize {
        self.models[0].fitted.rows.max(1)
    }
}

impl Imagined {
    pub(super) fn signal(&self) -> &Signal {
        &self.signal
    }
}
