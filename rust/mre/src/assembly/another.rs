//! Assemblies with one more recording, of which nothing is known yet.

use std::sync::Arc;

use super::base::Base;
use super::base_columns::BaseColumns;
use super::campaign::Campaign;
use super::columns::Columns;
use super::in_series::InSeries;
use super::layout::Assembly;
use super::simulate::{PASSES, distance};
use crate::effect::Flexibility;

/// Share of a force, rms, by which two that agree differ.
const AGREED: f64 = 1e-6;

/// A model on a campaign with one recording more at its end.
pub(crate) struct OnAnother<'w> {
    pub(crate) assembly: Assembly<'w>,
    /// Shapes in their units.
    shapes: Vec<f64>,
    /// Columns of the base alone there.
    base: BaseColumns,
    /// The same as effects let it see the recording, where that does not follow the force.
    seen: Option<BaseColumns>,
}

impl<'w> OnAnother<'w> {
    /// Models at shapes of the unit box and coefficients, with the base on the wider campaign; what their effects see of
    /// the other recordings stays. Bases are made side by side, which is cheaper than one by one.
    pub(crate) fn all(
        models: &[(&Assembly, &[f64], &[f64])],
        (campaign, base): (&'w Campaign, &'w Base),
    ) -> Vec<Self> {
        let last = campaign.recordings().len() - 1;
        let wider: Vec<Assembly<'w>> = models.iter().map(|(of, ..)| of.wider(campaign, base)).collect();
        let shapes: Vec<Vec<f64>> =
            wider.iter().zip(models).map(|(wider, (_, unit, _))| wider.physical(unit)).collect();
        let bases = bases(&wider, &shapes);
        let all = wider.into_iter().zip(shapes).zip(bases).zip(models);
        all.map(|(((assembly, shapes), base), (.., coefficients))| {
            let of_base =
                |alone: &Assembly| alone.with_effects(last, &shapes[..alone.base_shapes()], base.clone());
            let alone = assembly.alone(last, coefficients, of_base);
            let mut model = Self { assembly, shapes, base, seen: None };
            model.see(alone, coefficients);
            model
        })
        .collect()
    }

    /// Force in N that is measured in the last recording.
    pub(crate) fn measured(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut columns = self.columns();
        self.assembly.measure(self.last(), &self.shapes, &mut columns);
        columns.measured(coefficients)
    }

    /// Let effects see the force of the base alone in the last recording, and that of the device that follows.
    fn see(&mut self, alone: Vec<f64>, coefficients: &[f64]) {
        let last = self.last();
        let flexibility = self.flexibility();
        let recording = &self.assembly.campaign().recordings()[last];
        let whole = InSeries::first(recording, &alone, flexibility.unwrap_or_default());
        Arc::make_mut(&mut self.assembly.whole)[last] = whole;
        Arc::make_mut(&mut self.assembly.reference)[last] = alone;
        if flexibility.is_none() {
            self.seen = Some(self.as_seen());
        }
        let own = self.assembly.of_the_device(coefficients);
        for _ in 0..PASSES {
            let force = self.columns().force(&own);
            let off = distance(&self.assembly.whole[last], &force);
            Arc::make_mut(&mut self.assembly.whole)[last] = force;
            if flexibility.is_none() || off <= AGREED {
                break;
            }
        }
    }

    /// Columns of the device in the last recording.
    fn columns(&self) -> Columns {
        let base = self.seen.clone().unwrap_or_else(|| self.as_seen());
        self.assembly.with_effects(self.last(), &self.shapes, base)
    }

    /// Columns of the base as effects let it see the last recording.
    fn as_seen(&self) -> BaseColumns {
        let (assembly, last) = (&self.assembly, self.last());
        if assembly.sees_otherwise(last, &self.shapes) || assembly.asks_between() {
            assembly.base_seen(&[(last, &self.shapes)]).pop().unwrap_or_default()
        } else {
            self.base.clone()
        }
    }

    fn flexibility(&self) -> Option<Flexibility> {
        self.assembly.flexibility(&self.shapes)
    }

    fn last(&self) -> usize {
        self.assembly.campaign().recordings().len() - 1
    }
}

/// Columns of the base alone in the last recording, at the shapes of each model.
fn bases(models: &[Assembly], shapes: &[Vec<f64>]) -> Vec<BaseColumns> {
    let Some(plain) = models.first().map(|first| first.with(Vec::new())) else { return Vec::new() };
    let last = plain.campaign().recordings().len() - 1;
    let own = plain.base_shapes();
    let jobs: Vec<(usize, &[f64])> = shapes.iter().map(|shapes| (last, &shapes[..own])).collect();
    plain.base_seen(&jobs)
}

impl Assembly<'_> {
    /// A model on a campaign with one recording more, in which nothing has a force.
    fn wider<'w>(&self, campaign: &'w Campaign, base: &'w Base) -> Assembly<'w> {
        let nothing = campaign.recordings().last().map_or(Vec::new(), |last| vec![0.0; last.len()]);
        let with = |known: &[Vec<f64>]| Arc::new(known.iter().cloned().chain([nothing.clone()]).collect());
        let wider = Assembly::new(campaign, base, self.effects.clone(), with(&self.reference));
        let fading = self.fading.iter().cloned().chain([Vec::new()]).collect();
        Assembly { whole: with(&self.whole), fading: Arc::new(fading), ..wider }
    }
}
