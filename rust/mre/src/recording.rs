//! A validated recording of a device: time, displacement, velocity, force, current, temperature.
//!
//! Units: millimetre, newton, second, ampere, degree Celsius.

use std::ops::Range;

use crate::error::{Error, Result};
use crate::velocity;

/// Fewest samples from which a velocity and five parameters can be told.
pub const MIN_SAMPLES: usize = 8;

/// A quantity that is not recorded, constant, or recorded sample by sample.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// Not known.
    Missing,
    /// One value for the whole recording.
    Constant(f64),
    /// One value a sample.
    Series(Vec<f64>),
}

impl Condition {
    /// The constant value: given as such, or a measured series that varies by noise only
    /// (standard deviation below 0.01 plus 2 % of the mean).
    pub fn level(&self) -> Option<f64> {
        match self {
            Self::Missing => None,
            Self::Constant(value) => Some(*value),
            Self::Series(values) => {
                let mean = mean(values);
                let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / values.len() as f64;
                (variance.sqrt() <= 0.01 + 0.02 * mean.abs()).then_some(mean)
            }
        }
    }

    /// True where the quantity changes during the recording.
    pub fn varies(&self) -> bool {
        matches!(self, Self::Series(_)) && self.level().is_none()
    }
}

/// What a recording is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Time in s, strictly increasing; need not be uniform.
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
}

impl Recording {
    /// Check the series and derive the velocity where it is missing.
    ///
    /// # Errors
    /// Different lengths, fewer than [`MIN_SAMPLES`], a value that is not finite, time that does not
    /// increase, or a displacement that never changes.
    pub fn new(mut series: Series) -> Result<Self> {
        let name = series.name.clone();
        check(&series).map_err(|error| error.in_recording(&name))?;
        let (velocity, velocity_window) = if let Some(measured) = series.velocity.take() {
            (measured, None)
        } else {
            let derived = velocity::from_displacement(&series.time, &series.displacement);
            (derived.velocity, Some(derived.window))
        };
        let scored = 0..velocity.len();
        Ok(Self { series, velocity, velocity_window, scored })
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

    /// Samples per second, from the median time step.
    pub fn sampling_rate(&self) -> f64 {
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
        Self { series, velocity: times(&self.velocity), ..self.clone() }
    }

    /// The part between two times in s. What is cut off is forgotten: a simulation of the rest
    /// starts rested.
    ///
    /// # Errors
    /// Fewer than [`MIN_SAMPLES`] samples or no motion left.
    pub fn cut(&self, start: f64, stop: f64) -> Result<Self> {
        let time = self.time();
        if start.is_nan() || stop.is_nan() {
            return Err(Error::setting("cut", format!("{start} s to {stop} s"), "two numbers"));
        }
        let range = time.partition_point(|t| *t < start)..time.partition_point(|t| *t <= stop);
        if range.len() < MIN_SAMPLES {
            return Err(Error::setting(
                "cut",
                format!("{start} s to {stop} s"),
                format!(
                    "at least {MIN_SAMPLES} samples have to be left of {} s to {} s",
                    time[0],
                    time[time.len() - 1]
                ),
            )
            .in_recording(self.name()));
        }
        let part = |values: &[f64]| values[range.clone()].to_vec();
        let condition = |c: &Condition| match c {
            Condition::Series(values) => Condition::Series(part(values)),
            other => other.clone(),
        };
        let mut cut = Self::new(Series {
            time: part(time),
            displacement: part(self.displacement()),
            velocity: Some(part(&self.velocity)),
            force: self.force().map(part),
            simulated: self.simulated().map(part),
            current: condition(self.current()),
            temperature: condition(self.temperature()),
            name: self.series.name.clone(),
        })?;
        cut.velocity_window = self.velocity_window;
        let scored = self.scored.start.max(range.start)..self.scored.end.min(range.end);
        cut.with_scored(scored.start.saturating_sub(range.start)..scored.end.saturating_sub(range.start))
    }
}

fn check(series: &Series) -> Result<()> {
    let n = series.time.len();
    if n < MIN_SAMPLES {
        return Err(Error::Recording(format!("{n} samples: at least {MIN_SAMPLES} are needed")));
    }
    finite("time", &series.time)?;
    for (i, pair) in series.time.windows(2).enumerate() {
        if pair[1] <= pair[0] {
            return Err(Error::Time { index: i + 1, before: pair[0], after: pair[1] });
        }
    }
    let mut columns = vec![("displacement", Some(&series.displacement))];
    columns.push(("velocity", series.velocity.as_ref()));
    columns.push(("force", series.force.as_ref()));
    columns.push(("simulated", series.simulated.as_ref()));
    for (what, condition) in [("current", &series.current), ("temperature", &series.temperature)] {
        match condition {
            Condition::Missing => {}
            Condition::Constant(value) => finite(what, std::slice::from_ref(value))?,
            Condition::Series(values) => columns.push((what, Some(values))),
        }
    }
    for (what, values) in columns.into_iter().filter_map(|(what, v)| v.map(|v| (what, v))) {
        if values.len() != n {
            return Err(Error::Length { what, expected: n, got: values.len() });
        }
        finite(what, values)?;
    }
    let (low, high) = extent(&series.displacement);
    if low == high {
        return Err(Error::Recording(format!(
            "displacement is {low} mm throughout: a moving device is needed"
        )));
    }
    Ok(())
}

fn finite(what: &'static str, values: &[f64]) -> Result<()> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(Error::NotFinite { what, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Arithmetic mean.
pub(crate) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Smallest and largest value.
pub(crate) fn extent(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}
