//! Channels of motion, force and current against closed forms.

use std::f64::consts::{PI, TAU};

use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::{Stage, close, column, grid, harmonic, law};

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn filters_have_their_gains(corner in 3.0..60.0_f64, n in 125..2000_u32) {
        let f = 1000.0 / f64::from(n);
        let stage = Stage::sine(1.0, f, 4.0 / f + 2.0);
        let scene = stage.scene();
        let ratio = f / corner;
        let lag = 1.0 / (TAU * corner);
        let first = law("filter_lag", "force, first order").through(&scene, &[lag], scene.displacement);
        let (sin, cos) = harmonic(&stage, &first.unwrap(), f, 2.0);
        close(sin.hypot(cos), 1.0 / (1.0 + ratio * ratio).sqrt(), 5e-3);
        prop_assert!((cos.atan2(sin) + ratio.atan()).abs() < 5e-3);
        let lags = [lag, 0.5 * lag];
        let two = law("filter_lag", "force, two of first order").through(&scene, &lags, scene.displacement);
        let (sin, cos) = harmonic(&stage, &two.unwrap(), f, 2.0);
        close(sin.hypot(cos), 1.0 / ((1.0 + ratio * ratio) * (1.0 + 0.25 * ratio * ratio)).sqrt(), 5e-3);
        let behind = (cos.atan2(sin) + ratio.atan() + (0.5 * ratio).atan()).rem_euclid(TAU);
        prop_assert!(behind.min(TAU - behind) < 5e-3);
        for (order, name) in [(2, ""), (3, " of third order"), (4, " of fourth order")] {
            let name = format!("force, Butterworth{name}");
            let passed = law("filter_lag", &name).through(&scene, &[corner], scene.displacement);
            let (sin, cos) = harmonic(&stage, &passed.unwrap(), f, 2.0);
            close(sin.hypot(cos), 1.0 / (1.0 + ratio.powi(2 * order)).sqrt(), 5e-3);
            // Late at low frequencies by the sum of its poles' times.
            if ratio < 0.05 {
                let times = 1.0 / (std::f64::consts::PI / (2.0 * f64::from(order))).sin();
                prop_assert!((cos.atan2(sin) + ratio * times).abs() < 5e-3);
            }
        }
    }
}

#[test]
fn a_constant_force_passes_every_filter() {
    let stage = Stage::sine(1.0, 1.0, 2.0);
    let scene = stage.scene();
    let constant = vec![7.0; scene.len()];
    let lags = [0.01, 0.004];
    for (name, shape) in [
        ("force, first order", &lags[..1]),
        ("force, two of first order", &lags),
        ("force, Butterworth", &[20.0]),
        ("force, Butterworth of third order", &[20.0]),
        ("force, Butterworth of fourth order", &[20.0]),
    ] {
        let passed = law("filter_lag", name).through(&scene, shape, &constant).unwrap();
        assert!(passed.iter().all(|f| (f - 7.0).abs() < 1e-9));
    }
}

#[test]
fn a_delay_of_samples_is_a_shift() {
    let stage = Stage::sine(2.0, 1.0, 2.0);
    let scene = stage.scene();
    let late = law("time_delay", "pure delay").through(&scene, &[0.003], scene.force).unwrap();
    for (late, force) in late[13..].iter().zip(&scene.force[10..]) {
        assert!((late - force).abs() < 1e-6);
    }
}

#[test]
fn a_delay_of_the_motion_shows_the_device_that_of_another_time() {
    let stage = Stage::sine(3.0, 2.0, 4.0);
    let law = law("time_delay", "pure delay of the motion");
    let scene = stage.scene();
    for delay in [0.0037, -0.0112] {
        let seen = law.motion(&scene, &[delay]).expect("it moves");
        assert!(law.through(&scene, &[delay], scene.force).is_none());
        for i in [500, 1234, 3000] {
            let turn = std::f64::consts::TAU * 2.0 * (scene.time[i] - delay);
            close(seen.displacement[i], 3.0 * turn.sin(), 1e-6);
            close(seen.velocity[i], 3.0 * std::f64::consts::TAU * 2.0 * turn.cos(), 1e-5);
        }
    }
}

