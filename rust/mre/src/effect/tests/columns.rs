//! Columns against closed forms.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::{Stage, close, column, grid, harmonic, law};
use crate::kernel::hysteretic;

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_springpot_has_the_complex_stiffness_of_its_order(a in 0.08..0.92_f64, n in 125..2000_u32) {
        // Whole samples a period.
        let f = 1000.0 / f64::from(n);
        let stage = Stage::sine(1.0, f, 40.0 / f);
        let series = column("fractional_viscoelasticity", "springpot", &stage.scene(), &[a]);
        let (sin, cos) = harmonic(&stage, &series, f, 4.0);
        let (size, phase) = (sin.hypot(cos), cos.atan2(sin));
        close(size, (TAU * f).powf(a), 0.01);
        prop_assert!((phase - a * FRAC_PI_2).abs() < 0.01, "{phase} instead of {}", a * FRAC_PI_2);
    }

    #[test]
    fn a_springpot_in_series_has_the_complex_stiffness_of_the_cole_cole_law(
        a in 0.1..0.85_f64, tau in 0.01..1.0_f64, n in 125..2000_u32,
    ) {
        // Whole samples a period.
        let f = 1000.0 / f64::from(n);
        let stage = Stage::sine(1.0, f, 40.0 / f);
        let name = "springpot and spring in series";
        let series = column("fractional_viscoelasticity", name, &stage.scene(), &[a, tau]);
        let (sin, cos) = harmonic(&stage, &series, f, 4.0);
        let pot = nalgebra::Complex::new(0.0, TAU * f * tau).powf(a);
        let wanted = pot / (pot + 1.0);
        prop_assert!((sin - wanted.re).abs() < 0.01 && (cos - wanted.im).abs() < 0.01, "{sin} {cos}, {wanted}");
    }

    #[test]
    fn a_maxwell_branch_has_its_complex_stiffness(tau in 0.01..0.5_f64, n in 125..2000_u32) {
        let f = 1000.0 / f64::from(n);
        let stage = Stage::sine(2.0, f, 10.0 / f + 12.0 * tau);
        let series = column("maxwell_relaxation", "one branch", &stage.scene(), &[tau]);
        let (sin, cos) = harmonic(&stage, &series, f, 2.0);
        let wt = TAU * f * tau;
        close(sin, 2.0 * wt * wt / (1.0 + wt * wt), 5e-3);
        close(cos, 2.0 * wt / (1.0 + wt * wt), 5e-3);
    }
}

#[test]
fn a_springpot_answers_a_ramp_with_a_power_of_time() {
    let stage = Stage::new(grid(0.01, 10.0), |t| (t, 1.0), None);
    let series = column("fractional_viscoelasticity", "springpot", &stage.scene(), &[0.5]);
    // D^(1/2) t = 2 sqrt(t / pi).
    for i in [50, 200, 1000] {
        close(series[i], 2.0 * (stage.recording.time()[i] / PI).sqrt(), 0.01);
    }
}

#[test]
fn a_maxwell_branch_answers_a_ramp_exactly_on_any_grid() {
    let time = vec![0.0, 0.1, 0.15, 0.4, 0.41, 0.9, 2.0, 2.1, 2.2, 5.0];
    let stage = Stage::new(time.clone(), |t| (3.0 * t, 3.0), None);
    let z = column("maxwell_relaxation", "one branch", &stage.scene(), &[0.3]);
    for (t, z) in time.iter().zip(z) {
        assert!((z - 0.9 * (1.0 - (-t / 0.3).exp())).abs() < 1e-12);
    }
}

#[test]
fn the_bouc_wen_law_is_that_of_the_base_model() {
    let stage = Stage::sine(3.0, 1.0, 4.0);
    let mut wanted = vec![0.0; stage.force.len()];
    let shape = [1.3, 0.7, 1.8];
    let seen = &stage.recording;
    hysteretic::trace(seen.plan(), shape, 0.0, &mut wanted);
    assert_eq!(column("hysteresis", "Bouc-Wen", &stage.scene(), &shape), wanted);
}

