//! A validated recording of a device: time, displacement, velocity, force, current, temperature.
//!
//! Units: millimetre, newton, second, ampere, degree Celsius.

pub(crate) mod check;
mod condition;
mod cut;
mod grid;
mod past;
mod ready;
mod slopes;

use std::ops::Range;

pub use condition::Condition;
pub(crate) use grid::even_step;
pub use past::Past;
pub use slopes::with_slopes;

use crate::error::{Error, Result};
use crate::kernel::state_change::StateChange;
use crate::velocity;

/// Fewest samples from which a velocity and five parameters can be told.
pub const MIN_SAMPLES: usize = 8;

/// Largest absolute value of a sample, in any unit: products of several of them stay finite.
pub const LARGEST: f64 = 1e30;

/// Least range of the displacement in mm, and least force in N that can be identified: squares of less
/// would soon be zero.
pub const SMALLEST: f64 = 1e-30;

/// What a recording is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Time in s, strictly increasing; need not be uniform. Times that only rounding takes off an even grid are put
    /// back on it.
    pub time: Vec<f64>,
    /// Displacement in mm.
    pub displacement: Vec<f64>,
    /// Velocity in mm/s; `None`: derived from the displacement.
    pub velocity: Option<Vec<f64>>,
    /// Restoring force in N; `None` for an excitation to simulate.
    pub force: Option<Vec<f64>>,
    /// Force of a user's own simulation in N.
    pub simulated: Option<Vec<f64>>,
    /// Coil current in A.
    pub current: Condition,
    /// Temperature in degC.
    pub temperature: Condition,
    /// Name in messages and tables.
    pub name: String,
}

/// A recording that passed every check. Immutable.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    series: Series,
    velocity: Vec<f64>,
    velocity_window: Option<f64>,
    scored: Range<usize>,
    state_change: Option<StateChange>,
    start: f64,
    past: Option<Past>,
    ready: ready::Ready,
}

impl Recording {
    /// Check the series, put times that a file rounded back on their even grid, and derive the velocity where it is
    /// missing.
    ///
    /// # Errors
    /// Different lengths, fewer than [`MIN_SAMPLES`], a value that is not finite or beyond [`LARGEST`], time
    /// that does not increase, or a displacement that changes by less than [`SMALLEST`].
    pub fn new(mut series: Series) -> Result<Self> {
        let name = series.name.clone();
        check::series(&series).map_err(|error| error.in_recording(&name))?;
        series.time = grid::unrounded(series.time);
        let (velocity, velocity_window) = match series.velocity.take() {
            Some(measured) => (measured, None),
            None => derived(&series).map(|(velocity, window)| (velocity, Some(window)))?,
        };
        let scored = 0..velocity.len();
        let (state_change, start, past, ready) = (None, 0.0, None, ready::Ready::default());
        Ok(Self { series, velocity, velocity_window, scored, state_change, start, past, ready })
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.velocity.len()
    }

    /// Never true: a recording has at least [`MIN_SAMPLES`] samples.
    pub fn is_empty(&self) -> bool {
        self.velocity.is_empty()
    }

    /// Time in s.
    pub fn time(&self) -> &[f64] {
        &self.series.time
    }

    /// Displacement in mm.
    pub fn displacement(&self) -> &[f64] {
        &self.series.displacement
    }

    /// Velocity in mm/s, measured or derived.
    pub fn velocity(&self) -> &[f64] {
        &self.velocity
    }

    /// Force in N, if the recording has one.
    pub fn force(&self) -> Option<&[f64]> {
        self.series.force.as_deref()
    }

    /// Force of a user's own simulation in N, if there is one.
    pub fn simulated(&self) -> Option<&[f64]> {
        self.series.simulated.as_deref()
    }

    /// Coil current in A.
    pub fn current(&self) -> &Condition {
        &self.series.current
    }

    /// Temperature in degC.
    pub fn temperature(&self) -> &Condition {
        &self.series.temperature
    }

    /// Name in messages and tables.
    pub fn name(&self) -> &str {
        &self.series.name
    }

    /// Length in s of the window from which the velocity was derived; `None` where it was measured.
    pub fn velocity_window(&self) -> Option<f64> {
        self.velocity_window
    }

    /// Step in s of the even grid that the times are on.
    ///
    /// # Errors
    /// As [`even_step`].
    pub(crate) fn even_step(&self) -> std::result::Result<f64, usize> {
        even_step(&self.series.time)
    }

    /// True where a step of time is the same everywhere, but for rounding.
    pub fn evenly_sampled(&self) -> bool {
        self.even_step().is_ok()
    }

