//! What an effect sees of a recording, and the sizes from which its default boxes are made.

use std::sync::OnceLock;

use super::Motion;
use crate::kernel::jumps::jumps_after;
use crate::recording::{Past, Recording};
use crate::velocity;

/// One recording as effects see it. All series have one value a sample.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// Time, s.
    pub time: &'a [f64],
    /// Displacement, mm.
    pub displacement: &'a [f64],
    /// Velocity, mm/s.
    pub velocity: &'a [f64],
    /// Acceleration, which few effects ask for.
    pub acceleration: Acceleration<'a>,
    /// Coil current, A; `None` where it is not known.
    pub current: Option<&'a [f64]>,
    /// Temperature, degC; `None` where it is not known.
    pub temperature: Option<&'a [f64]>,
    /// Force of the base model as fitted without effects, N.
    pub force: &'a [f64],
    /// Force of the device with all its effects, N, as far as it is known: that of the base at first.
    pub whole: &'a [f64],
    /// What may be left of an unknown hysteretic variable of the base at the first sample: none where it starts at rest.
    pub fading: &'a [Vec<f64>],
    /// Time of all recordings before this one in the campaign, s.
    pub before: f64,
    /// What the specimen has been through before.
    pub past: Past,
    /// Sizes over the campaign.
    pub sizes: &'a Sizes,
}

/// Acceleration of a recording, derived when it is asked for.
#[derive(Debug, Clone, Copy)]
pub struct Acceleration<'a> {
    pub(crate) recording: &'a Recording,
    /// Kept for the next that asks.
    pub(crate) known: &'a OnceLock<Vec<f64>>,
}

impl<'a> Acceleration<'a> {
    /// At every sample, mm/s^2.
    pub fn get(self) -> &'a [f64] {
        if let Some(known) = self.known.get() {
            return known;
        }
        // Not while the place is locked: the work is shared with threads that may ask for it as well.
        let (time, velocity) = (self.recording.time(), self.recording.velocity());
        let found = velocity::from_displacement(time, velocity).velocity;
        self.known.get_or_init(|| found)
    }
}

impl Scene<'_> {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// Never true of a recording.
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// The same of a device that has another motion than was measured; the acceleration is the measured one.
    pub fn moved<'s>(&'s self, motion: &'s Motion) -> Scene<'s> {
        Scene { displacement: &motion.displacement, velocity: &motion.velocity, ..*self }
    }

    /// Mean time step, s.
    pub fn step(&self) -> f64 {
        (self.time[self.len() - 1] - self.time[0]) / (self.len() - 1) as f64
    }

    /// Duration, s.
    pub fn duration(&self) -> f64 {
        self.time[self.len() - 1] - self.time[0]
    }

    /// A state that starts at `start` and is carried from sample to sample: `next(state, i)` gives it at
    /// sample `i` from that at sample `i - 1`.
    pub fn trace(&self, start: f64, mut next: impl FnMut(f64, usize) -> f64) -> Vec<f64> {
        let mut state = start;
        (0..self.len())
            .map(|i| {
                if i > 0 {
                    state = next(state, i);
                }
                state
            })
            .collect()
    }
}

/// Sizes are at least this.
const LEAST: f64 = 1e-9;

/// The energy that stays in a device is at least this share of what passes through it.
const LEAST_DISSIPATED: f64 = 0.02;

/// Sizes over a campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Sizes {
    /// Largest absolute displacement, mm.
    pub displacement: f64,
    /// Largest standard deviation of the noise that a displacement had, mm; zero where none had any.
    pub noise: f64,
    /// Largest speed, mm/s.
    pub velocity: f64,
    /// Largest absolute force, N.
    pub force: f64,
    /// Shortest time step, s.
    pub step: f64,
    /// Duration of the longest recording, s.
    pub duration: f64,
    /// Duration of all recordings together, s.
    pub total: f64,
    /// Longest travelled path in a recording, mm.
    pub path: f64,
    /// Most energy that passed through the device in a recording: the largest integral of `|F v|`, N mm.
    pub energy: f64,
    /// Most energy that stayed in it: the largest integral of `F v`, N mm.
    pub dissipated: f64,
    /// Longest path of a specimen in all its recordings over that in one: 1 where each recording has its own.
    pub life: f64,
    /// Lowest and highest current, A, where it is known.
    pub current: Option<(f64, f64)>,
    /// True where the current changes inside a recording, or between recordings that share the parameters of
    /// the base model.
    pub current_varies: bool,
    /// True where it jumps between two samples of a recording.
    pub current_steps: bool,
    /// Lowest and highest temperature, degC, where it is known of all recordings.
    pub temperature: Option<(f64, f64)>,
    /// Step of the lattice on which all forces lie, N, if they do.
    pub quantum: Option<f64>,
}

