//! Dry friction against closed forms.

use super::{Stage, close, column, grid};

#[test]
fn dahl_slides_as_its_closed_form_and_coulomb_dissipates_four_strokes() {
    let stage = Stage::new(grid(1e-3, 1.0), |t| (t, 1.0), None);
    let z = column("coulomb_friction", "Dahl", &stage.scene(), &[0.1]);
    assert!((z[150] - (1.0 - (-1.5_f64).exp())).abs() < 1e-12);
    let stage = Stage::sine(2.0, 1.0, 3.0);
    let (time, v) = (stage.recording.time(), stage.recording.velocity());
    for (name, shape) in [("Dahl", 1e-3), ("smoothed sign", 0.05)] {
        let z = column("coulomb_friction", name, &stage.scene(), &[shape]);
        let area: f64 =
            (2000..3000).map(|i| 0.5 * (time[i + 1] - time[i]) * (z[i] * v[i] + z[i + 1] * v[i + 1])).sum();
        close(area, 8.0, 2e-3);
    }
}

#[test]
fn a_slider_is_elastic_until_it_slips() {
    let stage = Stage::new(grid(1e-3, 1.0), |t| (t, 1.0), None);
    let z = column("coulomb_friction", "elastic slider", &stage.scene(), &[0.1]);
    for (i, z) in z.iter().enumerate() {
        assert!((z - (1e-2 * i as f64).min(1.0)).abs() < 1e-12);
    }
    let stage = Stage::sine(2.0, 1.0, 3.0);
    let z = column("coulomb_friction", "elastic slider", &stage.scene(), &[0.25]);
    let p = column("hysteresis", "elastic-plastic element", &stage.scene(), &[0.25]);
    assert!(z.iter().zip(&p).all(|(z, p)| (0.25 * z - p).abs() < 1e-4));
}

#[test]
fn a_sign_is_rounded_as_its_closed_forms() {
    let stage = Stage::sine(2.0, 1.0, 1.0);
    for n in [1.0, 2.0] {
        let f = column("coulomb_friction", "rounded sign", &stage.scene(), &[0.1, n]);
        for (f, v) in f.iter().zip(stage.recording.velocity()) {
            let wanted = if n < 2.0 { v / (v.abs() + 0.1) } else { v / (v * v + 0.01).sqrt() };
            assert!((f - wanted).abs() < 1e-12);
        }
    }
}

#[test]
fn dahl_of_any_exponent_slides_as_its_closed_form() {
    let stage = Stage::new(grid(1e-3, 1.0), |t| (t, 1.0), None);
    let of = |gamma: f64| column("coulomb_friction", "Dahl, any exponent", &stage.scene(), &[0.1, gamma]);
    let (slow, sharp) = (of(2.0), of(0.5));
    for (i, x) in stage.recording.displacement().iter().enumerate() {
        close(slow[i], x / (0.1 + x), 1e-9);
        close(sharp[i], 1.0 - (1.0 - x / 0.2).max(0.0).powi(2), 1e-9);
    }
    let back = Stage::sine(3.0, 1.0, 2.0);
    let one = column("coulomb_friction", "Dahl, any exponent", &back.scene(), &[0.1, 1.0]);
    for (a, b) in one.iter().zip(column("coulomb_friction", "Dahl", &back.scene(), &[0.1])) {
        close(*a, b, 1e-9);
    }
}

#[test]
fn a_held_element_of_dahl_keeps_its_force() {
    let moved = |t: f64| if t < 0.5 { (t, 1.0) } else { (0.5, 0.0) };
    let stage = Stage::new(grid(1e-3, 1.0), moved, None);
    let z = column("coulomb_friction", "Dahl, any exponent", &stage.scene(), &[0.1, 2.0]);
    assert!(z[990] > 0.8 && (z[990] - z[510]).abs() < 1e-12, "{} {}", z[510], z[990]);
}

#[test]
fn bristles_without_an_excess_are_the_element_of_dahl() {
    let stage = Stage::sine(2.0, 1.0, 3.0);
    let plain = column("coulomb_friction", "Dahl", &stage.scene(), &[0.1]);
    assert_eq!(column("stribeck_friction", "LuGre", &stage.scene(), &[1.0, 0.1, 0.0]), plain);
}

#[test]
fn bristles_reach_the_friction_of_their_speed_over_the_pre_sliding_displacement() {
    for speed in [0.5_f64, 2.0, 20.0] {
        let stage = Stage::new(grid(1e-3, 4.0), |t| (speed * t, speed), None);
        let found = column("stribeck_friction", "LuGre", &stage.scene(), &[2.0, 0.1, 0.8]);
        let steady = 1.0 + 0.8 * (-(speed / 2.0).powi(2)).exp();
        for (t, z) in stage.recording.time().iter().zip(found) {
            let way = (-speed * t / (0.1 * steady)).exp();
            assert!((z - steady * (1.0 - way)).abs() < 1e-9, "{speed} at {t}: {z}");
        }
    }
}
