//! Rig compliance: the fixture gives way in series with the device.
//!
//! | symbol | meaning | unit | range |
//! |---|---|---|---|
//! | `f_r` | flexibility of the rig, 1/`k_r`; of a joint at the largest force `F_m` | mm/N | 0 to half the flexibility of the device |
//! | P | preload of a joint | N | 1 % to 300 % of the largest force |
//! | `t_r` | retardation time of a rig that gives way slowly | s | a fifth of a sample to half the longest recording |
//! | r | flexibility under a negative force over that under a positive one, `f_r`; for a hysteretic base | - | 0.2 to 5 |
//!
//! The force that bends the rig is that of the device, as far as it is known.
//! Reference: a spring, or a Kelvin-Voigt element, in series; a joint of rough or round surfaces (Johnson, Contact
//! Mechanics, 1985) gives way by the power 2/3 of its force.
//! Known limit: for a linear device it is part of k0 and c0.

use std::borrow::Cow;

use super::operators::{each, lag, slope};
use super::{
    About, Effect, Flexibility, Motion, Scene, Sizes, ideal_above, ideal_below, order_within, within,
};
use crate::parameter::Parameter;

/// How the rig gives way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rig {
    /// At once.
    Spring,
    /// Slowly.
    Viscoelastic,
    /// Slowly, and more one way than the other.
    Uneven,
    /// At once, less and less.
    Joint,
}

/// What a rig that is softer one way gives way to, as a force.
fn uneven(whole: &[f64], ratio: f64) -> Vec<f64> {
    each(whole, |force| if force < 0.0 { ratio * force } else { force })
}

/// What a joint gives way to under a force, as a force: the same at the largest.
fn stiffening(force: f64, preload: f64, largest: f64) -> f64 {
    let set = |force: f64| (1.0 + force / preload).powf(2.0 / 3.0) - 1.0;
    largest * set(force.abs()).copysign(force) / set(largest)
}

impl Effect for Rig {
    fn about(&self) -> About {
        let spring = About {
            effect: "rig_compliance",
            law: "spring in series",
            plain: "the fixture gives way, so that the device moves less than was measured",
            equation: "the device sees x - f_r F",
            reference: "general",
            limit: "for a linear device it is part of k0 and c0",
        };
        match self {
            Self::Spring => spring,
            Self::Viscoelastic => About {
                law: "spring and dashpot in series",
                equation: "the device sees x - u, t_r du/dt + u = f_r F",
                ..spring
            },
            Self::Uneven => About {
                law: "spring and dashpot in series, softer one way",
                equation: "the device sees x - u, t_r du/dt + u = f_r F, r f_r F where F < 0",
                ..spring
            },
            Self::Joint => About {
                law: "joint in series",
                limit: "F_m is the largest force measured; for a linear device it is part of k0 and c0",
                plain: "a joint of the fixture gives way, so that the device moves less than was measured",
                equation: "the device sees x - f_r F_m s(F)/s(F_m), s(F) = sgn(F) ((1 + |F|/P)^(2/3) - 1)",
                reference: "Johnson, Contact Mechanics, 1985",
                ..spring
            },
        }
    }

    /// Of a device without hysteresis it would take what an asymmetric one does.
    fn on_a_part(&self) -> bool {
        *self == Self::Uneven
    }

    fn shape(&self, sizes: &Sizes) -> Vec<Parameter> {
        let mut shape = vec![within("f_r", "mm/N", 0.0, 0.5 * sizes.displacement / sizes.force)];
        match self {
            Self::Spring => {}
            Self::Viscoelastic | Self::Uneven => {
                shape.push(ideal_below(order_within("t_r", "s", 0.2 * sizes.step, 0.5 * sizes.duration)));
                if *self == Self::Uneven {
                    shape.push(order_within("r", "", 0.2, 5.0));
                }
            }
            Self::Joint => {
                let preload = order_within("P", "N", 0.01 * sizes.force, 3.0 * sizes.force);
                shape.push(ideal_above(ideal_below(preload)));
            }
        }
        shape
    }

    fn starts(&self, sizes: &Sizes) -> Vec<Vec<f64>> {
        let [flexible, soft] = [0.03, 0.2].map(|share| share * sizes.displacement / sizes.force);
        match self {
            Self::Spring => vec![vec![flexible], vec![soft]],
            Self::Joint => vec![vec![flexible, 0.03 * sizes.force], vec![soft, 0.3 * sizes.force]],
            Self::Viscoelastic => {
                let slow = [0.003, 0.03, 0.2].map(|share| (share * sizes.duration).max(2.0 * sizes.step));
                let stiff = [sizes.step].into_iter().chain(slow).map(|t_r| vec![0.5 * soft, t_r]);
                // Behind a soft one only the dashpot holds the device back.
                stiff.chain(slow.map(|t_r| vec![2.0 * soft, t_r])).collect()
            }
            Self::Uneven => {
                let each_way = |start: Vec<f64>| [0.6, 1.7].map(|ratio| [&start[..], &[ratio]].concat());
                Self::Viscoelastic.starts(sizes).into_iter().flat_map(each_way).collect()
            }
        }
    }

    fn flexibility(&self, shape: &[f64]) -> Option<Flexibility> {
        let (size, retardation) = match self {
            Self::Spring | Self::Joint => (shape[0], 0.0),
            Self::Viscoelastic => (shape[0], shape[1]),
            Self::Uneven => (0.5 * shape[0] * (1.0 + shape[2]), shape[1]),
        };
        Some(Flexibility { size, retardation })
    }

    fn moves_the_device(&self) -> bool {
        true
    }

    fn motion(&self, scene: &Scene, shape: &[f64]) -> Option<Motion> {
        let whole = scene.whole;
        let (force, rate) = match self {
            Self::Spring => (Cow::Borrowed(whole), slope(scene.time, whole)),
            Self::Viscoelastic | Self::Uneven => {
                let bends =
                    shape.get(2).map_or(Cow::Borrowed(whole), |ratio| Cow::Owned(uneven(whole, *ratio)));
                let bent = lag(scene.time, &bends, shape[1], bends[0]);
                let rate = bends.iter().zip(&bent).map(|(now, bent)| (now - bent) / shape[1]).collect();
                (Cow::Owned(bent), rate)
            }
            Self::Joint => {
                let set = each(whole, |force| stiffening(force, shape[1], scene.sizes.force));
                let rate = slope(scene.time, &set);
                (Cow::Owned(set), rate)
            }
        };
        let less =
            |series: &[f64], by: &[f64]| series.iter().zip(by).map(|(a, b)| a - shape[0] * b).collect();
        Some(Motion { displacement: less(scene.displacement, &force), velocity: less(scene.velocity, &rate) })
    }
}
