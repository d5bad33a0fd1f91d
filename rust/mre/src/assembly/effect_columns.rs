//! What the effects of an assembly do to a recording: to the force of the device, and to what is measured of it.

use super::columns::{Columns, Moved};
use super::layout::Assembly;
use crate::effect::{Effect, Scene};

impl Assembly<'_> {
    /// What effects add to the force, and channels through which it goes.
    /// Columns of the base, which come first, may be known `between` the samples as well.
    pub(super) fn effect_columns(
        &self,
        r: usize,
        scene: &Scene,
        shape_of: &[&[f64]],
        mut between: Vec<Vec<f64>>,
        found: &mut Columns,
    ) {
        let moved = self.moved(shape_of);
        // Nobody asks for what one alone does to the motion but the base.
        let several = self.effects.len() > moved.len();
        let motion = if several { self.motion_of_the_device(scene, shape_of) } else { None };
        let device = &motion.as_ref().map_or(*scene, |motion| scene.moved(motion));
        for (effect, shape, first) in self.placed(shape_of) {
            if !effect.of_the_measurement() {
                found.add(first, self.own_columns(effect, shape, (r, device), &moved));
            }
        }
        for (effect, shape) in self.effects.iter().zip(shape_of) {
            let mut passed = false;
            for (i, column) in found.columns.iter_mut().chain(&mut found.given).enumerate() {
                let fine = between.get(i).and_then(|halves| effect.through_halves(scene, shape, halves));
                if let Some(measured) = fine.or_else(|| effect.through(scene, shape, column)) {
                    *column = measured;
                    passed = true;
                }
            }
            if passed {
                between.clear();
            }
        }
    }

    /// What is measured of the force of a device.
    pub(super) fn measure(&self, r: usize, shapes: &[f64], found: &mut Columns) {
        let (scene, shape_of) = (self.scene(r), self.shape_of(shapes));
        for (effect, shape) in self.effects.iter().zip(&shape_of) {
            if let Some(shown) = effect.shown(&scene, shape) {
                for column in found.columns.iter_mut().chain(&mut found.given) {
                    column.iter_mut().zip(&shown).for_each(|(value, share)| *value *= share);
                }
            }
            if let Some((low, high)) = effect.clip(shape) {
                found.clip = Some(found.clip.map_or((low, high), |(l, h)| (low.max(l), high.min(h))));
            }
        }
        for (effect, shape, first) in self.placed(&shape_of) {
            if effect.of_the_measurement() {
                let columns = self.own_columns(effect, shape, (r, &scene), &Moved::new());
                found.add(first + r * columns.len(), columns);
            }
        }
    }

    /// Effects with their shapes and the place of their first coefficient.
    fn placed<'s>(
        &self,
        shape_of: &'s [&'s [f64]],
    ) -> impl Iterator<Item = (&'static dyn Effect, &'s [f64], usize)> {
        let mut next = self.base_coefficients();
        self.effects.iter().zip(shape_of).map(move |(effect, shape)| {
            let first = next;
            next += effect.coefficients().len() * self.copies(*effect);
            (*effect, *shape, first)
        })
    }

    /// Columns of an effect; taken over where they are known.
    fn own_columns(
        &self,
        effect: &dyn Effect,
        shape: &[f64],
        (r, scene): (usize, &Scene),
        moved: &Moved,
    ) -> Vec<Vec<f64>> {
        let known = self.known.as_ref().and_then(|known| known.columns_of(effect, shape, moved));
        known.map_or_else(|| effect.columns(scene, shape), |known| known[r].clone())
    }
}
