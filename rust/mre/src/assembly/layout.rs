//! Which parameters an assembly has, and in which order.

use std::ops::Range;
use std::sync::Arc;

use super::base::{Base, Group};
use super::campaign::Campaign;
use super::columns::{Columns, Known};
use crate::effect::{Effect, Flexibility, Scene};
use crate::parameter::{Parameter, Scale};
use crate::recording::Recording;

/// A base and effects on the recordings of a campaign.
#[derive(Clone)]
pub struct Assembly<'a> {
    pub(super) campaign: &'a Campaign,
    pub(super) base: &'a Base,
    pub(super) effects: Vec<&'static dyn Effect>,
    /// Force of the base model alone, by recording.
    pub(super) reference: Arc<Vec<Vec<f64>>>,
    /// Force of the device with all its effects, by recording.
    pub(super) whole: Arc<Vec<Vec<f64>>>,
    /// What may be left of unknown hysteretic variables of the base, by recording; none are known at first.
    pub(super) fading: Arc<Vec<Vec<Vec<f64>>>>,
    pub(super) boxes: Vec<Parameter>,
    pub(super) known: Option<Arc<Known>>,
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
        let whole = reference.clone();
        let fading = Arc::new(vec![Vec::new(); campaign.recordings().len()]);
        Self { campaign, base, effects, reference, whole, fading, boxes, known: None }
    }

    /// The same base with other effects.
    #[must_use]
    pub fn with(&self, effects: Vec<&'static dyn Effect>) -> Self {
        let known = self.known.clone();
        let (whole, fading) = (self.whole.clone(), self.fading.clone());
        Self { whole, fading, known, ..Self::new(self.campaign, self.base, effects, self.reference.clone()) }
    }

    /// The same, with what belongs to these shapes at hand.
    pub(crate) fn knowing(&self, shapes: &[f64]) -> Self {
        if self.knows(shapes) {
            return self.clone();
        }
        let own = &shapes[..self.base_shapes()];
        let columns = match &self.known {
            Some(known) if known.shapes == own && self.serves(&known.columns) => known.columns.clone(),
            // The base sees another motion than the recorded one.
            _ if self.sees_otherwise(0, shapes) => Vec::new(),
            _ => {
                let recordings = 0..self.campaign.recordings().len();
                let jobs: Vec<(usize, &[f64], &Recording)> =
                    recordings.map(|r| (r, own, self.unaltered(r))).collect();
                self.base_columns(&jobs)
            }
        };
        let known = Known { shapes: own.to_vec(), columns, effects: self.added(shapes) };
        Self { known: Some(Arc::new(known)), ..self.clone() }
    }

    /// The same with another force of the base model alone, which is also what is known of the whole device.
    #[must_use]
    pub fn referring_to(&self, reference: Vec<Vec<f64>>) -> Self {
        let reference = Arc::new(reference);
        Self { whole: reference.clone(), reference, known: None, ..self.clone() }
    }

    /// The same with the force of the whole device at these parameters.
    #[must_use]
    pub fn seeing_its_force(&self, unit: &[f64], coefficients: &[f64]) -> Self {
        let recordings = 0..self.campaign.recordings().len();
        let whole = recordings.map(|r| self.force_seen(r, unit, coefficients)).collect();
        Self { whole: Arc::new(whole), known: None, ..self.clone() }
    }

    /// Force in N of the whole device in a recording, as near as what is known of it leads.
    pub(super) fn force_seen(&self, r: usize, unit: &[f64], coefficients: &[f64]) -> Vec<f64> {
        self.force_of_the_device(r, &self.physical(unit), &self.of_the_device(coefficients))
    }

    /// Coefficients with zeros for what belongs to the measurement.
    pub(super) fn of_the_device(&self, coefficients: &[f64]) -> Vec<f64> {
        let device = self.device_coefficients();
        coefficients.iter().zip(device).map(|(c, d)| if d { *c } else { 0.0 }).collect()
    }

    /// What the force of the device takes from its motion; `None`: nothing follows from it.
    pub fn flexibility(&self, shapes: &[f64]) -> Option<Flexibility> {
        let own = self.effects.iter().zip(self.shape_of(shapes));
        own.filter_map(|(effect, shape)| effect.flexibility(shape)).reduce(Flexibility::and)
    }

    /// True where an effect cuts the measured force off.
    pub fn clips(&self, shapes: &[f64]) -> bool {
        self.effects.iter().zip(self.shape_of(shapes)).any(|(effect, shape)| effect.clip(shape).is_some())
    }

    /// What effects see of a recording.
    pub fn scene(&self, r: usize) -> Scene<'_> {
        Scene { fading: &self.fading[r], ..self.campaign.scene(r, &self.reference[r], &self.whole[r]) }
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
        let of_effect =
            |e: &&'static dyn Effect| (0..self.copies(*e)).flat_map(|_| e.coefficients()).collect::<Vec<_>>();
        self.base.groups().iter().flat_map(of_group).chain(self.effects.iter().flat_map(of_effect)).collect()
    }

    /// For every coefficient the inverse of the variance that it is known to have.
    pub(crate) fn known_of_coefficients(&self) -> Vec<f64> {
        let mut found = vec![0.0; self.base_coefficients()];
        for effect in &self.effects {
            let known = effect.known_of_coefficients(self.campaign.sizes());
            found.extend(vec![known; self.copies(*effect) * effect.coefficients().len()]);
        }
        found
    }

    /// For every coefficient, true where it belongs to the device and not to the measurement.
    pub fn device_coefficients(&self) -> Vec<bool> {
        let mut found = vec![true; self.base_coefficients()];
        for effect in &self.effects {
            let own = effect.of_the_measurement();
            found.extend(vec![!own; self.copies(*effect) * effect.coefficients().len()]);
        }
        found
    }

    /// How often the coefficients of an effect stand in the model.
    pub(super) fn copies(&self, effect: &dyn Effect) -> usize {
        if effect.of_the_measurement() { self.campaign.recordings().len() } else { 1 }
    }

    /// Where the coefficients and the shapes of an effect stand among all.
    pub fn of_effect(&self, place: usize) -> (Range<usize>, Range<usize>) {
        let count = |e: &&'static dyn Effect| {
            (self.copies(*e) * e.coefficients().len(), e.shape(self.campaign.sizes()).len())
        };
        let sum = |(c, s): (usize, usize), (more, shapes): (usize, usize)| (c + more, s + shapes);
        let before = self.effects[..place].iter().map(count);
        let (c, s) = before.fold((self.base_coefficients(), self.base_shapes()), sum);
        let (coefficients, shapes) = count(&self.effects[place]);
        (c..c + coefficients, s..s + shapes)
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

    /// Force in N of the base alone in every recording, at the parameters of the assembly.
    pub fn base_force(&self, unit: &[f64], coefficients: &[f64]) -> Vec<Vec<f64>> {
        (0..self.campaign.recordings().len()).map(|r| self.base_force_in(r, unit, coefficients)).collect()
    }

    /// The same in one of them.
    pub(super) fn base_force_in(&self, r: usize, unit: &[f64], coefficients: &[f64]) -> Vec<f64> {
        self.alone(r, coefficients, |base| base.columns(r, &base.physical(&unit[..base.base_shapes()])))
    }

    /// The same from columns of the base.
    pub(super) fn alone(
        &self,
        r: usize,
        coefficients: &[f64],
        columns: impl FnOnce(&Self) -> Columns,
    ) -> Vec<f64> {
        if let Base::Held(kept) = self.base {
            return kept.alone(&self.campaign.recordings()[r]);
        }
        let base = self.with(Vec::new());
        columns(&base).force(&coefficients[..base.base_coefficients()])
    }
}