#[test]
fn a_slipping_element_follows_its_differential_equation() {
    // Strokes that grow, with reversals before, in and after the slip.
    let stage = Stage::new(grid(2e-3, 12.0), |t| (0.3 * t * (TAU * t).sin(), 1.0), None);
    let x = stage.recording.displacement();
    for [rho, depth, width, place] in [[0.7, 0.9, 0.15, 0.1], [3.0, 0.97, 0.8, 0.5], [20.0, 0.1, 0.1, 0.0]] {
        let found = column("pinching", "Baber-Noori element", &stage.scene(), &[rho, depth, width, place]);
        let rate = |w: f64, side: f64| {
            let slip = depth * (-((w * side - place) / width).powi(2)).exp();
            rho * (1.0 - w.abs().powf(1.5) * (w * side).signum()) * (1.0 - slip)
        };
        let mut w: f64 = 0.0;
        for i in 1..x.len() {
            assert!((found[i - 1] - w).abs() < 1e-4, "{} instead of {w} at {i}", found[i - 1]);
            let h = (x[i] - x[i - 1]) / 100.0;
            for _ in 0..100 {
                let middle = w + 0.5 * h * rate(w, h.signum());
                w += h * rate(middle, h.signum());
            }
        }
    }
}

#[test]
fn a_slipping_element_that_yields_at_once_stays_at_its_yield() {
    let stage = Stage::sine(3.0, 1.0, 2.0);
    let found = column("pinching", "Baber-Noori element", &stage.scene(), &[f64::MAX, 0.9, 0.15, 0.1]);
    assert!(found[1..].iter().all(|w| (w.abs() - 1.0).abs() < 1e-5));
}

#[test]
fn a_stop_acts_at_each_end_from_its_own_gap_and_dissipates_by_its_depth() {
    let stage = Stage::sine(3.0, 1.0, 2.0);
    let (x, v) = (stage.recording.displacement(), stage.recording.velocity());
    let uneven = column("end_stop", "both ends, uneven gaps", &stage.scene(), &[1.0, 2.0]);
    let round = column("end_stop", "Hertz contact, uneven gaps", &stage.scene(), &[1.0, 2.0]);
    let damped = law("end_stop", "Hertz contact with damping").columns(&stage.scene(), &[1.5]);
    for i in 0..x.len() {
        let (positive, negative) = ((x[i] - 1.0).max(0.0), (-x[i] - 2.0).max(0.0));
        close(uneven[i], positive - negative, 1e-12);
        close(round[i], positive.powf(1.5) - negative.powf(1.5), 1e-12);
        let depth = (x[i].abs() - 1.5).max(0.0).powf(1.5);
        close(damped[0][i], depth * x[i].signum(), 1e-12);
        close(damped[1][i], depth * v[i], 1e-12);
    }
}

#[test]
fn an_elastic_plastic_element_has_its_loop_area() {
    let (amplitude, r) = (2.0, 0.5);
    let stage = Stage::sine(amplitude, 1.0, 3.0);
    let p = column("hysteresis", "elastic-plastic element", &stage.scene(), &[r]);
    let (time, v) = (stage.recording.time(), stage.recording.velocity());
    let last = 2000..3000;
    let area: f64 = last.map(|i| 0.5 * (time[i + 1] - time[i]) * (p[i] * v[i] + p[i + 1] * v[i + 1])).sum();
    close(area, 4.0 * r * (amplitude - r), 1e-3);
}

#[test]
fn a_uniform_iwan_body_loads_along_a_parabola() {
    let stage = Stage::new(grid(1e-3, 1.0), |t| (t, 1.0), None);
    let f = column("hysteresis", "Iwan, uniform yields", &stage.scene(), &[1.0]);
    for i in [200, 500, 900] {
        let x = 1e-3 * i as f64;
        assert!((f[i] - (x - 0.5 * x * x)).abs() < 2e-3);
    }
    let same = column("hysteresis", "Iwan, power distribution of yields", &stage.scene(), &[1.0, 1.0]);
    assert_eq!(f, same);
}

#[test]
fn elements_that_yield_between_two_displacements_load_by_their_distribution() {
    let stage = Stage::new(grid(1e-3, 1.2), |t| (t, 1.0), None);
    let (h, name) = (0.04_f64, "Iwan, power distribution between two yields");
    let f = column("hysteresis", name, &stage.scene(), &[1.0, h, -0.5]);
    let below = |r: f64| (h.powf(-0.5) - r.powf(-0.5)) / (h.powf(-0.5) - 1.0);
    for i in [20, 100, 400, 900, 1100] {
        let (x, end) = (1e-3 * i as f64, (1e-3 * i as f64).clamp(h, 1.0));
        let yielded = (end.sqrt() - h.sqrt()) / (h.powf(-0.5) - 1.0);
        assert!((f[i] - yielded - x * (1.0 - below(end))).abs() < 2e-3, "{i}: {}", f[i]);
    }
}