#[test]
fn clocks_that_run_apart_show_the_device_an_ever_earlier_motion() {
    let stage = Stage::sine(3.0, 2.0, 4.0);
    let scene = stage.scene();
    let law = law("time_delay", "clocks that run apart");
    for (delay, gained) in [(0.003, 0.02), (-0.008, 0.02), (0.0, -0.03)] {
        let seen = law.motion(&scene, &[delay, gained]).expect("it moves");
        for i in 50..scene.len() - 50 {
            let turn = TAU * 2.0 * (scene.time[i] - delay - gained * scene.time[i] / 4.0);
            assert!((seen.displacement[i] - 3.0 * turn.sin()).abs() < 1e-6, "{delay} {gained} {i}");
            assert!((seen.velocity[i] - 12.0 * PI * turn.cos()).abs() < 1e-5, "{delay} {gained} {i}");
        }
    }
}

#[test]
fn clocks_that_keep_together_delay_the_motion_alike() {
    let stage = Stage::sine(3.0, 2.0, 4.0);
    let scene = stage.scene();
    let [same, plain] =
        [("clocks that run apart", &[-0.0112, 0.0][..]), ("pure delay of the motion", &[-0.0112])]
            .map(|(name, shape)| law("time_delay", name).motion(&scene, shape).unwrap().displacement);
    for (a, b) in same.iter().zip(&plain) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}

#[test]
fn a_force_that_is_held_before_is_delayed_from_its_first_value() {
    let stage = Stage::sine(2.0, 1.0, 2.0);
    let scene = stage.scene();
    let last = scene.force.len() - 1;
    let [shifted, held] = ["pure delay", "pure delay, held before"].map(|name| law("time_delay", name));
    for (shape, held_at) in [(0.0035, 0..4), (-0.0035, last - 3..last + 1)] {
        let [shifted, held] = [shifted, held].map(|law| law.through(&scene, &[shape], scene.force).unwrap());
        for i in 0..=last {
            let wanted = match (held_at.contains(&i), shape > 0.0) {
                (true, true) => scene.force[0],
                (true, false) => scene.force[last],
                (false, _) => shifted[i],
            };
            assert!((held[i] - wanted).abs() < 1e-12, "{shape} {i}");
        }
    }
}

#[test]
fn a_lagged_displacement_channel_is_undone() {
    // x_device = sin; the channel shows its first-order lag, whose derivative restores it.
    let stage = Stage::sine(1.0, 1.0, 2.0);
    let scene = stage.scene();
    let seen = law("filter_lag", "displacement, first order").motion(&scene, &[0.01]).unwrap();
    let i = 777;
    assert!((seen.displacement[i] - (scene.displacement[i] + 0.01 * scene.velocity[i])).abs() < 1e-12);
}

#[test]
fn free_play_removes_its_gap() {
    let stage = Stage::sine(2.0, 1.0, 3.0);
    let scene = stage.scene();
    for name in ["dead zone", "play"] {
        let seen = law("backlash", name).motion(&scene, &[0.4]).unwrap();
        let far = seen.displacement.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
        close(far, 1.6, 1e-6);
    }
    let play = law("backlash", "play").motion(&scene, &[0.4]).unwrap();
    assert!(play.velocity.contains(&0.0));
    // On the way back from the peak the device stays until the gap of twice 0.4 is crossed.
    assert_eq!(play.displacement[1300], play.displacement[1250]);
}

#[test]
fn a_spring_beside_the_device_has_no_force_within_its_gap() {
    let stage = Stage::sine(2.0, 1.0, 2.0);
    let force = column("backlash", "spring with a dead zone", &stage.scene(), &[0.5]);
    for (force, x) in force.iter().zip(stage.recording.displacement()) {
        assert!((force - x.signum() * (x.abs() - 0.5).max(0.0)).abs() < 1e-12);
    }
}

#[test]
fn a_spring_with_play_leaves_the_damper_its_velocity() {
    let stage = Stage::sine(2.0, 1.0, 2.0);
    let scene = stage.scene();
    let whole = law("backlash", "play").motion(&scene, &[0.3]).unwrap();
    let spring = law("backlash", "play of the spring").motion(&scene, &[0.3]).unwrap();
    assert_eq!(spring.displacement, whole.displacement);
    assert_eq!(spring.velocity, scene.velocity);
    assert_ne!(whole.velocity, scene.velocity);
}

