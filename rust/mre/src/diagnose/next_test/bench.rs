//! Models that are in doubt, on an imagined test.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::doubt::{Doubt, Member};
use super::excitation::Kind;
use super::imagined::Imagined;
use super::limits::Limits;
use super::told::{Evidence, Told, told};
use super::truth::{Truth, truths};
use super::view::{Held, View};
use super::world::{TOGETHER, World};
use crate::assembly::{Assembly, Base};
use crate::diagnose::alternatives::may_fit_better;
use crate::diagnose::candidates::Candidate;
use crate::diagnose::joint::{begun_anew, fit};
use crate::diagnose::least_squares::Data;
use crate::diagnose::monitor::Monitor;
use crate::diagnose::noise::Noise;
use crate::diagnose::normal::Rows;
use crate::diagnose::search::Named;

/// Laws of an effect that are fitted to a test at most: those that lack least of it at a glance.
const FITTED: usize = 3;

/// What may be true of an effect at most: that of the largest weights.
const MOST_TRUE: usize = 3;

/// What is true, and a model.
type Job = (usize, usize);
/// The criterion of each.
type Criteria = BTreeMap<Job, f64>;

/// The models, and what the recordings know of them.
pub(super) struct Bench<'b, 'a> {
    base: &'b Base,
    rows: &'b [Rows],
    monitor: &'b dyn Monitor,
    /// Of the recordings and of the test.
    noise: Noise,
    /// What the model named leaves of the recordings beyond chance.
    left: f64,
    models: Vec<Candidate<'a>>,
    /// By how much each is less likely than the one named.
    behind: Vec<f64>,
    /// What may stand in each place in doubt.
    places: Vec<Vec<Member>>,
    /// What may be true, the model named at its best fit first.
    truths: Vec<Truth<'a>>,
    held: Vec<Held>,
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
        let lacks = doubt.lacks(named);
        let behind = doubt.behind(named, &lacks);
        let places = doubt.places(named, &lacks);
        let in_doubt = places.iter().flatten().flat_map(|member| member.may_be_true(&lacks));
        let mut true_ones: Vec<(usize, f64)> = std::iter::once((0, 1.0)).chain(in_doubt).collect();
        true_ones.sort_by_key(|(model, _)| *model);
        true_ones.dedup_by_key(|(model, _)| *model);
        let truths =
            true_ones.par_iter().flat_map(|(i, share)| truths(*i, *share, &models[*i], &held[*i], data));
        let truths = likeliest(truths.collect(), &places);
        let noise = named.noise.with_another_like(0);
        Self { base, rows, monitor, noise, left: doubt.left, models, behind, places, truths, held }
    }

    /// A test; `None` where the limits leave no room for it, or a model cannot follow it.
    pub(super) fn imagine(&self, kind: Kind, limits: &Limits) -> Option<Imagined> {
        let imagined =
            Imagined::new(kind, limits, self.models[0].assembly.campaign(), self.base, &self.truths)?;
        self.monitor.whole(imagined)
    }

    /// What the test tells to first order: every model bends as far as the recordings let it.
    pub(super) fn glance(&self, test: &Imagined) -> Option<Told> {
        let told = self.told(test, &self.at_a_glance(test)?);
        self.monitor.whole(told)
    }

    /// What the test tells when the models that may best follow it are fitted to it and the recordings.
    pub(super) fn look(&self, test: &Imagined) -> Option<Told> {
        let glance = self.at_a_glance(test)?;
        let few = |t: usize, member: &Member| {
            let mut few = member.models.clone();
            few.sort_by(|a, b| glance[&(t, *a)].total_cmp(&glance[&(t, *b)]));
            few.truncate(FITTED);
            few
        };
        let worlds: Vec<World> =
            (0..self.truths.len()).map(|t| self.world(test, Some(test.force(t)))).collect::<Option<_>>()?;
        let found = (0..worlds.len()).into_par_iter().flat_map(|t| {
            let own = self.fitted_to_its_own(&worlds[t], t);
            let others: Vec<Vec<usize>> = self.beside(t).map(|member| few(t, member)).collect();
            let lacks = others.par_iter().map(|models| self.fitted(&worlds[t], models, own));
            let lacks: Vec<Vec<(usize, f64)>> = lacks.collect();
            let all = lacks.into_iter().flatten().chain([(self.truths[t].model, own)]);
            all.map(|(model, criterion)| ((t, model), criterion)).collect::<Vec<_>>()
        });
        self.monitor.whole(self.told(test, &found.collect()))
    }

    /// Criteria to first order of models where truths show their forces.
    fn at_a_glance(&self, test: &Imagined) -> Option<Criteria> {
        let world = self.world(test, None)?;
        let models: Vec<&Candidate> = self.models.iter().collect();
        let view = |((assembly, model), held): ((Assembly, &&Candidate), &Held)| {
            View::new(&assembly, model, held, &self.noise)
        };
        let some = |(models, held): (&[&Candidate], &[Held])| {
            let assemblies = world.assemblies(models).into_par_iter();
            assemblies.zip(models).zip(held).map(view).collect::<Vec<View>>()
        };
        let views: Vec<View> =
            models.chunks(TOGETHER).zip(self.held.chunks(TOGETHER)).flat_map(some).collect();
        let truths: Vec<&Candidate> = self.truths.iter().map(|truth| &truth.candidate).collect();
        let seen = world.simulated(&truths)?;
        let criterion = |t: usize, model: usize| {
            let fitted = &self.models[model].fitted;
            let price = fitted.parameters() as f64 * self.longer(test).ln();
            let truth = &self.truths[t];
            let lack = if truth.model == model {
                // Between its samples it may move on.
                truth.behind + views[model].lack(test.force(t), &seen[t], &self.noise)
            } else {
                views[model].lack(test.force(t), &views[model].force, &self.noise)
            };
            fitted.criterion() + price + lack
        };
        let all = (0..self.truths.len()).flat_map(|t| {
            let others = self.beside(t).flat_map(|member| member.models.iter().copied());
            std::iter::once(self.truths[t].model).chain(others).map(move |model| (t, model))
        });
        let all: Vec<Job> = all.collect();
        Some(all.into_par_iter().map(|(t, model)| ((t, model), criterion(t, model))).collect())
    }

    /// What may stand in the place of the effect of a truth.
    fn beside(&self, t: usize) -> impl Iterator<Item = &Member> {
        let own = move |member: &Member| member.models.contains(&self.truths[t].model);
        let places = self.places.iter().filter(move |members| members.iter().any(own));
        places.flatten().filter(move |member| !own(member))
    }

    /// What is told, given criteria; what has none is ruled out by what has.
    fn told(&self, test: &Imagined, found: &Criteria) -> Told {
        // An error of the law goes on in the test.
        let left = self.longer(test) * self.left;
        let weights: Vec<(usize, f64)> = self.truths.iter().map(|t| (t.model, t.weight)).collect();
        told(&self.places, &self.behind, &weights, |t, other| {
            let Some(criterion) = found.get(&(t, other)) else { return Evidence::ALL };
            let own = self.truths[t].model;
            let difference = criterion - found[&(t, own)];
            let (own, other) = (&self.models[own], &self.models[other]);
            let better = may_fit_better(other, &self.noise);
            let spared = if better { other.fitted.spared(&own.fitted) } else { 0.0 };
            Evidence::new(difference, spared, left)
        })
    }

    /// Criterion of a truth where it shows its force.
    fn fitted_to_its_own(&self, world: &World, t: usize) -> f64 {
        let (rows, known) = (self.rows_with(world), &self.truths[t].candidate);
        fit(world.assembly(known), self.data(&rows), &known.fitted.unit).criterion()
    }

    /// Criteria of laws of another effect, up to one that follows the force as well as what is true: then the test does
    /// not tell the effect from it, and no better fit can change that.
    fn fitted(&self, world: &World, models: &[usize], own: f64) -> Vec<(usize, f64)> {
        let rows = self.rows_with(world);
        let data = self.data(&rows);
        let mut found = Vec::new();
        for model in models {
            let known = &self.models[*model];
            let mut fitted = fit(world.assembly(known), data, &known.fitted.unit);
            if fitted.criterion() > own {
                // What the recordings leave open may lie far from what the test asks of another model.
                fitted = begun_anew(fitted, data);
            }
            let criterion = fitted.criterion();
            found.push((*model, criterion));
            if criterion <= own {
                break;
            }
        }
        found
    }

    /// The model named, and its force in N in a test.
    pub(super) fn named<'t>(&self, test: &'t Imagined) -> (&Candidate<'a>, &'t [f64]) {
        (&self.models[0], test.force(0))
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
        World::new(
            known,
            self.base,
            test.signal(),
            test.velocity().map(<[f64]>::to_vec),
            force.map(<[f64]>::to_vec),
        )
    }

    /// Samples with a test over those without.
    fn longer(&self, test: &Imagined) -> f64 {
        let known = self.models[0].fitted.rows.max(1);
        (known + test.signal().time.len()) as f64 / known as f64
    }
}

