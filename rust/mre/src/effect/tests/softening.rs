//! Factors against closed forms.

use std::f64::consts::TAU;

use super::{Stage, close, grid, law};
use crate::effect::Scene;
use crate::physics::Part;

#[test]
fn pseudo_elastic_softening_is_nothing_on_the_virgin_curve() {
    let stage = Stage::sine(2.0, 0.5, 2.0);
    let law = law("mullins_softening", "Ogden-Roxburgh, stiffness");
    let factor = law.factors(&stage.scene(), &[0.4, 0.5, 0.0]).unwrap().stiffness;
    assert!(factor[..500].iter().all(|f| (f - 1.0).abs() < 1e-8), "first loading");
    // At x = 0 after the first peak the argument is (2/0.5)^2 = 16: all is lost that can be.
    close(factor[1000], 0.6, 1e-6);
    // Where W_m - W = m / 2 on the way back, erf(1/2) of the share is lost.
    let x = stage.recording.displacement();
    let at = (500..1000)
        .min_by(|i, j| (x[*i] - 3.875_f64.sqrt()).abs().total_cmp(&(x[*j] - 3.875_f64.sqrt()).abs()));
    close(factor[at.unwrap_or(0)], 1.0 - 0.4 * 0.520_499_878, 5e-3);
}

#[test]
fn reloading_loses_by_the_distance_from_the_largest_strain() {
    let stage = Stage::sine(2.0, 0.5, 2.0);
    let law = law("mullins_softening", "reloading, stiffness");
    let factor = law.factors(&stage.scene(), &[0.4, 1.0, 2.0]).unwrap().stiffness;
    assert!(factor[..=500].iter().all(|f| *f == 1.0), "first loading");
    // Half way back from the first peak: (1 - sin 45 deg)^2 of the share.
    close(factor[750], 1.0 - 0.4 * (1.0 - 0.5_f64.sqrt()).powi(2), 1e-6);
    close(factor[1000], 0.6, 1e-9);
}

#[test]
fn degradation_reaches_its_share_at_the_longest_path() {
    let stage = Stage::sine(2.0, 1.0, 5.0);
    for name in ["path, stiffness", "energy, stiffness"] {
        let factor = law("cyclic_degradation", name).factors(&stage.scene(), &[0.3]).unwrap().stiffness;
        close(factor[5000], 0.7, 2e-3);
        close(factor[2500], 0.85, 2e-3);
    }
}

#[test]
fn wear_may_slow_down_by_a_logarithm_or_a_power() {
    let stage = Stage::sine(2.0, 1.0, 5.0);
    let at = |name: &str, own: f64, i: usize| {
        law("cyclic_degradation", name).factors(&stage.scene(), &[0.3, own]).unwrap().stiffness[i]
    };
    // The path is 40 mm in all.
    for (name, own, half) in [
        ("path, logarithmic, stiffness", 2.0, 11.0_f64.ln() / 21.0_f64.ln()),
        ("path, power, stiffness", 0.5, 0.5_f64.sqrt()),
    ] {
        close(at(name, own, 5000), 0.7, 2e-3);
        close(at(name, own, 2500), 1.0 - 0.3 * half, 2e-3);
    }
}

#[test]
fn pinching_has_edges_of_any_sharpness_or_none() {
    let stage = Stage::sine(2.0, 1.0, 1.0);
    let at =
        |name: &str, shape: &[f64]| law("pinching", name).factors(&stage.scene(), shape).unwrap().stiffness;
    assert_eq!(at("edged, stiffness", &[0.4, 0.5, 2.0]), at("centred, stiffness", &[0.4, 0.5]));
    let wide = at("wide, stiffness", &[0.4, 0.5]);
    for (factor, x) in wide.iter().zip(stage.recording.displacement()) {
        close(*factor, 1.0 - 0.4 / (1.0 + (x / 0.5).powi(2)), 1e-12);
    }
}