#[test]
fn a_gap_with_round_edges_is_crossed_smoothly() {
    let stage = Stage::sine(2.0, 1.0, 2.0);
    let law = law("backlash", "dead zone with round edges");
    let seen = law.motion(&stage.scene(), &[0.3]).unwrap();
    let (time, x) = (stage.recording.time(), stage.recording.displacement());
    for i in 1..x.len() - 1 {
        close(seen.displacement[i], x[i] - 0.3 * (x[i] / 0.3).tanh(), 1e-12);
        let slope = (seen.displacement[i + 1] - seen.displacement[i - 1]) / (time[i + 1] - time[i - 1]);
        assert!((seen.velocity[i] - slope).abs() < 2e-2, "{} instead of {slope}", seen.velocity[i]);
    }
    let closed = law.motion(&stage.scene(), &[0.0]).unwrap();
    assert_eq!((closed.displacement.as_slice(), closed.velocity.as_slice()), (x, stage.recording.velocity()));
}

#[test]
fn a_stiff_rig_takes_its_share_of_the_motion() {
    let stage = Stage::sine(2.0, 1.0, 3.0);
    let scene = stage.scene();
    let seen = law("rig_compliance", "spring in series").motion(&scene, &[0.01]).unwrap();
    let i = 1234;
    assert!((seen.displacement[i] - (scene.displacement[i] - 0.01 * scene.force[i])).abs() < 1e-12);
    let rate = 5.0 * scene.velocity[i] - 0.3 * TAU * TAU * scene.displacement[i];
    assert!((seen.velocity[i] - (scene.velocity[i] - 0.01 * rate)).abs() < 1e-4);
}

#[test]
fn the_field_follows_a_step_of_the_current() {
    let time = grid(1e-3, 2.0);
    let current: Vec<f64> = time.iter().map(|t| if *t < 0.5 { 1.0 } else { 2.0 }).collect();
    let stage = Stage::new(time, |t| ((TAU * t).sin(), TAU * (TAU * t).cos()), Some(current));
    for (name, shape) in [("first order", vec![0.1]), ("rise and fall", vec![0.1, 1.5])] {
        let field = law("field_lag", name).current(&stage.scene(), &shape).unwrap();
        assert_eq!(field[400], 1.0);
        assert!((field[600] - (2.0 - (-1.0_f64).exp())).abs() < 0.01);
    }
    // A step through two equal lags: 1 - (1 + t/tau) exp(-t/tau).
    let twice = law("field_lag", "second order").current(&stage.scene(), &[0.1]).unwrap();
    assert!((twice[600] - (2.0 - 2.0 * (-1.0_f64).exp())).abs() < 0.01);
}

#[test]
fn what_is_affine_in_the_current_belongs_to_the_base() {
    let time = grid(1e-2, 4.0);
    let current: Vec<f64> = time.iter().map(|t| 0.5 + 0.25 * t).collect();
    let stage = Stage::new(time, |t| ((TAU * t).sin() + 0.3, TAU * (TAU * t).cos()), Some(current));
    for (name, shape) in [("square", vec![]), ("saturating", vec![0.4])] {
        let q = column("field_dependence", name, &stage.scene(), &shape);
        assert!(q[0].abs() < 1e-12 && q[400].abs() < 1e-12 && q[210].abs() > 0.05);
    }
}

#[test]
fn the_play_of_a_rising_current_lags_by_its_width() {
    let time = grid(1e-2, 4.0);
    let current: Vec<f64> = time.iter().map(|t| 0.5 * t).collect();
    let stage = Stage::new(time, |t| (1.0 + 0.1 * t, 0.1), Some(current));
    let q = column("field_remanence", "play", &stage.scene(), &[0.2]);
    let x = stage.recording.displacement();
    assert!((q[300] + 0.2 * x[300]).abs() < 1e-12);
}