/// What may be true of each effect: its few points of the largest weights, the first of its likeliest model among them; the
/// first of all is what is named.
fn likeliest<'a>(truths: Vec<Truth<'a>>, places: &[Vec<Member>]) -> Vec<Truth<'a>> {
    let heavier = |t: usize| {
        let together = |other: &Truth| {
            let both = |member: &Member| {
                member.models.contains(&truths[t].model) && member.models.contains(&other.model)
            };
            places.iter().flatten().any(both)
        };
        let before = |(place, other): &(usize, &Truth)| {
            other.weight > truths[t].weight || (other.weight == truths[t].weight && *place < t)
        };
        let all = truths.iter().enumerate();
        all.filter(|(_, other)| together(other)).filter(before).count()
    };
    let first_of_the_likeliest = |t: usize| {
        let own = |member: &Member| member.likeliest == truths[t].model;
        let first = truths.iter().position(|other| other.model == truths[t].model) == Some(t);
        first && places.iter().flatten().any(own)
    };
    let kept: Vec<bool> =
        (0..truths.len()).map(|t| t == 0 || first_of_the_likeliest(t) || heavier(t) < MOST_TRUE).collect();
    truths.into_iter().zip(kept).filter_map(|(truth, kept)| kept.then_some(truth)).collect()
}
