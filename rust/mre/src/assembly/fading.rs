//! What may be left of unknown hysteretic variables of a base where recordings start in motion.

use std::sync::Arc;

use super::base_columns::BaseColumns;
use super::layout::Assembly;
use crate::effect::{STARTS, starts_in_motion};
use crate::physics::Part;
use crate::recording::Recording;

impl Assembly<'_> {
    /// The same with what may be left of hysteretic variables of its base at these shapes.
    #[must_use]
    pub(crate) fn fading(&self, shapes: &[f64]) -> Self {
        if !self.base.is_hysteretic() {
            return self.clone();
        }
        let own = &shapes[..self.base_shapes()];
        let of_one = |(r, recording): (usize, &Arc<Recording>)| {
            if starts_in_motion(recording) { self.fading_in(r, recording, own) } else { Vec::new() }
        };
        let fading = self.campaign.recordings().iter().enumerate().map(of_one).collect();
        Self { fading: Arc::new(fading), known: None, ..self.clone() }
    }

    fn fading_in(&self, r: usize, recording: &Recording, own: &[f64]) -> Vec<Vec<f64>> {
        let starts = [0.0].into_iter().chain(STARTS);
        let seen: Vec<Recording> = starts.map(|start| recording.clone().starting_at(start)).collect();
        let jobs: Vec<(usize, &[f64], &Recording)> = seen.iter().map(|seen| (r, own, seen)).collect();
        let traces: Vec<Vec<f64>> = self.base_columns(&jobs).iter().map(hysteretic).collect();
        let Some((from_rest, others)) = traces.split_first() else { return Vec::new() };
        let less = |trace: &Vec<f64>| trace.iter().zip(from_rest).map(|(w, rest)| w - rest).collect();
        let mut fading: Vec<Vec<f64>> = others.iter().map(less).collect();
        let largest = fading.iter().flatten().fold(0.0_f64, |largest, w| largest.max(w.abs()));
        // Samples too far apart for these parameters show nothing of it.
        let whole = fading.iter().all(|w| w.len() == recording.len());
        if !whole || largest <= 0.0 || fading.iter().flatten().any(|w| !w.is_finite()) {
            return Vec::new();
        }
        fading.iter_mut().flatten().for_each(|w| *w /= largest);
        fading
    }
}

/// What is hysteretic of the columns of a base.
fn hysteretic(base: &BaseColumns) -> Vec<f64> {
    let samples = base.columns.first().map_or(0, Vec::len);
    let mut sum = vec![0.0; samples];
    for (column, part) in base.columns.iter().zip(&base.parts) {
        if *part == Part::Hysteretic {
            sum.iter_mut().zip(column).for_each(|(sum, w)| *sum += w);
        }
    }
    sum
}
