//! The columns of an assembly on one recording.

use std::borrow::Cow;

use rayon::prelude::*;

use super::base::Base;
use super::base_columns::BaseColumns;
use super::in_series::InSeries;
use super::layout::Assembly;
use crate::effect::{About, Effect, Factors, Motion};
use crate::physics::Part;

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

/// Laws by which the device moves otherwise than was measured, with their shapes.
pub(super) type Moved = Vec<(About, Vec<f64>)>;

/// What an effect at some shape adds to or scales in every recording.
pub(super) struct Added {
    of: About,
    shape: Vec<f64>,
    /// What made the device move otherwise then.
    moved: Moved,
    pub(super) columns: Vec<Vec<Vec<f64>>>,
    factors: Vec<Option<Factors>>,
}

impl Known {
    fn added(&self, effect: &dyn Effect, shape: &[f64]) -> Option<&Added> {
        self.effects.iter().find(|known| known.shape == shape && known.of == effect.about())
    }

    /// The columns of an effect beside what makes the device move otherwise.
    pub(super) fn columns_of(
        &self,
        effect: &dyn Effect,
        shape: &[f64],
        moved: &Moved,
    ) -> Option<&[Vec<Vec<f64>>]> {
        let same = |known: &&Added| effect.of_the_measurement() || known.moved == *moved;
        self.added(effect, shape).filter(same).map(|known| known.columns.as_slice())
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
    pub(super) fn with_effects(&self, r: usize, shapes: &[f64], base: BaseColumns) -> Columns {
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
        if let Some(flexibility) = self.flexibility(shapes).filter(|f| f.gives_way()) {
            let whole = &self.whole[r];
            let rig = InSeries::new(&self.campaign.recordings()[r], whole, whole, flexibility);
            rig.pass(whole, &mut found);
        }
        found
    }

    /// What each effect adds at these shapes.
    pub(super) fn added(&self, shapes: &[f64]) -> Vec<Added> {
        let shape_of = self.shape_of(shapes);
        let recordings = (0..self.campaign.recordings().len()).into_par_iter();
        let of_the_device = |r: usize| self.motion_of_the_device(&self.scene(r), &shape_of);
        let motions: Vec<Option<Motion>> = recordings.clone().map(of_the_device).collect();
        let moved = self.moved(&shape_of);
        let of_effect = |(effect, shape): (&&'static dyn Effect, &&[f64])| {
            let of = |r: usize| {
                let measured = self.scene(r);
                let motion = motions[r].as_ref().filter(|_| !effect.of_the_measurement());
                let scene = motion.map_or(measured, |motion| measured.moved(motion));
                (effect.columns(&scene, shape), effect.factors(&measured, shape))
            };
            let (columns, factors) = recordings.clone().map(of).unzip();
            Added { of: effect.about(), shape: shape.to_vec(), moved: moved.clone(), columns, factors }
        };
        self.effects.iter().zip(&shape_of).map(of_effect).collect()
    }

    /// What makes the device move otherwise than was measured.
    pub(super) fn moved(&self, shape_of: &[&[f64]]) -> Moved {
        let moving = self.effects.iter().zip(shape_of).filter(|(effect, _)| effect.moves_the_device());
        moving.map(|(effect, shape)| (effect.about(), shape.to_vec())).collect()
    }

    /// True where all of this is at hand.
    pub(super) fn knows(&self, shapes: &[f64]) -> bool {
        self.known.as_ref().is_some_and(|known| {
            known.shapes == shapes[..self.base_shapes()] && self.serves(&known.columns) && {
                let shape_of = self.shape_of(shapes);
                let moved = self.moved(&shape_of);
                self.effects.iter().zip(shape_of).all(|(e, s)| known.columns_of(*e, s, &moved).is_some())
            }
        })
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
}

fn scale(factors: &Factors, parts: &[Part], columns: &mut [Vec<f64>]) {
    for (column, part) in columns.iter_mut().zip(parts) {
        let Some(factor) = factors.on(*part) else { continue };
        for (value, factor) in column.iter_mut().zip(factor) {
            *value *= factor;
        }
    }
}