impl Sizes {
    /// Sizes of recordings with force.
    pub fn of<'a>(recordings: impl Iterator<Item = &'a Recording> + Clone) -> Self {
        let forces: Vec<&[f64]> = recordings.clone().filter_map(Recording::force).collect();
        let mut sizes = Self {
            displacement: 0.0,
            noise: 0.0,
            velocity: 0.0,
            force: 0.0,
            step: f64::INFINITY,
            duration: 0.0,
            total: 0.0,
            path: 0.0,
            energy: 0.0,
            dissipated: 0.0,
            life: 1.0,
            current: None,
            current_varies: false,
            current_steps: false,
            temperature: temperatures(recordings.clone()),
            quantum: super::quantisation::quantum(&forces),
        };
        let mut longest = 0.0_f64;
        let farthest = |values: &[f64]| values.iter().fold(0.0_f64, |far, v| far.max(v.abs()));
        for r in recordings {
            let (time, x, v) = (r.time(), r.displacement(), r.velocity());
            let force = r.force().unwrap_or_default();
            let duration = time[time.len() - 1] - time[0];
            sizes.displacement = sizes.displacement.max(farthest(x));
            sizes.velocity = sizes.velocity.max(farthest(v));
            sizes.force = sizes.force.max(farthest(force));
            sizes.step = sizes.step.min(duration / (time.len() - 1) as f64);
            sizes.duration = sizes.duration.max(duration);
            sizes.total += duration;
            let path: f64 = x.windows(2).map(|p| (p[1] - p[0]).abs()).sum();
            let work =
                || x.windows(2).zip(force.windows(2)).map(|(x, f)| 0.5 * (f[0] + f[1]) * (x[1] - x[0]));
            longest = longest.max(r.past().unwrap_or_default().path + path);
            sizes.path = sizes.path.max(path);
            sizes.energy = sizes.energy.max(work().map(f64::abs).sum());
            sizes.dissipated = sizes.dissipated.max(work().sum());
            let Some((low, high)) = r.current().extent() else { continue };
            let known = sizes.current.get_or_insert((low, high));
            *known = (known.0.min(low), known.1.max(high));
            if let Some(changing) = r.current().changing() {
                sizes.current_varies = true;
                sizes.current_steps |= !jumps_after(changing).is_empty();
            }
        }
        let sizes = sizes.above_zero();
        Self { life: (longest / sizes.path).max(1.0), ..sizes }
    }

    /// The same where all recordings share the parameters of the base model, whatever their currents.
    #[must_use]
    pub fn of_one_device(self) -> Self {
        let differs = self.current.is_some_and(|(low, high)| high > low);
        Self { current_varies: self.current_varies || differs, ..self }
    }

    /// Integral of the squared velocity over the longest path at half the largest speed, mm^2/s: the heat of a
    /// dashpot, in proportion.
    pub fn heat(&self) -> f64 {
        0.5 * self.velocity * self.path
    }

    /// Highest less lowest current, A; 1 where it is not known or constant.
    pub fn current_span(&self) -> f64 {
        self.current.map(|(low, high)| high - low).filter(|span| *span > 0.0).unwrap_or(1.0)
    }

    /// The same with sizes of which boxes can be made, where nothing moved or no force was felt.
    fn above_zero(mut self) -> Self {
        for size in
            [&mut self.displacement, &mut self.velocity, &mut self.force, &mut self.path, &mut self.energy]
        {
            *size = size.max(LEAST);
        }
        self.dissipated = self.dissipated.max(LEAST_DISSIPATED * self.energy);
        self
    }
}

/// Lowest and highest of all recordings; `None` where one of them has none.
fn temperatures<'a>(recordings: impl Iterator<Item = &'a Recording>) -> Option<(f64, f64)> {
    let all = recordings.map(|r| r.temperature().extent()).collect::<Option<Vec<_>>>()?;
    all.into_iter().reduce(|all, one| (all.0.min(one.0), all.1.max(one.1)))
}
