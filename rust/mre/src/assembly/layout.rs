//! Which parameters an assembly has, and the columns of its linear coefficients.

use std::sync::Arc;

use super::base::{Base, Group};
use super::campaign::Campaign;
use crate::effect::{Effect, Factors, Motion, Scene};
use crate::parameter::{Parameter, Scale};
use crate::physics::Part;

/// A base and effects on the recordings of a campaign.
#[derive(Clone)]
pub struct Assembly<'a> {
    campaign: &'a Campaign,
    base: &'a Base,
    effects: Vec<&'static dyn Effect>,
    /// Force of the base model alone, by recording.
    reference: Arc<Vec<Vec<f64>>>,
    boxes: Vec<Parameter>,
}

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

impl<'a> Assembly<'a> {
    /// An assembly; `reference` is the force of the base model alone.
    pub fn new(
        campaign: &'a Campaign,
        base: &'a Base,
        effects: Vec<&'static dyn Effect>,
        reference: Arc<Vec<Vec<f64>>>,
    ) -> Self {
        let of_group = |g: &'a Group| g.shapes.iter().map(|i| g.problem.parameters()[*i].clone());
        let boxes = base
            .groups()
            .iter()
            .flat_map(of_group)
            .chain(effects.iter().flat_map(|e| e.shape(campaign.sizes())))
            .collect();
        Self { campaign, base, effects, reference, boxes }
    }

    /// The same base with other effects.
    pub fn with(&self, effects: Vec<&'static dyn Effect>) -> Self {
        Self::new(self.campaign, self.base, effects, self.reference.clone())
    }

    /// The same with another force of the base model alone.
    pub fn referring_to(&self, reference: Vec<Vec<f64>>) -> Self {
        Self { reference: Arc::new(reference), ..self.clone() }
    }

