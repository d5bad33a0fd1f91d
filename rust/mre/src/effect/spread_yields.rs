//! Hysteresis of elements that yield between a smallest and a largest displacement, whichever of them is the stiffer.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `k_h` | stiffness before yield | N/mm | >= 0 |
//! | `r_max` | largest yield displacement | mm | 30 % to 300 % of the largest stroke |
//! | h | smallest yield displacement as a share of `r_max` | - | 0.02 to 0.8 |
//! | q | exponent of the distribution: yields below r have the share (r^q - (h `r_max`)^q)/(`r_max`^q - (h `r_max`)^q) | - | -1 to 2 |
//!
//! Reference: Segalman 2005, J. Appl. Mech. 72 (2005) 752, with a smallest yield: without it small yields can have no more
//! than a share of the stiffness that falls with them.
//! Known limit: yields below 5 % of the stroke are friction; above the stroke, they are stiffness.

use super::hysteresis::Hysteresis;
use super::operators::stop;
use super::{About, Effect, Scene, Sizes, order_within, positive, within};
use crate::parameter::Parameter;

/// Elements, evenly in the logarithm of their yields.
const ELEMENTS: usize = 12;
/// Below this exponent yields are as stiff in every octave.
const EVEN: f64 = 1e-6;
/// Shares of the stroke, and smallest over largest yield with the exponent, from which a fit starts.
const LARGEST: [f64; 3] = [0.4, 0.8, 2.0];
const SPREAD: [(f64, f64); 2] = [(0.03, -0.7), (0.1, 0.5)];

/// Elastic-plastic elements in parallel with yields between two.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpreadYields;

/// Integral of the distribution up to a yield over the largest, but for a constant.
fn cumulated(r: f64, q: f64) -> f64 {
    if q.abs() < EVEN { r.ln() } else { r.powf(q) / q }
}

impl Effect for SpreadYields {
    fn about(&self) -> About {
        About {
            law: "Iwan, power distribution between two yields",
            equation: "F_h = k_h mean of p(r) over yields with the share (r^q - (h r_max)^q)/(r_max^q - (h r_max)^q) below r",
            reference: "Iwan 1966; Segalman 2005",
            ..Hysteresis::PowerIwan.about()
        }
    }

    fn coefficients(&self) -> Vec<Parameter> {
        vec![positive("k_h", "N/mm")]
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let x = sizes.displacement;
        vec![
            order_within("r_max", "mm", 0.3 * x, 3.0 * x),
            order_within("h", "", 0.02, 0.8),
            within("q", "", -1.0, 2.0),
        ]
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let of = |share: f64| SPREAD.map(|(h, q)| vec![share * sizes.displacement, h, q]);
        LARGEST.into_iter().flat_map(of).collect()
    }

    fn columns(&self, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
        let (largest, smallest, q) = (shape[0], shape[1], shape[2]);
        let edge = |k: usize| smallest.powf(1.0 - k as f64 / ELEMENTS as f64);
        let whole = cumulated(1.0, q) - cumulated(smallest, q);
        let mut sum = vec![0.0; scene.len()];
        for k in 0..ELEMENTS {
            let (low, high) = (edge(k), edge(k + 1));
            let share = (cumulated(high, q) - cumulated(low, q)) / whole;
            let element = stop(scene.displacement, largest * (low * high).sqrt());
            sum.iter_mut().zip(element).for_each(|(sum, p)| *sum += share * p);
        }
        vec![sum]
    }
}
