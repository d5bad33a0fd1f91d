//! What every law has to keep.

use std::collections::BTreeSet;
use std::f64::consts::TAU;

use rand_chacha::ChaCha8Rng;
use rand_core::{Rng, SeedableRng};

use super::super::{CATALOGUE, Effect, Scene};
use super::Stage;
use crate::kernel::intervals::Plan;
use crate::kernel::state_change::{StateChange, trace};
use crate::parameter::{Parameter, Scale};
use crate::recording::Condition;

/// Ids of the contract.
const IDS: [&str; 27] = [
    "maxwell_relaxation",
    "fractional_viscoelasticity",
    "coulomb_friction",
    "stribeck_friction",
    "hysteresis",
    "inertia",
    "time_delay",
    "cubic_stiffness",
    "asymmetric_stiffness",
    "quadratic_damping",
    "mullins_softening",
    "cyclic_degradation",
    "thermal_softening",
    "payne_softening",
    "stiffness_jump",
    "pinching",
    "backlash",
    "end_stop",
    "rig_compliance",
    "force_drift",
    "force_clipping",
    "mains_interference",
    "filter_lag",
    "creep",
    "field_lag",
    "field_remanence",
    "field_dependence",
];

fn uniform(random: &mut ChaCha8Rng) -> f64 {
    f64::from(random.next_u32()) / f64::from(u32::MAX)
}

/// Random multisine with a rest in the middle, slightly uneven steps, and a current.
fn stage(seed: u64, amplitude: f64) -> Stage {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let time: Vec<f64> = (0..1200).map(|i| 0.005 * (f64::from(i) + 0.3 * uniform(&mut random))).collect();
    let waves: Vec<[f64; 3]> = (0..6)
        .map(|k| [uniform(&mut random), 0.4 + 1.1 * f64::from(k), TAU * uniform(&mut random)])
        .collect();
    let motion = |t: f64| {
        if (2.5..3.2).contains(&t) {
            return (0.1 * amplitude, 0.0);
        }
        waves.iter().fold((0.0, 0.0), |(x, v), [a, f, p]| {
            let phase = TAU * f * t + p;
            (x + amplitude * a * phase.sin(), v + amplitude * a * TAU * f * phase.cos())
        })
    };
    let current = time.iter().map(|t| 1.0 + (2.0 * t).sin()).collect();
    Stage::new(time, motion, Some(current))
}

/// Every series that a law makes of a scene.
fn made(effect: &dyn Effect, scene: &Scene, shape: &[f64]) -> Vec<Vec<f64>> {
    let mut all = effect.columns(scene, shape);
    if let Some(factors) = effect.factors(scene, shape) {
        all.extend(factors.damping);
        all.push(factors.stiffness);
    }
    if let Some(motion) = effect.motion(scene, shape) {
        all.extend([motion.displacement, motion.velocity]);
    }
    all.extend(effect.current(scene, shape));
    all.extend(effect.through(scene, shape, scene.force));
    all.extend(effect.shown(scene, shape));
    all.extend(effect.state_change(scene.sizes, shape).map(|change| state_of(scene, change)));
    if let Some((low, high)) = effect.clip(shape) {
        all.push(scene.force.iter().map(|f| f.clamp(low, high)).collect());
    }
    all
}

/// The state of a hysteretic device.
fn state_of(scene: &Scene, change: StateChange) -> Vec<f64> {
    let current = scene.current.map_or(Condition::Missing, |current| Condition::Series(current.to_vec()));
    let plan = Plan::of(scene.time, scene.displacement, scene.velocity);
    trace((&plan, scene.displacement), &current, [0.5, 0.7, 1.4], change)
}

fn inside(p: &Parameter, u: f64) -> f64 {
    match p.scale {
        Scale::Linear => p.lower + u * (p.upper - p.lower),
        Scale::Log => p.lower * (p.upper / p.lower).powf(u),
    }
}

#[test]
fn the_catalogue_has_the_effects_of_the_contract() {
    let found: BTreeSet<&str> = CATALOGUE.iter().map(|e| e.about().effect).collect();
    assert_eq!(found, IDS.into_iter().collect());
    let names: BTreeSet<(&str, &str)> = CATALOGUE.iter().map(|e| (e.about().effect, e.about().law)).collect();
    assert_eq!(names.len(), CATALOGUE.len(), "two laws of an effect have the same name");
}

#[test]
fn laws_of_an_effect_stand_together() {
    let ids: Vec<&str> = CATALOGUE.iter().map(|e| e.about().effect).collect();
    let changes = ids.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert_eq!(changes + 1, IDS.len());
}

#[test]
fn what_makes_a_law_this_effect_is_one_of_its_parameters() {
    let stage = stage(1, 4.0);
    for effect in CATALOGUE.iter().filter(|e| e.own().is_some()) {
        let coefficients = effect.coefficients().into_iter().filter(|p| p.smallest == 0.0);
        let named =
            coefficients.chain(effect.shape(&stage.sizes)).any(|p| Some(p.name.as_str()) == effect.own());
        assert!(named, "{:?}", effect.about());
    }
}

