//! A derived motion with corners or bends, calmed between them.

use std::ops::Range;

use super::Derived;
use super::calming::{Calm, Calming};
use super::local::NARROWEST;
use super::smoothing::Smoothing;

/// A recording has so many long parts at most.
const LONG: usize = 4;

/// How noise is taken off a motion with corners: the same way off everything that is added to it.
#[derive(Debug, Clone)]
pub(crate) struct Parts {
    /// Standard deviation of the noise of the measured displacement, mm.
    pub(crate) noise: f64,
    smoothing: Smoothing,
    /// More of what lies between corners.
    calm: Vec<(Range<usize>, Calming)>,
}

impl Parts {
    /// Of a measured displacement in mm.
    pub(crate) fn of(time: &[f64], measured: &[f64], derived: &Derived) -> Self {
        let smoothing = derived.smoothing.clone();
        let variance = smoothing.variance(measured, &derived.displacement);
        // Of fewer samples nothing more can be told.
        let enough = 2 * NARROWEST + 1..time.len();
        let between = smoothing.0.iter().filter(|(part, _)| enough.contains(&part.len()));
        let calm = between.map(|(part, window)| {
            let own = |series: &[f64]| series[part.clone()].to_vec();
            let motion = [own(&derived.displacement), own(&derived.velocity)];
            let measured = [&time[part.clone()], &measured[part.clone()]];
            (part.clone(), Calming::knowing(variance, measured, motion, *window))
        });
        Self { noise: variance.sqrt(), calm: calm.collect(), smoothing }
    }

    /// What it leaves of the displacement in mm that was measured; next to corners the velocity stays as it was derived.
    pub(crate) fn calm(&self, time: &[f64], measured: &[f64], derived: &Derived) -> Calm {
        let plain = self.smoothing.over(time, measured);
        let slopes = plain.0.clone();
        let mut calm = self.calmed(time, measured, plain);
        for (own, (derived, plain)) in calm.velocity.iter_mut().zip(derived.velocity.iter().zip(slopes)) {
            if *derived != plain {
                *own = *derived;
            }
        }
        calm
    }

    /// What it leaves of a displacement in mm.
    pub(crate) fn over(&self, time: &[f64], displacement: &[f64]) -> Calm {
        self.calmed(time, displacement, self.smoothing.over(time, displacement))
    }

    /// The same where the slopes and values of its polynomials are known.
    fn calmed(&self, time: &[f64], displacement: &[f64], (velocity, smooth): (Vec<f64>, Vec<f64>)) -> Calm {
        let mut all = Calm { displacement: smooth, velocity, noisy: Vec::new() };
        for (part, calming) in &self.calm {
            let own = calming.over(&time[part.clone()], &displacement[part.clone()]);
            all.displacement[part.clone()].copy_from_slice(&own.displacement);
            all.velocity[part.clone()].copy_from_slice(&own.velocity);
            // Columns of what was taken off short parts would take off much of a force.
            if LONG * part.len() < time.len() {
                continue;
            }
            let nothing = || [0, 1].map(|_| vec![0.0; time.len()]);
            all.noisy.resize_with(all.noisy.len().max(own.noisy.len()), nothing);
            for (whole, noisy) in all.noisy.iter_mut().flatten().zip(own.noisy.iter().flatten()) {
                whole[part.clone()].copy_from_slice(noisy);
            }
        }
        all
    }
}