    /// Samples per second: of the even grid, or else from the median time step.
    pub fn sampling_rate(&self) -> f64 {
        if let Ok(step) = self.even_step() {
            return 1.0 / step;
        }
        let mut steps: Vec<f64> = self.series.time.windows(2).map(|pair| pair[1] - pair[0]).collect();
        steps.sort_by(f64::total_cmp);
        1.0 / steps[steps.len() / 2]
    }

    /// The samples that count in a fitness. All of them take part in a simulation, so that a
    /// hysteretic variable keeps its history through an excluded start.
    pub fn scored(&self) -> Range<usize> {
        self.scored.clone()
    }

    /// The recording with another range of samples that count.
    ///
    /// # Errors
    /// A range with fewer than [`MIN_SAMPLES`] samples or outside the recording.
    pub fn with_scored(&self, scored: Range<usize>) -> Result<Self> {
        if scored.end > self.len() || scored.len() < MIN_SAMPLES {
            return Err(Error::setting(
                "range of samples to score",
                format!("{}..{}", scored.start, scored.end),
                format!("at least {MIN_SAMPLES} samples within 0..{}", self.len()),
            )
            .in_recording(self.name()));
        }
        Ok(Self { scored, ..self.clone() })
    }

    /// The same recording with the velocity window and the range of another that it was copied from.
    ///
    /// # Errors
    /// As [`Recording::with_scored`].
    pub fn restored(&self, velocity_window: Option<f64>, scored: Range<usize>) -> Result<Self> {
        Ok(Self { velocity_window, ..self.with_scored(scored)? })
    }

    /// The same motion with another force in N, one value a sample.
    pub(crate) fn with_force(&self, force: Vec<f64>) -> Self {
        let series = Series { force: Some(force), ..self.series.clone() };
        Self { series, ..self.clone() }
    }

    /// The same motion with another amplitude, without force.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        let times = |values: &[f64]| values.iter().map(|v| factor * v).collect();
        let displacement = times(&self.series.displacement);
        let series = Series { displacement, force: None, ..self.series.clone() };
        Self { series, velocity: times(&self.velocity), ready: ready::Ready::default(), ..self.clone() }
    }

    /// The same recording at another current in A.
    ///
    /// # Errors
    /// Not one value a sample, or one that is not finite or beyond [`LARGEST`].
    pub fn at_current(&self, current: Vec<f64>) -> Result<Self> {
        if current.len() != self.len() {
            let wanted = format!("wanted {}, one a sample", self.len());
            return Err(Error::setting("number of currents", current.len(), wanted).in_recording(self.name()));
        }
        check::usable("current", &current).map_err(|error| error.in_recording(self.name()))?;
        Ok(self.seen_with(self.displacement().to_vec(), self.velocity.clone(), Some(current)))
    }

    /// The same recording with another motion, and another current where given; all of one length.
    pub(crate) fn seen_with(
        &self,
        displacement: Vec<f64>,
        velocity: Vec<f64>,
        current: Option<Vec<f64>>,
    ) -> Self {
        let mut seen = self.clone();
        seen.series.displacement = displacement;
        seen.velocity = velocity;
        seen.ready = ready::Ready::default();
        if let Some(current) = current {
            seen.series.current = Condition::Series(current);
        }
        seen
    }

    /// The same recording of a device the law of whose hysteretic state changes further.
    pub(crate) fn with_state_changed(self, by: Option<StateChange>) -> Self {
        let state_change = self.state_change.into_iter().chain(by).reduce(StateChange::and);
        Self { state_change, ..self }
    }

    /// The same recording of a device whose normalised hysteretic variable is not zero at the first sample.
    pub(crate) fn starting_at(self, start: f64) -> Self {
        Self { start, ..self }
    }

    /// The normalised hysteretic variable at the first sample.
    pub(crate) fn start(&self) -> f64 {
        self.start
    }

    /// What is changed of the law of the hysteretic state of the device; `None`: nothing.
    pub(crate) fn state_change(&self) -> Option<StateChange> {
        self.state_change
    }
}

/// Velocity in mm/s derived from the displacement, and the length in s of its window.
fn derived(series: &Series) -> Result<(Vec<f64>, f64)> {
    let derived = velocity::from_displacement(&series.time, &series.displacement);
    check::usable("velocity from the displacement", &derived.velocity)
        .map_err(|error| error.in_recording(&series.name))?;
    let window = derived.window(&series.time);
    Ok((derived.velocity, window))
}

/// Arithmetic mean.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Smallest and largest value.
pub(crate) fn extent(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}
