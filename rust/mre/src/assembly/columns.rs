//! The columns of an assembly on one recording.

use std::borrow::Cow;

use rayon::prelude::*;

use super::base::{Base, Group};
use super::halves::at_samples;
use super::in_series::InSeries;
use super::layout::Assembly;
use crate::effect::{About, Effect, Factors, Motion, Scene};
use crate::law::Law;
use crate::physics::Part;
use crate::recording::Recording;

/// Columns of one recording.
#[derive(Debug, Default)]
pub struct Columns {
    /// Columns of linear coefficients.
    pub columns: Vec<Vec<f64>>,
    /// For each the place of its coefficient in the assembly.
    pub places: Vec<usize>,
    /// Force that has no coefficient.
    pub given: Option<Vec<f64>>,
    /// Lowest and highest force that is measured.
    pub clip: Option<(f64, f64)>,
}

impl Columns {
    /// More of them, whose coefficients stand side by side from a place on.
    pub(super) fn add(&mut self, first: usize, columns: Vec<Vec<f64>>) {
        self.places.extend(first..first + columns.len());
        self.columns.extend(columns);
    }

    /// Their sum with coefficients, N, before clipping.
    pub fn force(&self, coefficients: &[f64]) -> Vec<f64> {
        let length = |columns: Option<&Vec<f64>>| columns.map_or(0, Vec::len);
        let n = length(self.columns.first()).max(length(self.given.as_ref()));
        let mut force = self.given.clone().unwrap_or_else(|| vec![0.0; n]);
        for (column, place) in self.columns.iter().zip(&self.places) {
            let c = coefficients[*place];
            for (f, value) in force.iter_mut().zip(column) {
                *f += c * value;
            }
        }
        force
    }

    /// The same as a clipping channel shows it.
    pub fn measured(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut force = self.force(coefficients);
        if let Some((low, high)) = self.clip {
            for f in &mut force {
                *f = f.clamp(low, high);
            }
        }
        force
    }
}

/// Columns that are at hand: a step of a search moves one part of the model and leaves the others.
pub(super) struct Known {
    /// Shapes of the base, and its columns on every recording.
    pub(super) shapes: Vec<f64>,
    pub(super) columns: Vec<BaseColumns>,
    /// What effects add.
    pub(super) effects: Vec<Added>,
}

/// What an effect at some shape adds to or scales in every recording.
pub(super) struct Added {
    of: About,
    shape: Vec<f64>,
    pub(super) columns: Vec<Vec<Vec<f64>>>,
    factors: Vec<Option<Factors>>,
}

impl Known {
    pub(super) fn added(&self, effect: &dyn Effect, shape: &[f64]) -> Option<&Added> {
        self.effects.iter().find(|known| known.shape == shape && known.of == effect.about())
    }
}

/// Columns of the base on one recording, their places, and what they do with energy.
#[derive(Clone, Default)]
pub(super) struct BaseColumns {
    columns: Vec<Vec<f64>>,
    places: Vec<usize>,
    parts: Vec<Part>,
    /// The columns with values halfway between the samples, where an effect asks for them.
    between: Vec<Vec<f64>>,
}

impl BaseColumns {
    /// Columns of so many samples; of those that also have what lies between them that is kept apart.
    fn thin(&mut self, samples: usize) {
        if self.columns.iter().any(|column| column.len() > samples) {
            self.between = std::mem::take(&mut self.columns);
            self.columns = self.between.iter().map(|column| at_samples(column)).collect();
        }
    }
}

