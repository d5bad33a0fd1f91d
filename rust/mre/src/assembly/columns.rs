//! The columns of an assembly on one recording.

use super::base::{Base, Group};
use super::layout::Assembly;
use crate::effect::{Factors, Motion, Scene};
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

/// Columns of the base at some shapes, which cost more than those of most effects.
pub(super) struct Known {
    pub(super) shapes: Vec<f64>,
    pub(super) columns: Vec<BaseColumns>,
}

/// Columns of the base on one recording, their places, and what they do with energy.
#[derive(Clone, Default)]
pub(super) struct BaseColumns {
    columns: Vec<Vec<f64>>,
    places: Vec<usize>,
    parts: Vec<Part>,
}

impl Assembly<'_> {
    /// Columns of a recording for shapes in their units.
    pub fn columns(&self, r: usize, shapes: &[f64]) -> Columns {
        let mut shape_of = Vec::new();
        let mut next = self.base_shapes();
        for effect in &self.effects {
            let count = effect.shape(self.campaign.sizes()).len();
            shape_of.push(&shapes[next..next + count]);
            next += count;
        }
        let scene = self.scene(r);
        let base = self.base_seen(r, shapes, &scene, &shape_of);
        let mut found = Columns { columns: base.columns, places: base.places, given: None, clip: None };
        for (effect, shape) in self.effects.iter().zip(&shape_of) {
            if let Some(factors) = effect.factors(&scene, shape) {
                scale(&factors, &base.parts, &mut found.columns);
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
        self.effect_columns(r, &scene, &shape_of, &mut found);
        found
    }

    /// Columns of the base with the motion and current that effects let it see.
    fn base_seen(&self, r: usize, shapes: &[f64], scene: &Scene, shape_of: &[&[f64]]) -> BaseColumns {
        let base_shapes = &shapes[..self.base_shapes()];
        let recording = &self.campaign.recordings()[r];
        let (motion, current) = self.seen(scene, shape_of);
        if motion.is_some() || current.is_some() {
            let motion = motion.unwrap_or_else(|| Motion {
                displacement: scene.displacement.to_vec(),
                velocity: scene.velocity.to_vec(),
            });
            let seen = recording.seen_with(motion.displacement, motion.velocity, current);
            return self.base_columns(r, base_shapes, &seen);
        }
        match &self.known {
            Some(known) if known.shapes == base_shapes => known.columns[r].clone(),
            _ => self.base_columns(r, base_shapes, recording),
        }
    }

    pub(super) fn base_columns(&self, r: usize, shapes: &[f64], seen: &Recording) -> BaseColumns {
        let fixed = |parts: Vec<(Part, Vec<f64>)>| {
            let (parts, columns) = parts.into_iter().unzip();
            BaseColumns { columns, places: Vec::new(), parts }
        };
        match self.base {
            // A device that cannot be simulated with what an effect lets it see.
            Base::Held(device) => fixed(device.parts(seen).unwrap_or_default()),
            Base::Given(force) => fixed(vec![(Part::Stiffness, force[r].clone())]),
            Base::Fitted(groups) => Self::group_columns(groups, r, shapes, seen),
        }
    }

    fn group_columns(groups: &[Group], r: usize, shapes: &[f64], seen: &Recording) -> BaseColumns {
        let (mut coefficient, mut shape) = (0, 0);
        for group in groups {
            if group.members.contains(&r) {
                let mut values = vec![0.0; group.problem.parameters().len()];
                for (k, place) in group.shapes.iter().enumerate() {
                    values[*place] = shapes[shape + k];
                }
                let (model, law) = (group.problem.model(), group.problem.law());
                return BaseColumns {
                    columns: law.columns(model, seen, &values),
                    places: (coefficient..coefficient + group.coefficients.len()).collect(),
                    parts: law.parts(model),
                };
            }
            coefficient += group.coefficients.len();
            shape += group.shapes.len();
        }
        BaseColumns::default()
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

    fn effect_columns(&self, r: usize, scene: &Scene, shape_of: &[&[f64]], found: &mut Columns) {
        let count = self.campaign.recordings().len();
        let mut next = self.base_coefficients();
        let mut readings = Vec::new();
        for (effect, shape) in self.effects.iter().zip(shape_of) {
            let columns = effect.columns(scene, shape);
            let first = next + if effect.of_the_measurement() { r * columns.len() } else { 0 };
            let width = columns.len();
            let placed = columns.into_iter().enumerate().map(|(k, column)| (first + k, column));
            if effect.of_the_measurement() {
                readings.extend(placed);
                next += count * width;
            } else {
                for (place, column) in placed {
                    found.places.push(place);
                    found.columns.push(column);
                }
                next += width;
            }
        }
        for (effect, shape) in self.effects.iter().zip(shape_of) {
            for column in found.columns.iter_mut().chain(&mut found.given) {
                if let Some(measured) = effect.through(scene, shape, column) {
                    *column = measured;
                }
            }
            if let Some((low, high)) = effect.clip(shape) {
                found.clip = Some(found.clip.map_or((low, high), |(l, h)| (low.max(l), high.min(h))));
            }
        }
        for (place, column) in readings {
            found.places.push(place);
            found.columns.push(column);
        }
    }
}

fn scale(factors: &Factors, parts: &[Part], columns: &mut [Vec<f64>]) {
    for (column, part) in columns.iter_mut().zip(parts) {
        let factor = match (part, &factors.damping) {
            (Part::Stiffness, _) => &factors.stiffness,
            (Part::Damping, Some(damping)) => damping,
            _ => continue,
        };
        for (value, factor) in column.iter_mut().zip(factor) {
            *value *= factor;
        }
    }
}