#[test]
fn a_law_on_a_part_leaves_the_others() {
    let stage = Stage::sine(2.0, 1.0, 5.0);
    let on = |name: &str, part: Part| {
        law("cyclic_degradation", name).factors(&stage.scene(), &[0.3]).unwrap().on(part).map(|f| f[5000])
    };
    for (name, springs, hysteretic) in [
        ("path, stiffness", true, true),
        ("path, spring", true, false),
        ("path, hysteretic force", false, true),
    ] {
        assert_eq!(on(name, Part::Stiffness).is_some(), springs, "{name}");
        assert_eq!(on(name, Part::Hysteretic).is_some(), hysteretic, "{name}");
        assert_eq!(on(name, Part::Damping), None, "{name}");
        assert_eq!(on(name, Part::Offset), None, "{name}");
    }
    close(on("path, hysteretic force", Part::Hysteretic).unwrap(), 0.7, 2e-3);
    assert!(law("cyclic_degradation", "path, hysteretic force").about().equation.starts_with("k_w"));
    close(on("path, damping", Part::Damping).unwrap(), 0.7, 2e-3);
    assert_eq!(on("path, damping", Part::Stiffness), Some(1.0));
    assert_eq!(on("path, damping", Part::Hysteretic), None);
}

#[test]
fn what_stays_of_the_work_is_lost_for_good_and_what_is_given_back_is_not() {
    let stage = Stage::sine(2.0, 1.0, 5.0);
    // 5 x + 0.3 v: the dashpot takes 0.3 w^2 A^2 / 2 a second, the spring holds 10 N mm at each peak.
    let heat = 0.6 * TAU * TAU;
    let wear = law("cyclic_degradation", "dissipated energy, stiffness").factors(&stage.scene(), &[0.3]);
    close(wear.unwrap().stiffness[5000], 1.0 - 0.3 * (4.75 * heat + 10.0) / (5.0 * heat), 1e-3);
    let warm = law("thermal_softening", "dissipated power, stiffness").factors(&stage.scene(), &[0.3, 1e3]);
    close(warm.unwrap().stiffness[5000], 0.7, 1e-3);
}

#[test]
fn a_device_ages_from_the_start() {
    let stage = Stage::sine(2.0, 1.0, 10.0);
    let at = |law_name: &str, shape: &[f64]| {
        law("creep", law_name).factors(&stage.scene(), shape).unwrap().stiffness[9000]
    };
    close(at("ageing, stiffness", &[0.2, 1.0]), 0.8, 1e-9);
    close(at("ageing by a power, stiffness", &[0.3, 1.0]), 10.0_f64.powf(-0.3), 1e-9);
    close(at("ageing to an end, stiffness", &[0.3, 4.5]), 0.7 + 0.3 * (-2.0_f64).exp(), 1e-9);
}

#[test]
fn heat_recovers_at_rest() {
    let motion = |t: f64| if t < 5.0 { ((TAU * t).sin(), TAU * (TAU * t).cos()) } else { (0.0, 0.0) };
    let stage = Stage::new(grid(1e-3, 15.0), motion, None);
    let factor = law("thermal_softening", "linear, stiffness").factors(&stage.scene(), &[0.3, 2.0]).unwrap();
    let lost = |i: usize| 1.0 - factor.stiffness[i];
    close(lost(12_000) / lost(10_000), (-1.0_f64).exp(), 1e-6);
}

#[test]
fn the_amplitude_of_the_last_half_cycle_is_that_of_the_sine() {
    let stage = Stage::sine(3.0, 1.0, 4.0);
    let factors =
        law("payne_softening", "last half cycle, stiffness").factors(&stage.scene(), &[0.5, 3.0, 1.0]);
    let stiffness = factors.unwrap().stiffness;
    assert_eq!(stiffness[100], 1.0);
    assert!(stiffness[1000..].iter().all(|f| (f - 0.75).abs() < 1e-4));
}

#[test]
fn a_structure_settles_between_breaking_and_rebuilding() {
    let stage = Stage::new(grid(1e-2, 20.0), |t| (2.0 * t, 2.0), None);
    let factors = law("payne_softening", "structure, stiffness").factors(&stage.scene(), &[1.0, 0.5, 3.0]);
    // b = r v t_a / (1 + r v t_a) = 3/4.
    close(factors.unwrap().stiffness[2000], 0.25, 1e-6);
}

#[test]
fn a_jump_falls_in_one_recording() {
    let stage = Stage::sine(2.0, 1.0, 4.0);
    let jump = law("stiffness_jump", "stiffness");
    let scene = Scene { before: 100.0, ..stage.scene() };
    let factor = jump.factors(&scene, &[0.3, 102.0, 1e-3]).unwrap().stiffness;
    assert_eq!((factor[1999], factor[2002]), (1.0, 0.7));
    assert!(jump.factors(&scene, &[0.3, 99.0, 1e-3]).is_none());
    assert!(jump.factors(&scene, &[0.3, 104.5, 1e-3]).is_none());
}
