//! Generic features with memory: what a mismatch of unknown physics would depend on.

use crate::effect::Scene;

/// Relaxation times of the memories, s.
const MEMORIES: [f64; 5] = [0.01, 0.05, 0.2, 1.0, 5.0];

/// What a feature depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum On {
    /// Displacement alone.
    Displacement,
    /// Velocity alone.
    Velocity,
    /// Displacement and velocity together.
    State,
    /// Force.
    Force,
    /// Acceleration.
    Acceleration,
    /// Motion that fades from memory with this time, s.
    Memory(f64),
    /// Path since the last reversal, as a share of the largest displacement.
    Reversal(f64),
    /// Amplitude of the motion now or lately.
    Amplitude,
    /// Largest displacement so far.
    Largest,
    /// Travelled path.
    Path,
    /// Power dissipated lately.
    Heat,
    /// Time.
    Time,
    /// A wave in time of this frequency, Hz.
    Oscillation(f64),
    /// A stiffness or a strength that comes and goes at moments of its own.
    Moments,
    /// Coil current.
    Current,
    /// Something that differs from recording to recording.
    Recording,
}

/// A feature of one recording.
pub(super) struct Feature {
    pub(super) on: On,
    pub(super) column: Vec<f64>,
}

/// Features of one recording; the same number for every recording of a campaign.
pub(super) fn features(scene: &Scene) -> Vec<Feature> {
    let sizes = scene.sizes;
    let x: Vec<f64> = scene.displacement.iter().map(|x| x / sizes.displacement).collect();
    let v: Vec<f64> = scene.velocity.iter().map(|v| v / sizes.velocity).collect();
    let f: Vec<f64> = scene.force.iter().map(|f| f / sizes.force).collect();
    let n = x.len();
    let mut found: Vec<Feature> = Vec::new();
    let mut add = |on: On, g: &dyn Fn(usize) -> f64| {
        found.push(Feature { on, column: (0..n).map(g).collect() });
    };
    let near = |i: usize| (-(x[i] / 0.15).powi(2)).exp();
    add(On::Displacement, &|i| x[i] * x[i]);
    add(On::Displacement, &|i| x[i].powi(3));
    add(On::Displacement, &|i| x[i].powi(5));
    add(On::State, &|i| x[i] * v[i]);
    add(On::State, &|i| x[i] * x[i] * v[i]);
    add(On::State, &|i| x[i] * v[i] * v[i]);
    add(On::State, &|i| x[i].abs() * v[i]);
    add(On::Velocity, &|i| v[i] * v[i]);
    add(On::Velocity, &|i| v[i] * v[i].abs());
    add(On::Velocity, &|i| v[i].powi(3));
    add(On::Velocity, &|i| (20.0 * v[i]).tanh());
    add(On::Velocity, &|i| (3.0 * v[i]).tanh());
    add(On::Displacement, &|i| (x[i].abs() - 0.6).max(0.0).copysign(x[i]));
    add(On::Displacement, &|i| (x[i].abs() - 0.85).max(0.0).copysign(x[i]));
    add(On::Displacement, &|i| x[i] * near(i));
    add(On::State, &|i| v[i] * near(i));
    add(On::Force, &|i| f[i] * f[i]);
    add(On::Force, &|i| f[i].powi(3));
    let a = scene.acceleration.get();
    add(On::Acceleration, &|i| a[i]);
    for memory in MEMORIES {
        found.push(Feature { on: On::Memory(memory), column: low_passed(scene, &v, memory) });
    }
    for yields in [0.01, 0.1, 0.4] {
        found.push(Feature { on: On::Reversal(yields), column: friction(&x, yields) });
    }
    for (on, state) in states(scene, &x, &v) {
        for motion in [&x, &v] {
            let column = state.iter().zip(motion).map(|(s, m)| s * m).collect();
            found.push(Feature { on, column });
        }
    }
    if let (Some(current), Some((low, high))) = (scene.current, sizes.current)
        && sizes.current_varies
    {
        let share: Vec<f64> = current.iter().map(|i| (i - low) / (high - low)).collect();
        let slow = low_passed(scene, &share, 0.2);
        for power in [1, 2] {
            let column = share.iter().map(|s| s.powi(power)).collect();
            found.push(Feature { on: On::Current, column });
        }
        let square: Vec<f64> = share.iter().map(|s| s * s).collect();
        for q in [square, slow] {
            for motion in [&x, &v] {
                let column = q.iter().zip(motion).map(|(q, m)| q * m).collect();
                found.push(Feature { on: On::Current, column });
            }
        }
    }
    found
}

/// States of the history: amplitude now and before, largest so far, path, heat, time.
fn states(scene: &Scene, x: &[f64], v: &[f64]) -> Vec<(On, Vec<f64>)> {
    let time = scene.time;
    let amplitude = |forget: f64| {
        scene.trace(0.0, |a, i| (a * (-(time[i] - time[i - 1]) / forget).exp()).max(x[i].abs()))
    };
    let heat = low_passed(scene, &v.iter().map(|v| v * v).collect::<Vec<f64>>(), 10.0);
    let path = scene.trace(0.0, |p, i| p + (x[i] - x[i - 1]).abs());
    vec![
        (On::Amplitude, amplitude(0.3)),
        (On::Amplitude, amplitude(3.0)),
        (On::Largest, scene.trace(0.0, |m: f64, i| m.max(x[i].abs()))),
        (On::Path, path),
        (On::Heat, heat),
        (On::Time, time.iter().map(|t| (t - time[0]) / scene.duration()).collect()),
    ]
}

/// `z' = input - z / memory` from rest.
fn low_passed(scene: &Scene, input: &[f64], memory: f64) -> Vec<f64> {
    let time = scene.time;
    scene.trace(0.0, |z, i| {
        let h = time[i] - time[i - 1];
        let decay = (-h / memory).exp();
        decay * z + memory * (1.0 - decay) * 0.5 * (input[i] + input[i - 1])
    })
}

/// Friction with pre-sliding (Dahl 1968), for steps of the displacement.
fn friction(x: &[f64], yield_displacement: f64) -> Vec<f64> {
    let mut z = 0.0;
    std::iter::once(0.0)
        .chain(x.windows(2).map(|pair| {
            let step = pair[1] - pair[0];
            let end = step.signum();
            z = end + (z - end) * (-step.abs() / yield_displacement).exp();
            z
        }))
        .collect()
}