#[test]
fn a_contact_follows_a_power_of_its_depth_and_may_dissipate_by_it() {
    let stage = Stage::sine(3.0, 1.0, 2.0);
    let (x, v) = (stage.recording.displacement(), stage.recording.velocity());
    let power = column("end_stop", "power of the depth", &stage.scene(), &[1.5, 2.5]);
    let flat = law("end_stop", "both ends with damping").columns(&stage.scene(), &[1.5]);
    for i in 0..x.len() {
        let depth = (x[i].abs() - 1.5).max(0.0);
        close(power[i], depth.powf(2.5) * x[i].signum(), 1e-12);
        close(flat[0][i], depth * x[i].signum(), 1e-12);
        close(flat[1][i], depth * v[i], 1e-12);
    }
}

#[test]
fn a_power_is_one_at_the_largest_stroke() {
    let stage = Stage::sine(3.0, 1.0, 2.0);
    let f = column("cubic_stiffness", "power", &stage.scene(), &[2.5]);
    for (f, x) in f.iter().zip(stage.recording.displacement()) {
        close(*f, (x.abs() / 3.0).powf(2.5) * x.signum(), 1e-6);
    }
}

#[test]
fn inertia_is_in_newtons_for_kilograms() {
    let stage = Stage::sine(10.0, 1.0, 3.0);
    let a = column("inertia", "moving mass", &stage.scene(), &[]);
    let (sin, _) = harmonic(&stage, &a, 1.0, 2.0);
    close(sin, -0.01 * TAU * TAU, 1e-3);
}

/// A step of 1 mm, held from the tenth sample on.
fn step_and_hold(t: f64) -> (f64, f64) {
    let velocity = if (t - 0.1).abs() < 0.005 { 100.0 } else { 0.0 };
    (if t < 0.095 { 0.0 } else { 1.0 }, velocity)
}

#[test]
fn a_fading_spectrum_relaxes_with_the_logarithm_of_time() {
    // Times beyond ten times the recording are not in the spectrum.
    let stage = Stage::new(grid(0.01, 100.0), step_and_hold, None);
    let f = column("creep", "logarithmic", &stage.scene(), &[0.1]);
    let lost = |i: usize| (1.0 + 0.01 * i as f64 / 0.1).log10();
    for i in [5, 20, 100, 200, 300] {
        close(f[10 + i] - f[10 + 10 * i], lost(10 * i) - lost(i), 0.02);
    }
}

#[test]
fn creep_begins_alike_in_long_and_short_recordings() {
    let [long, short] = [100.0, 10.0].map(|end| Stage::new(grid(0.01, end), step_and_hold, None));
    // Of one campaign: the sizes are those of the longest.
    let of_both = crate::effect::Scene { sizes: &long.sizes, ..short.scene() };
    let [whole, part] = [long.scene(), of_both].map(|scene| column("creep", "logarithmic", &scene, &[0.1]));
    for i in [1, 10, 100, 1000] {
        close(part[i], whole[i], 1e-9);
    }
    let lost = |i: usize| (1.0 + 0.01 * i as f64 / 0.1).log10();
    close(whole[15] - whole[9010], lost(9000) - lost(5), 0.01);
}

#[test]
fn an_element_narrow_in_the_middle_is_a_hysteretic_one_that_loses_force_there() {
    let stage = Stage::sine(3.0, 0.5, 8.0);
    let scene = stage.scene();
    let narrow = column("pinching", "element, narrow in the middle", &scene, &[2.0, 0.6, 0.5]);
    let plain = column("hysteresis", "Bouc-Wen", &scene, &[2.0, 0.5, 1.5]);
    for (i, x) in scene.displacement.iter().enumerate() {
        close(narrow[i], plain[i] * (1.0 - 0.6 * (-(x / 0.5).powi(2)).exp()), 1e-12);
    }
}

#[test]
fn a_law_with_the_current_is_the_plain_one_shared_between_two_levels() {
    let current = |t: f64| 0.5 + 0.25 * t;
    let time = grid(0.01, 4.0);
    let series = time.iter().map(|t| current(*t)).collect();
    let stage = Stage::new(time, |t| (3.0 * (2.0 * t).sin(), 6.0 * (2.0 * t).cos()), Some(series));
    let scene = stage.scene();
    let plain = column("coulomb_friction", "Dahl", &scene, &[0.1]);
    let both = law("coulomb_friction", "Dahl, with the current");
    let columns = both.columns(&scene, &[0.1]);
    assert_eq!(columns.len(), both.coefficients().len());
    for (i, t) in scene.time.iter().enumerate() {
        close(columns[0][i] + columns[1][i], plain[i], 1e-12);
        close(columns[1][i], plain[i] * t / 4.0, 1e-12);
    }
    let still = Stage::sine(1.0, 1.0, 2.0);
    assert!(!both.applies(&still.sizes));
}