#[test]
fn starts_lie_in_their_boxes() {
    for amplitude in [1e-3, 4.0, 300.0] {
        let stage = stage(1, amplitude);
        for effect in CATALOGUE.iter().filter(|e| e.applies(&stage.sizes)) {
            let shape = effect.shape(&stage.sizes);
            let starts = effect.starts(&stage.sizes);
            assert!(!starts.is_empty(), "{:?}", effect.about());
            for p in &shape {
                assert!(p.lower < p.upper && (p.scale == Scale::Linear || p.lower > 0.0), "{p:?}");
            }
            for start in starts {
                assert_eq!(start.len(), shape.len(), "{:?}", effect.about());
                for (value, p) in start.iter().zip(&shape) {
                    let room = 1e-9 * p.upper.abs();
                    let found = (p.lower - room..=p.upper + room).contains(value);
                    assert!(found, "{} = {value} of {:?} outside {p:?}", p.name, effect.about());
                }
            }
        }
    }
}

#[test]
fn every_law_is_finite_for_every_shape_in_its_box() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for (seed, amplitude) in [(3, 4.0), (4, 0.01), (5, 200.0)] {
        let stage = stage(seed, amplitude);
        let scene = stage.scene();
        for effect in CATALOGUE.iter().filter(|e| e.applies(&stage.sizes)) {
            let boxes = effect.shape(&stage.sizes);
            let mut shapes = effect.starts(&stage.sizes);
            for _ in 0..6 {
                shapes.push(boxes.iter().map(|p| inside(p, uniform(&mut random))).collect());
            }
            shapes.push(boxes.iter().map(|p| p.lower).collect());
            shapes.push(boxes.iter().map(|p| p.upper).collect());
            for shape in shapes {
                let about = effect.about();
                assert_eq!(effect.columns(&scene, &shape).len(), effect.coefficients().len(), "{about:?}");
                for series in made(*effect, &scene, &shape) {
                    assert_eq!(series.len(), scene.len(), "{about:?}");
                    assert!(series.iter().all(|v| v.is_finite()), "{about:?} at {shape:?}");
                }
            }
        }
    }
}

#[test]
fn a_law_without_columns_changes_something_at_its_starts() {
    let stage = stage(6, 4.0);
    let scene = stage.scene();
    for effect in CATALOGUE.iter().filter(|e| e.coefficients().is_empty()) {
        for start in effect.starts(&stage.sizes).into_iter().take(3) {
            let state = state_of(&scene, StateChange::default());
            let current = stage.current.as_deref().unwrap_or(&[]);
            let same = [scene.force, scene.displacement, scene.velocity, current, &state];
            let changed = made(*effect, &scene, &start)
                .iter()
                .any(|series| !same.contains(&series.as_slice()) && series.iter().any(|v| *v != 1.0));
            assert!(changed, "{:?} at {start:?}", effect.about());
        }
    }
}

#[test]
fn a_magnitude_of_zero_changes_nothing() {
    let stage = stage(7, 4.0);
    let scene = stage.scene();
    for effect in CATALOGUE {
        for start in &mut effect.starts(&stage.sizes) {
            if let Some(factors) = effect.factors(&scene, start) {
                // A share, or a power.
                let name = &effect.shape(&stage.sizes)[0].name;
                assert!(["s", "p"].contains(&name.as_str()), "{:?}", effect.about());
                start[0] = 0.0;
                let none = effect.factors(&scene, start).unwrap_or(factors);
                let all = none.stiffness.iter().chain(none.damping.iter().flatten());
                assert!(all.copied().all(|factor| factor == 1.0), "{:?}", effect.about());
            }
            let in_series = ["backlash", "rig_compliance"].contains(&effect.about().effect);
            if in_series && effect.coefficients().is_empty() {
                start[0] = 0.0;
                let seen = effect.motion(&scene, start).map(|m| m.displacement);
                assert_eq!(seen.as_deref(), Some(scene.displacement), "{:?}", effect.about());
            }
        }
    }
}

#[test]
fn what_moves_the_device_has_a_motion() {
    let stage = stage(7, 4.0);
    let scene = stage.scene();
    for effect in CATALOGUE {
        for start in effect.starts(&stage.sizes) {
            let moved = effect.motion(&scene, &start);
            assert!(moved.is_some() || !effect.moves_the_device(), "{:?}", effect.about());
            // Nothing of its own is seen in the motion that it makes.
            assert!(moved.is_none() || effect.coefficients().is_empty(), "{:?}", effect.about());
        }
    }
}

#[test]
fn softening_softens_and_a_lost_share_never_grows_without_recovery() {
    let stage = stage(8, 4.0);
    let scene = stage.scene();
    let lasting = ["cyclic_degradation", "stiffness_jump"];
    for effect in CATALOGUE {
        let about = effect.about();
        for start in effect.starts(&stage.sizes).iter().filter(|s| s.first().is_some_and(|s| *s > 0.0)) {
            let Some(factors) = effect.factors(&scene, start) else { continue };
            let by_largest = about.effect == "mullins_softening" && about.law.contains("largest");
            let lasts = lasting.contains(&about.effect) || by_largest || about.law.contains("ageing");
            for kept in [Some(factors.stiffness), factors.damping].into_iter().flatten() {
                assert!(kept.iter().all(|f| (0.05..=1.0).contains(f)), "{about:?}");
                let falls = kept.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12);
                assert!(falls || !lasts, "{about:?}");
            }
        }
    }
}

#[test]
fn laws_of_the_current_need_one_that_varies() {
    let still = Stage::sine(4.0, 1.0, 3.0);
    let effects = |applies: bool| -> BTreeSet<&str> {
        let alike = CATALOGUE.iter().filter(|e| e.applies(&still.sizes) == applies);
        alike.map(|e| e.about().effect).collect()
    };
    // Others have laws with and without the current.
    let needs: BTreeSet<&str> = effects(false).difference(&effects(true)).copied().collect();
    assert_eq!(needs, BTreeSet::from(["field_lag", "field_remanence", "field_dependence"]));
}