impl Assembly<'_> {
    /// Columns of a recording for shapes in their units.
    pub fn columns(&self, r: usize, shapes: &[f64]) -> Columns {
        self.columns_of(&[(r, shapes)]).pop().unwrap_or_default()
    }

    /// Columns of several recordings, each for its own shapes: cheaper together than one by one.
    pub fn columns_of(&self, jobs: &[(usize, &[f64])]) -> Vec<Columns> {
        self.base_seen(jobs)
            .into_par_iter()
            .zip(jobs)
            .map(|(base, (r, shapes))| {
                let mut columns = self.with_effects(*r, shapes, base);
                self.measure(*r, shapes, &mut columns);
                columns
            })
            .collect()
    }

    /// Force in N of the device with all its effects, before it is measured.
    pub(super) fn force_of_the_device(&self, r: usize, shapes: &[f64], coefficients: &[f64]) -> Vec<f64> {
        let base = self.base_seen(&[(r, shapes)]).pop().unwrap_or_default();
        self.with_effects(r, shapes, base).force(coefficients)
    }

    /// Columns of a device from those of its base.
    fn with_effects(&self, r: usize, shapes: &[f64], base: BaseColumns) -> Columns {
        let shape_of = self.shape_of(shapes);
        let scene = self.scene(r);
        let mut found = Columns { columns: base.columns, places: base.places, given: None, clip: None };
        let mut between = base.between;
        for (effect, shape) in self.effects.iter().zip(&shape_of) {
            let known = self.known.as_ref().and_then(|known| known.added(*effect, shape));
            let factors = match known {
                Some(known) => known.factors[r].as_ref().map(Cow::Borrowed),
                None => effect.factors(&scene, shape).map(Cow::Owned),
            };
            if let Some(factors) = factors {
                scale(&factors, &base.parts, &mut found.columns);
                between.clear();
            }
        }
        if !matches!(self.base, Base::Fitted(_)) {
            // Nothing to fit: the columns are the force.
            let mut force = vec![0.0; scene.len()];
            for column in found.columns.drain(..) {
                for (f, value) in force.iter_mut().zip(column) {
                    *f += value;
                }
            }
            found.given = Some(force);
        }
        self.effect_columns(r, &scene, &shape_of, between, &mut found);
        if let Some(flexibility) = self.flexibility(shapes).filter(|f| f.size > 0.0) {
            let whole = &self.whole[r];
            let rig = InSeries::new(&self.campaign.recordings()[r], whole, whole, flexibility);
            rig.pass(whole, &mut found);
        }
        found
    }

    /// What each effect adds at these shapes; taken over where it is known.
    pub(super) fn added(&self, shapes: &[f64]) -> Vec<Added> {
        let recordings = self.campaign.recordings().len();
        let of_effect = |(effect, shape): (&&'static dyn Effect, &[f64])| {
            let (columns, factors) = (0..recordings)
                .into_par_iter()
                .map(|r| (effect.columns(&self.scene(r), shape), effect.factors(&self.scene(r), shape)))
                .unzip();
            Added { of: effect.about(), shape: shape.to_vec(), columns, factors }
        };
        self.effects.iter().zip(self.shape_of(shapes)).map(of_effect).collect()
    }

    /// True where all of this is at hand.
    pub(super) fn knows(&self, shapes: &[f64]) -> bool {
        self.known.as_ref().is_some_and(|known| {
            known.shapes == shapes[..self.base_shapes()]
                && self.serves(&known.columns)
                && self.effects.iter().zip(self.shape_of(shapes)).all(|(e, s)| known.added(*e, s).is_some())
        })
    }

    /// True where effects change the motion or the current that the base sees.
    pub(super) fn sees_otherwise(&self, shapes: &[f64]) -> bool {
        let (motion, current) = self.seen(&self.scene(0), &self.shape_of(shapes));
        motion.is_some() || current.is_some()
    }

    /// A recording as a base sees it whose motion no effect alters.
    pub(super) fn unaltered(&self, r: usize) -> &Recording {
        let halves = if self.asks_between() { self.campaign.with_halves(r) } else { None };
        halves.unwrap_or(&self.campaign.recordings()[r])
    }

    fn asks_between(&self) -> bool {
        matches!(self.base, Base::Fitted(_))
            && self.base.is_hysteretic()
            && self.effects.iter().any(|effect| effect.between_samples())
    }

    /// True where columns of the base have what the effects ask for.
    pub(super) fn serves(&self, columns: &[BaseColumns]) -> bool {
        let has = |(r, columns): (usize, &BaseColumns)| {
            !columns.between.is_empty() || self.campaign.with_halves(r).is_none()
        };
        !self.asks_between() || columns.iter().enumerate().all(has)
    }

    /// The shapes of each effect.
    pub(super) fn shape_of<'s>(&self, shapes: &'s [f64]) -> Vec<&'s [f64]> {
        let mut next = self.base_shapes();
        let own = |effect: &&'static dyn Effect| {
            let count = effect.shape(self.campaign.sizes()).len();
            next += count;
            &shapes[next - count..next]
        };
        self.effects.iter().map(own).collect()
    }

    /// Columns of the base with the motion and current that effects let it see.
    fn base_seen(&self, jobs: &[(usize, &[f64])]) -> Vec<BaseColumns> {
        let mut found: Vec<Option<BaseColumns>> = Vec::with_capacity(jobs.len());
        let mut seen: Vec<Cow<Recording>> = Vec::new();
        let mut wanted: Vec<(usize, &[f64])> = Vec::new();
        for (r, shapes) in jobs {
            let base_shapes = &shapes[..self.base_shapes()];
            let recording = &self.campaign.recordings()[*r];
            let scene = self.scene(*r);
            let (motion, current) = self.seen(&scene, &self.shape_of(shapes));
            if motion.is_none() && current.is_none() {
                let known = self
                    .known
                    .as_ref()
                    .filter(|known| known.shapes == base_shapes && self.serves(&known.columns));
                if let Some(columns) = known.and_then(|known| known.columns.get(*r)) {
                    found.push(Some(columns.clone()));
                    continue;
                }
                seen.push(Cow::Borrowed(self.unaltered(*r)));
            } else {
                let motion = motion.unwrap_or_else(|| Motion {
                    displacement: scene.displacement.to_vec(),
                    velocity: scene.velocity.to_vec(),
                });
                seen.push(Cow::Owned(recording.seen_with(motion.displacement, motion.velocity, current)));
            }
            found.push(None);
            wanted.push((*r, base_shapes));
        }
        let jobs: Vec<(usize, &[f64], &Recording)> =
            wanted.iter().zip(&seen).map(|((r, shapes), seen)| (*r, *shapes, seen.as_ref())).collect();
        let mut made = self.base_columns(&jobs).into_iter();
        found.into_iter().map(|known| known.or_else(|| made.next()).unwrap_or_default()).collect()
    }

    /// Columns of the base on recordings as it sees them: place in the campaign, shapes, what is seen.
    pub(super) fn base_columns(&self, jobs: &[(usize, &[f64], &Recording)]) -> Vec<BaseColumns> {
        let fixed = |parts: Vec<(Part, Vec<f64>)>| {
            let (parts, columns) = parts.into_iter().unzip();
            BaseColumns { columns, parts, ..BaseColumns::default() }
        };
        match self.base {
            Base::Held(kept) => jobs
                .par_iter()
                // A device that cannot be simulated with what an effect lets it see.
                .map(|(.., seen)| fixed(kept.parts(seen).unwrap_or_default()))
                .collect(),
            Base::Given(force) => {
                jobs.iter().map(|(r, ..)| fixed(vec![(Part::Stiffness, force[*r].clone())])).collect()
            }
            Base::Fitted(groups) => {
                let mut made = group_columns(groups, jobs);
                for (made, (r, ..)) in made.iter_mut().zip(jobs) {
                    made.thin(self.campaign.recordings()[*r].len());
                }
                made
            }
        }
    }

    /// Motion and current that the base model sees, where an effect changes them.
    fn seen(&self, scene: &Scene, shape_of: &[&[f64]]) -> (Option<Motion>, Option<Vec<f64>>) {
        let (mut motion, mut current): (Option<Motion>, _) = (None, None);
        for (effect, shape) in self.effects.iter().zip(shape_of) {
            let so_far = motion.take();
            let mut scene = *scene;
            if let Some(so_far) = &so_far {
                (scene.displacement, scene.velocity) = (&so_far.displacement, &so_far.velocity);
            }
            current = effect.current(&scene, shape).or(current);
            motion = effect.motion(&scene, shape).or(so_far);
        }
        (motion, current)
    }
}

