//! Laws with memory in a recording that is cut from a steady motion.

use super::*;

#[test]
fn a_springpot_that_always_moved_so_is_a_power_of_the_frequency_from_the_first_sample_on() {
    let w = TAU * 1.3;
    for phase in [0.3, 1.1, 2.4, 4.0] {
        let stage = Stage::new(
            grid(2e-3, 8.0),
            |t| (3.0 + 2.0 * (w * t + phase).sin(), 2.0 * w * (w * t + phase).cos()),
            None,
        );
        let scene = stage.scene();
        for a in [0.15, 0.5, 0.8] {
            let found = column("fractional_viscoelasticity", "springpot", &scene, &[a]);
            let size = 2.0 * w.powf(a);
            for (t, y) in scene.time.iter().zip(&found) {
                let wanted = size * (w * t + phase + 0.25 * TAU * a).sin();
                assert!((y - wanted).abs() < 0.01 * size, "{a} {phase} {t}: {y} for {wanted}");
            }
        }
    }
}

#[test]
fn a_motion_that_swells_starts_from_rest() {
    let w = TAU * 1.3;
    let stage =
        Stage::new(grid(2e-3, 8.0), |t| (t * (w * t).sin(), (w * t).sin() + t * w * (w * t).cos()), None);
    let found = column("fractional_viscoelasticity", "springpot", &stage.scene(), &[0.3]);
    assert_eq!(found[0], 0.0);
}

#[test]
fn what_creeps_in_a_steady_motion_has_no_run_in() {
    let w = TAU * 1.3;
    for phase in [0.3, 1.6, 4.0] {
        let motion = |t: f64| (3.0 + 2.0 * (w * t + phase).sin(), 2.0 * w * (w * t + phase).cos());
        let stage = Stage::new(grid(2e-3, 8.0), motion, None);
        let scene = stage.scene();
        let tau = 20.0;
        let found = column("creep", "one slow branch", &scene, &[tau]);
        for (t, y) in scene.time.iter().zip(&found) {
            // z' = v - z/tau of a sine that always was.
            let (sin, cos) = (w * t + phase).sin_cos();
            let wanted = 2.0 * w * tau * (cos + w * tau * sin) / (1.0 + (w * tau).powi(2));
            assert!((y - wanted).abs() < 0.01, "{phase} {t}: {y} for {wanted}");
        }
    }
}
