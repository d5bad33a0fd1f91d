//! A part of a recording.

use super::{Condition, MIN_SAMPLES, Recording, Series};
use crate::error::{Error, Result};

impl Recording {
    /// The part between two times in s. What is cut off is forgotten: a simulation of the rest
    /// starts rested. Of a specimen with a past, it belongs to that.
    ///
    /// # Errors
    /// Fewer than [`MIN_SAMPLES`] samples or no motion left; no force, of a specimen with a past.
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
        cut.past = self.past_at(range.start)?;
        let scored = self.scored.start.max(range.start)..self.scored.end.min(range.end);
        cut.with_scored(scored.start.saturating_sub(range.start)..scored.end.saturating_sub(range.start))
    }
}
