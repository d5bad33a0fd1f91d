//! What the machine and the device may do in the next test.

use std::f64::consts::TAU;

use crate::assembly::Campaign;

/// Highest frequency that is proposed, as a share of the sampling rate.
const HIGHEST_SHARE: f64 = 0.05;
/// Highest frequency that is proposed, Hz.
const HIGHEST: f64 = 10.0;
/// Durations that are proposed, s.
const DURATIONS: std::ops::Range<f64> = 10.0..40.0;
/// How many times as long a test may be where that tells more.
const LONGER: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
/// Most samples of such a test.
const MOST: f64 = 30_000.0;
/// How many times as fast, at the stroke that was tested.
const FASTER: [f64; 3] = [1.0, 2.0, 4.0];
/// How many times the frequency, seen by as many more samples a second as it needs.
const HIGHER: [f64; 3] = [1.0, 2.0, 4.0];

/// What the machine and the device may do.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Largest displacement, mm.
    pub stroke: f64,
    /// Largest speed, mm/s.
    pub speed: f64,
    /// Highest frequency, Hz.
    pub highest: f64,
    /// Duration, s.
    pub duration: f64,
    /// Samples a second.
    pub rate: f64,
    /// Lowest and highest coil current, A, where it may be changed.
    pub current: Option<(f64, f64)>,
}

/// Limits that a user gives; what is missing follows from the recordings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GivenLimits {
    /// Largest displacement, mm.
    pub stroke: Option<f64>,
    /// Largest speed, mm/s.
    pub speed: Option<f64>,
    /// Highest frequency, Hz.
    pub highest: Option<f64>,
    /// Duration, s.
    pub duration: Option<f64>,
    /// Lowest and highest coil current, A.
    pub current: Option<(f64, f64)>,
}

impl Limits {
    /// Those given, and for the rest what was tested.
    pub(super) fn of(given: &GivenLimits, campaign: &Campaign) -> Self {
        let sizes = campaign.sizes();
        let rate = campaign.recordings().iter().map(|r| r.sampling_rate()).fold(0.0, f64::max);
        let duration = || sizes.duration.clamp(DURATIONS.start, DURATIONS.end);
        Self {
            stroke: given.stroke.unwrap_or(sizes.displacement),
            speed: given.speed.unwrap_or(sizes.velocity),
            highest: given.highest.unwrap_or((HIGHEST_SHARE * rate).min(HIGHEST)),
            duration: given.duration.unwrap_or_else(duration),
            rate,
            current: given.current.or(sizes.current).filter(|(low, high)| high > low),
        }
    }

    /// The same, and what is harder to make, the easiest first: longer, then faster, then of higher frequency, where that
    /// is not limited.
    pub(super) fn wider(&self, given: &GivenLimits) -> Vec<Self> {
        let of = |free: bool, all: &'static [f64]| if free { all } else { &all[..1] };
        let longer = of(given.duration.is_none(), &LONGER);
        // No motion within stroke and frequency is faster.
        let fastest = TAU * self.highest * self.stroke;
        let all = of(given.speed.is_none(), &FASTER);
        let useful = |i: usize| i == 0 || all[i - 1] * self.speed < fastest;
        let faster: Vec<f64> = (0..all.len()).filter(|i| useful(*i)).map(|i| all[i]).collect();
        let most = faster.last().copied().unwrap_or(1.0);
        let higher = of(given.highest.is_none(), &HIGHER)[1..].iter().map(|higher| (most, *higher));
        let mut found = Vec::new();
        for (faster, higher) in faster.iter().map(|faster| (*faster, 1.0)).chain(higher) {
            for times in longer {
                let highest = higher * self.highest;
                let wider = Self {
                    speed: faster * self.speed,
                    highest,
                    duration: times * self.duration,
                    rate: self.rate.max((highest / HIGHEST_SHARE).min(higher * self.rate)),
                    ..self.clone()
                };
                if *times == 1.0 || wider.duration * wider.rate <= MOST {
                    found.push(wider);
                }
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_limited_grows_the_duration_first() {
        let tested =
            Limits { stroke: 5.0, speed: 50.0, highest: 10.0, duration: 12.0, rate: 200.0, current: None };
        let sizes = |given: &GivenLimits| -> Vec<(f64, f64, f64)> {
            tested.wider(given).iter().map(|l| (l.duration, l.speed, l.highest)).collect()
        };
        let all = sizes(&GivenLimits::default());
        assert_eq!(all[..3], [(12.0, 50.0, 10.0), (24.0, 50.0, 10.0), (48.0, 50.0, 10.0)]);
        assert_eq!(all[3..6], [(96.0, 50.0, 10.0), (12.0, 100.0, 10.0), (24.0, 100.0, 10.0)]);
        // Then of higher frequency, as long as the samples are not too many.
        assert_eq!(all[11..13], [(96.0, 200.0, 10.0), (12.0, 200.0, 20.0)]);
        assert_eq!(all[14..], [(48.0, 200.0, 20.0), (12.0, 200.0, 40.0), (24.0, 200.0, 40.0)]);
        let slow = GivenLimits { speed: Some(50.0), highest: Some(10.0), ..GivenLimits::default() };
        assert_eq!(sizes(&slow).len(), 4);
        let short = GivenLimits { duration: Some(12.0), ..slow };
        assert_eq!(sizes(&short), [(12.0, 50.0, 10.0)]);
        // 1 Hz at 5 mm needs no more than 31 mm/s, and 10 kHz for 24 s is too much.
        let slow = Limits { highest: 1.0, rate: 10_000.0, ..tested.clone() };
        let given = GivenLimits { highest: Some(1.0), ..GivenLimits::default() };
        assert_eq!(slow.wider(&given).len(), 1);
    }
}