#[test]
fn drift_and_hum_are_of_the_measurement() {
    let stage = Stage::sine(2.0, 1.0, 4.0);
    let scene = stage.scene();
    close(column("force_drift", "linear", &scene, &[])[4000], 1.0, 1e-12);
    close(column("force_drift", "settling", &scene, &[2.0])[2000], 1.0 - (-1.0_f64).exp(), 1e-12);
    let hum = law("mains_interference", "fundamental").columns(&scene, &[50.0]);
    assert!((hum[0][5] - 1.0).abs() < 1e-9 && (hum[1][10] + 1.0).abs() < 1e-9);
    for effect in ["force_drift", "mains_interference"] {
        assert!(
            crate::effect::CATALOGUE
                .iter()
                .filter(|e| e.about().effect == effect)
                .all(|e| e.of_the_measurement())
        );
    }
}

#[test]
fn an_amplifier_saturates_at_its_level() {
    let stage = Stage::sine(2.0, 1.0, 4.0);
    let scene = stage.scene();
    let largest = scene.whole.iter().fold(0.0_f64, |far, f| far.max(f.abs()));
    let shown = |level: f64, sharpness: f64| {
        law("force_clipping", "gradual").shown(&scene, &[level, sharpness]).unwrap()
    };
    for ((share, hard), force) in shown(largest, 2.0).iter().zip(shown(0.5 * largest, 200.0)).zip(scene.whole)
    {
        assert!((share * force - force / (1.0 + (force / largest).powi(2)).sqrt()).abs() < 1e-12 * largest);
        let clamped = force.clamp(-0.5 * largest, 0.5 * largest);
        assert!((hard * force - clamped).abs() < 0.01 * largest);
    }
}

#[test]
fn a_hum_is_told_from_motion_where_it_is_sampled_or_folded_far_above_it() {
    for (frequency, rate, wanted) in [
        (50.0, 1000.0, true),
        (50.0, 128.0, true),
        (60.0, 128.0, true),
        (60.0, 100.0, true),
        (50.0, 100.0, true),
        (60.0, 64.0, false),
        (50.0, 50.0, false),
    ] {
        assert_eq!(crate::effect::told(frequency, 1.0 / rate), wanted, "{frequency} Hz at {rate} Hz");
    }
    // At half the sampling rate only one phase is left.
    let stage = Stage::new(grid(1e-2, 4.0), |t| (t.sin(), t.cos()), None);
    let hum = law("mains_interference", "fundamental").columns(&stage.scene(), &[50.0]);
    assert!(hum[0].iter().all(|v| *v == 0.0) && (hum[1][7] + 1.0).abs() < 1e-9);
}

#[test]
fn a_remanent_current_stays_as_the_current_falls() {
    let time = grid(1e-2, 4.0);
    let current: Vec<f64> = time.iter().map(|t| 2.0 - 2.0 * (0.5 * t - 1.0).abs()).collect();
    let stage = Stage::new(time, |t| (1.0 + 0.1 * t, 0.1), Some(current.clone()));
    let largest = law("field_remanence", "largest past current, seen").current(&stage.scene(), &[0.3]);
    let plays = law("field_remanence", "plays, seen").current(&stage.scene(), &[0.5, 0.6]);
    let (largest, plays) = (largest.unwrap(), plays.unwrap());
    close(largest[150], current[150], 1e-12);
    close(largest[400], 0.3 * 2.0, 1e-12);
    // Six plays of half widths 0.1 to 0.6 A: 0.35 A behind on the way up, ahead on the way down.
    close(plays[150], current[150] - 0.5 * 0.35, 1e-12);
    close(plays[390], current[390] + 0.5 * 0.35, 1e-12);
}

#[test]
fn a_device_raised_from_zero_lags_from_the_start_unless_its_first_rise_is_followed() {
    let time = grid(1e-2, 4.0);
    let current: Vec<f64> = time.iter().map(|t| 1.0 + 0.5 * t).collect();
    let stage = Stage::new(time, |t| (1.0 + 0.1 * t, 0.1), Some(current.clone()));
    let seen = |name| law("field_remanence", name).current(&stage.scene(), &[0.5, 0.6]).unwrap();
    for i in [0, 150, 400] {
        close(seen("plays, seen, from zero")[i], current[i] - 0.5 * 0.35, 1e-12);
        close(seen("plays, seen, first rise followed")[i], current[i], 1e-12);
    }
    close(seen("plays, seen")[0], current[0], 1e-12);
}