/// Columns of a model that is fitted in groups.
fn group_columns(groups: &[Group], jobs: &[(usize, &[f64], &Recording)]) -> Vec<BaseColumns> {
    let Some(model) = groups.first().map(|g| g.problem.model()) else { return Vec::new() };
    let (mut values, mut places) = (Vec::new(), Vec::new());
    for (r, shapes, _) in jobs {
        let (mut coefficient, mut shape) = (0, 0);
        for group in groups {
            if group.members.contains(r) {
                let mut own = vec![0.0; group.problem.parameters().len()];
                for (k, place) in group.shapes.iter().enumerate() {
                    own[*place] = shapes[shape + k];
                }
                values.push((group.problem.law(), own));
                places.push((coefficient..coefficient + group.coefficients.len()).collect());
                break;
            }
            coefficient += group.coefficients.len();
            shape += group.shapes.len();
        }
    }
    let of: Vec<(&Law, &Recording, &[f64])> =
        jobs.iter().zip(&values).map(|((.., seen), (law, own))| (*law, *seen, own.as_slice())).collect();
    Law::columns_of(model, &of)
        .into_iter()
        .zip(places)
        .zip(&values)
        .map(|((columns, places), (law, _))| {
            let parts = law.parts(model);
            BaseColumns { columns, places, parts, between: Vec::new() }
        })
        .collect()
}

fn scale(factors: &Factors, parts: &[Part], columns: &mut [Vec<f64>]) {
    for (column, part) in columns.iter_mut().zip(parts) {
        let Some(factor) = factors.on(*part) else { continue };
        for (value, factor) in column.iter_mut().zip(factor) {
            *value *= factor;
        }
    }
}
