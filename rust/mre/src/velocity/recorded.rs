//! A recorded velocity without its noise.

use super::calming::Calming;
use super::local::{NARROWEST, TERMS};
use super::smoothing::Smoothing;
use super::together::{WIDEST, apart};
use super::window::Window;
use super::{PART_TERMS, cut};
use crate::kernel::jumps::jumps;
use crate::recording::mean;
use crate::spread::median;

/// Noise has a median square above this share of its mean square; that of Gaussian noise is 0.45.
const EVERYWHERE: f64 = 0.1;

/// How noise is taken off a recorded velocity: the same way off everything that is added to it.
#[derive(Debug, Clone)]
pub(crate) enum Way {
    /// Between its jumps.
    Parts(Smoothing),
    /// More where it is slower than elsewhere: noise of a velocity at rest would move a path.
    Calmed(Calming),
}

impl Way {
    /// What it leaves of a velocity in mm/s.
    pub(super) fn over(&self, time: &[f64], velocity: &[f64]) -> Vec<f64> {
        match self {
            Self::Parts(smoothing) => smoothing.over(time, velocity).1,
            Self::Calmed(calming) => calming.over(time, velocity).displacement,
        }
    }
}

/// A recorded velocity less its noise.
#[derive(Debug, Clone)]
pub(crate) struct Smoothed {
    /// mm/s.
    pub(crate) velocity: Vec<f64>,
    /// Standard deviation of the noise that it had, mm/s; zero where there was none to be taken off.
    pub(crate) noise: f64,
    /// The same of what is left of it, mm/s.
    pub(crate) left: f64,
    /// The last samples before it jumps, as a slope of the displacement cannot.
    pub(crate) jumps: Vec<usize>,
    pub(super) way: Way,
}

/// A recorded velocity in mm/s less its noise, where it has some everywhere; it keeps its jumps.
pub(crate) fn smoothed(time: &[f64], displacement: &[f64], velocity: &[f64]) -> Smoothed {
    let jumps: Vec<usize> = jumps(time, displacement, velocity).into_iter().map(|(i, _)| i).collect();
    let terms: &[usize] = if jumps.is_empty() { &[TERMS] } else { &PART_TERMS };
    let parts = cut(&jumps, velocity.len()).filter(|part| part.len() > 2 * NARROWEST);
    let window = |part: &std::ops::Range<usize>| {
        Window::best(&time[part.clone()], &velocity[part.clone()], WIDEST, terms)
    };
    let smoothing = Smoothing(parts.map(|part| (part.clone(), window(&part))).collect());
    let (slope, smooth) = smoothing.over(time, velocity);
    let (noise, left) = smoothing.noise(velocity, &smooth);
    let way = match smoothing.0.as_slice() {
        [(_, window)] if jumps.is_empty() => {
            Way::Calmed(Calming::of(time, velocity, [smooth, slope], *window))
        }
        _ => Way::Parts(smoothing),
    };
    let found = way.over(time, velocity);
    if apart(&found, velocity) && everywhere(&found, velocity) {
        Smoothed { velocity: found, noise, left, jumps, way }
    } else {
        Smoothed { velocity: velocity.to_vec(), noise: 0.0, left: 0.0, jumps, way }
    }
}

/// True where what was taken off a series is taken off everywhere, as noise is.
pub(super) fn everywhere(found: &[f64], series: &[f64]) -> bool {
    let taken: Vec<f64> = found.iter().zip(series).map(|(a, b)| (a - b).powi(2)).collect();
    let average = mean(&taken);
    median(taken) > EVERYWHERE * average
}

#[cfg(test)]
mod tests {
    use super::super::together::tests::{rms, shaken};
    use super::*;

    #[test]
    fn noise_of_a_velocity_is_taken_off_and_its_jumps_stay() {
        let [time, noisy, _, truth] = shaken(0.05);
        let still = vec![0.0; time.len()];
        assert!(rms(&smoothed(&time, &still, &noisy).velocity, &truth) < 0.5 * rms(&noisy, &truth));
        let triangle: Vec<f64> = truth.iter().map(|x| x.signum()).collect();
        assert_eq!(smoothed(&time, &still, &triangle).velocity, triangle);
    }
}
