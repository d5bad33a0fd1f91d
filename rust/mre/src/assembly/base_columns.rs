//! The columns of the base of an assembly, with the motion and current that effects let it see.

use std::borrow::Cow;

use rayon::prelude::*;

use super::base::{Base, Group};
use super::halves::at_samples;
use super::layout::Assembly;
use crate::effect::{Effect, Motion, Scene, StateChange};
use crate::law::Law;
use crate::physics::Part;
use crate::recording::Recording;

/// Columns of the base on one recording, their places, and what they do with energy.
#[derive(Clone, Default)]
pub(super) struct BaseColumns {
    pub(super) columns: Vec<Vec<f64>>,
    pub(super) places: Vec<usize>,
    pub(super) parts: Vec<Part>,
    /// The columns with values halfway between the samples, where an effect asks for them.
    pub(super) between: Vec<Vec<f64>>,
}

/// What effects change of what the base model sees, and of how its hysteretic state follows it.
struct Otherwise {
    motion: Option<Motion>,
    /// A.
    current: Option<Vec<f64>>,
    state: Option<StateChange>,
}

impl Otherwise {
    fn is_nothing(&self) -> bool {
        self.motion.is_none() && self.current.is_none() && self.state.is_none()
    }
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

    /// Columns of the base with the motion and current that effects let it see.
    pub(super) fn base_seen(&self, jobs: &[(usize, &[f64])]) -> Vec<BaseColumns> {
        let mut found: Vec<Option<BaseColumns>> = Vec::with_capacity(jobs.len());
        let mut seen: Vec<Cow<Recording>> = Vec::new();
        let mut wanted: Vec<(usize, &[f64])> = Vec::new();
        let at_hand = self.known.as_ref().filter(|known| self.serves(&known.columns));
        for (r, shapes) in jobs {
            let base_shapes = &shapes[..self.base_shapes()];
            let recording = &self.campaign.recordings()[*r];
            let scene = self.scene(*r);
            let otherwise = self.otherwise(&scene, &self.shape_of(shapes));
            let as_it_is = otherwise.is_nothing();
            let Otherwise { motion, current, state } = otherwise;
            if as_it_is {
                let known = at_hand.filter(|known| known.shapes == base_shapes);
                if let Some(columns) = known.and_then(|known| known.columns.get(*r)) {
                    found.push(Some(columns.clone()));
                    continue;
                }
                seen.push(Cow::Borrowed(self.unaltered(*r)));
            } else if motion.is_none() && current.is_none() {
                seen.push(Cow::Owned(self.unaltered(*r).clone().with_state_changed(state)));
            } else {
                let motion = motion.unwrap_or_else(|| Motion {
                    displacement: scene.displacement.to_vec(),
                    velocity: scene.velocity.to_vec(),
                });
                let altered = recording.seen_with(motion.displacement, motion.velocity, current);
                seen.push(Cow::Owned(altered.with_state_changed(state)));
            }
            found.push(None);
            wanted.push((*r, base_shapes));
        }
        let jobs: Vec<(usize, &[f64], &Recording)> =
            wanted.iter().zip(&seen).map(|((r, shapes), seen)| (*r, *shapes, seen.as_ref())).collect();
        let mut made = self.base_columns(&jobs).into_iter();
        found.into_iter().map(|known| known.or_else(|| made.next()).unwrap_or_default()).collect()
    }

    /// A recording as a base sees it whose motion no effect alters.
    pub(super) fn unaltered(&self, r: usize) -> &Recording {
        let halves = if self.asks_between() { self.campaign.with_halves(r) } else { None };
        halves.unwrap_or(&self.campaign.recordings()[r])
    }

    pub(super) fn asks_between(&self) -> bool {
        // The cheapest question first: this one is asked for every set of columns.
        self.effects.iter().any(|effect| effect.between_samples())
            && matches!(self.base, Base::Fitted(_))
            && self.base.is_hysteretic()
    }

    /// True where columns of the base have what the effects ask for.
    pub(super) fn serves(&self, columns: &[BaseColumns]) -> bool {
        let has = |(r, columns): (usize, &BaseColumns)| {
            !columns.between.is_empty() || self.campaign.with_halves(r).is_none()
        };
        !self.asks_between() || columns.iter().enumerate().all(has)
    }

    /// True where effects change the motion or the current that the base sees in a recording, or how its state follows
    /// them.
    pub(super) fn sees_otherwise(&self, r: usize, shapes: &[f64]) -> bool {
        !self.otherwise(&self.scene(r), &self.shape_of(shapes)).is_nothing()
    }

    fn otherwise(&self, scene: &Scene, shape_of: &[&[f64]]) -> Otherwise {
        let (mut current, mut state) = (None, None);
        for (effect, shape) in self.effects.iter().zip(shape_of) {
            current = effect.current(scene, shape).or(current);
            state = state.into_iter().chain(effect.state_change(scene.sizes, shape)).reduce(StateChange::and);
        }
        Otherwise { motion: self.motion(scene, shape_of, |_| true), current, state }
    }

    /// Motion that the effects leave the device with all that stands beside the base; `None`: that which was measured.
    pub(super) fn motion_of_the_device(&self, scene: &Scene, shape_of: &[&[f64]]) -> Option<Motion> {
        self.motion(scene, shape_of, |effect| effect.moves_the_device())
    }

    fn motion(&self, scene: &Scene, shape_of: &[&[f64]], by: fn(&dyn Effect) -> bool) -> Option<Motion> {
        let effects = self.effects.iter().zip(shape_of).map(|(effect, shape)| (*effect, *shape));
        left_by(scene, effects.filter(|(effect, _)| by(*effect)))
    }
}

/// Motion that effects with their shapes leave one after the other; `None`: that which was measured.
pub(super) fn left_by<'e>(
    scene: &Scene,
    effects: impl Iterator<Item = (&'static dyn Effect, &'e [f64])>,
) -> Option<Motion> {
    effects.fold(None, |so_far: Option<Motion>, (effect, shape)| {
        let moved = so_far.as_ref().map_or(*scene, |motion| scene.moved(motion));
        effect.motion(&moved, shape).or(so_far)
    })
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