    /// What effects see of a recording.
    pub fn scene(&self, r: usize) -> Scene<'_> {
        self.campaign.scene(r, &self.reference[r])
    }

    /// The campaign.
    pub fn campaign(&self) -> &'a Campaign {
        self.campaign
    }

    /// The base.
    pub fn base(&self) -> &'a Base {
        self.base
    }

    /// The effects.
    pub fn effects(&self) -> &[&'static dyn Effect] {
        &self.effects
    }

    /// Nonlinear parameters: shapes of the base group by group, then of the effects.
    pub fn shapes(&self) -> &[Parameter] {
        &self.boxes
    }

    /// Number of nonlinear parameters of the base.
    pub fn base_shapes(&self) -> usize {
        self.base.groups().iter().map(|g| g.shapes.len()).sum()
    }

    /// Linear coefficients with their limits: those of the base group by group, then of the effects.
    pub fn coefficients(&self) -> Vec<Parameter> {
        let of_group = |g: &'a Group| g.coefficients.iter().map(|i| g.problem.parameters()[*i].clone());
        let of_effect = |e: &&'static dyn Effect| {
            let copies = if e.of_the_measurement() { self.campaign.recordings().len() } else { 1 };
            (0..copies).flat_map(|_| e.coefficients()).collect::<Vec<_>>()
        };
        self.base.groups().iter().flat_map(of_group).chain(self.effects.iter().flat_map(of_effect)).collect()
    }

    /// For every coefficient, true where it belongs to the device and not to the measurement.
    pub fn device_coefficients(&self) -> Vec<bool> {
        let mut found = vec![true; self.base_coefficients()];
        for effect in &self.effects {
            let own = effect.of_the_measurement();
            let copies = if own { self.campaign.recordings().len() } else { 1 };
            found.extend(vec![!own; copies * effect.coefficients().len()]);
        }
        found
    }

    /// Number of linear coefficients of the base.
    pub fn base_coefficients(&self) -> usize {
        self.base.groups().iter().map(|g| g.coefficients.len()).sum()
    }

    /// Shapes in their units from the unit box.
    pub fn physical(&self, unit: &[f64]) -> Vec<f64> {
        let value = |(p, u): (&Parameter, &f64)| match p.scale {
            Scale::Linear => p.lower + u * (p.upper - p.lower),
            Scale::Log => p.lower * (p.upper / p.lower).powf(*u),
        };
        self.boxes.iter().zip(unit).map(value).collect()
    }

    /// Shapes in the unit box.
    pub fn unit(&self, shapes: &[f64]) -> Vec<f64> {
        let value = |(p, value): (&Parameter, &f64)| match p.scale {
            Scale::Linear => ((value - p.lower) / (p.upper - p.lower)).clamp(0.0, 1.0),
            Scale::Log => ((value.max(p.lower) / p.lower).ln() / (p.upper / p.lower).ln()).clamp(0.0, 1.0),
        };
        self.boxes.iter().zip(shapes).map(value).collect()
    }

    /// True where a nonlinear parameter bears on a recording.
    pub fn bears(&self, shape: usize, recording: usize) -> bool {
        let mut next = 0;
        for group in self.base.groups() {
            next += group.shapes.len();
            if shape < next {
                return group.members.contains(&recording);
            }
        }
        true
    }

    /// Force in N of every recording.
    pub fn force(&self, unit: &[f64], coefficients: &[f64]) -> Vec<Vec<f64>> {
        let shapes = self.physical(unit);
        (0..self.campaign.recordings().len())
            .map(|r| self.columns(r, &shapes).force(coefficients))
            .collect()
    }

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
        let mut found = Columns::default();
        let parts = self.base_columns(r, shapes, &scene, &shape_of, &mut found);
        for (effect, shape) in self.effects.iter().zip(&shape_of) {
            if let Some(factors) = effect.factors(&scene, shape) {
                scale(&factors, &parts, &mut found);
            }
        }
        self.effect_columns(r, &scene, &shape_of, &mut found);
        found
    }

    fn base_columns(
        &self,
        r: usize,
        shapes: &[f64],
        scene: &Scene,
        shape_of: &[&[f64]],
        found: &mut Columns,
    ) -> Vec<Part> {
        let groups = match self.base {
            Base::Given(force) => {
                found.given = Some(force[r].clone());
                return Vec::new();
            }
            Base::Fitted(groups) => groups,
        };
        let (mut coefficient, mut shape) = (0, 0);
        for group in groups {
            if group.members.contains(&r) {
                let mut values = vec![0.0; group.problem.parameters().len()];
                for (k, place) in group.shapes.iter().enumerate() {
                    values[*place] = shapes[shape + k];
                }
                let (model, law) = (group.problem.model(), group.problem.law());
                let recording = &self.campaign.recordings()[r];
                let (motion, current) = self.seen(scene, shape_of);
                found.columns = if motion.is_some() || current.is_some() {
                    let motion = motion.unwrap_or_else(|| Motion {
                        displacement: scene.displacement.to_vec(),
                        velocity: scene.velocity.to_vec(),
                    });
                    let seen = recording.seen_with(motion.displacement, motion.velocity, current);
                    law.columns(model, &seen, &values)
                } else {
                    law.columns(model, recording, &values)
                };
                found.places = (coefficient..coefficient + group.coefficients.len()).collect();
                return law.parts(model);
            }
            coefficient += group.coefficients.len();
            shape += group.shapes.len();
        }
        Vec::new()
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

fn scale(factors: &Factors, parts: &[Part], found: &mut Columns) {
    let times = |column: &mut Vec<f64>, factor: &[f64]| {
        for (value, factor) in column.iter_mut().zip(factor) {
            *value *= factor;
        }
    };
    if let Some(given) = &mut found.given {
        times(given, &factors.stiffness);
    }
    for (column, part) in found.columns.iter_mut().zip(parts) {
        match (part, &factors.damping) {
            (Part::Stiffness, _) => times(column, &factors.stiffness),
            (Part::Damping, Some(damping)) => times(column, damping),
            _ => {}
        }
    }
}