#[test]
fn a_scaled_field_dependence_vanishes_at_the_ends_of_the_current() {
    let time = grid(0.01, 4.0);
    let series = time.iter().map(|t| 1.0 + t).collect();
    let stage = Stage::new(time, |t| (t.sin(), t.cos()), Some(series));
    let effect = law("field_dependence", "whole force scaled");
    let factors = effect.factors(&stage.scene(), &[0.3]).expect("it scales");
    let damping = factors.damping.expect("damping as well");
    for (i, t) in stage.scene().time.iter().enumerate() {
        let u = t / 4.0;
        close(factors.stiffness[i], 1.0 - 0.3 * 4.0 * u * (1.0 - u), 1e-12);
        close(damping[i], factors.stiffness[i], 1e-12);
    }
}

/// Steps of a bent branch from rest by the classical Runge-Kutta method, 16 to a sample, on the lines between velocities.
fn stretched(stage: &Stage, rate: impl Fn(f64) -> f64) -> Vec<f64> {
    let scene = stage.scene();
    let (time, v) = (scene.time, scene.velocity);
    scene.trace(0.0, |q, i| {
        let h = (time[i] - time[i - 1]) / 16.0;
        let at = |s: f64| v[i - 1] + (v[i] - v[i - 1]) * s / 16.0;
        (0..16).fold(q, |q, k| {
            let [early, middle, late] = [0.0, 0.5, 1.0].map(|s| at(f64::from(k) + s));
            let a = early + rate(q);
            let b = middle + rate(q + 0.5 * h * a);
            let c = middle + rate(q + 0.5 * h * b);
            let d = late + rate(q + h * c);
            q + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        })
    })
}

#[test]
fn a_branch_that_is_not_linear_follows_its_equation() {
    let swung = |t: f64| (5.0 * (TAU * t).sin(), 5.0 * TAU * (TAU * t).cos());
    let uneven = grid(1e-3, 3.0).into_iter().map(|t| t + 2e-4 * (300.0 * t).sin()).collect();
    for stage in [Stage::sine(5.0, 1.0, 3.0), Stage::new(uneven, swung, None)] {
        for (tau, bend) in [(0.02, 0.1), (0.2, 0.5), (0.2, 4.0), (2.0, 15.0)] {
            let hard = |q: f64| q * (1.0 + (q / bend) * (q / bend));
            let yielding = |q: f64| bend * (q / bend).sinh();
            let exact = [
                (
                    "one branch, hardening spring",
                    stretched(&stage, |q| -hard(q) / tau).into_iter().map(hard).collect(),
                ),
                ("one branch, Eyring dashpot", stretched(&stage, |q| -yielding(q) / tau)),
            ];
            for (name, wanted) in exact {
                let found = column("maxwell_relaxation", name, &stage.scene(), &[tau, bend]);
                let size = wanted.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
                for (found, wanted) in found.iter().zip(&wanted) {
                    assert!(
                        (found - wanted).abs() < 5e-4 * size,
                        "{name} {tau} {bend}: {found} for {wanted}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_dashpot_yields_to_any_motion_and_forgets_it_over_a_long_rest() {
    // 5 mm within a sample of 10 s, which stretches the spring by 500 bends and more; then a rest.
    let time: Vec<f64> = (0..30).map(|i| f64::from(i) * 10.0).collect();
    let stage = Stage::new(time, |t| if t < 100.0 { (0.5 * t, 0.5) } else { (50.0, 0.0) }, None);
    for (tau, bend) in [(0.05, 0.01), (50.0, 0.01), (1e6, 0.01)] {
        let found = column("maxwell_relaxation", "one branch, Eyring dashpot", &stage.scene(), &[tau, bend]);
        // What a stretch without end comes to in the last quarter of a step.
        let most = bend * (2.0 * tau / 2.5 + 1.0).ln() + 3.0 * bend;
        assert!(found.iter().all(|q| q.abs() <= most), "{tau}: {found:?}");
        assert!(found[29] <= found[9], "{tau}: {found:?}");
    }
}
