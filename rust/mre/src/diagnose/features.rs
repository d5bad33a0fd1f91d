//! Generic features with memory: what a mismatch of unknown physics would depend on.

use crate::effect::Scene;

/// Relaxation times of the memories, s.
const MEMORIES: [f64; 5] = [0.01, 0.05, 0.2, 1.0, 5.0];

/// Features of one recording; the same number for every recording of a campaign.
pub(super) fn features(scene: &Scene) -> Vec<Vec<f64>> {
    let sizes = scene.sizes;
    let x: Vec<f64> = scene.displacement.iter().map(|x| x / sizes.displacement).collect();
    let v: Vec<f64> = scene.velocity.iter().map(|v| v / sizes.velocity).collect();
    let f: Vec<f64> = scene.force.iter().map(|f| f / sizes.force).collect();
    let n = x.len();
    let each = |g: &dyn Fn(usize) -> f64| (0..n).map(g).collect::<Vec<f64>>();
    let mut found: Vec<Vec<f64>> = vec![
        each(&|i| x[i] * x[i]),
        each(&|i| x[i].powi(3)),
        each(&|i| x[i].powi(5)),
        each(&|i| x[i] * v[i]),
        each(&|i| x[i] * x[i] * v[i]),
        each(&|i| x[i] * v[i] * v[i]),
        each(&|i| x[i].abs() * v[i]),
        each(&|i| v[i] * v[i]),
        each(&|i| v[i] * v[i].abs()),
        each(&|i| v[i].powi(3)),
        each(&|i| (20.0 * v[i]).tanh()),
        each(&|i| (3.0 * v[i]).tanh()),
        each(&|i| (x[i].abs() - 0.6).max(0.0).copysign(x[i])),
        each(&|i| (x[i].abs() - 0.85).max(0.0).copysign(x[i])),
        each(&|i| x[i] * (-(x[i] / 0.15).powi(2)).exp()),
        each(&|i| v[i] * (-(x[i] / 0.15).powi(2)).exp()),
        each(&|i| f[i] * f[i]),
        each(&|i| f[i].powi(3)),
        each(&|i| scene.acceleration[i]),
    ];
    for memory in MEMORIES {
        found.push(low_passed(scene, &v, memory));
    }
    for yield_displacement in [0.01, 0.1, 0.4] {
        found.push(friction(&x, yield_displacement));
    }
    for state in states(scene, &x, &v) {
        found.push(each(&|i| state[i] * x[i]));
        found.push(each(&|i| state[i] * v[i]));
    }
    if let (Some(current), Some((low, high))) = (scene.current, sizes.current)
        && sizes.current_varies
    {
        let share = |i: usize| (current[i] - low) / (high - low);
        let slow = low_passed(scene, &(0..n).map(share).collect::<Vec<f64>>(), 0.2);
        for q in [each(&|i| share(i).powi(2)), slow] {
            found.push(each(&|i| q[i] * x[i]));
            found.push(each(&|i| q[i] * v[i]));
        }
    }
    found
}

/// States of the history: amplitude now and before, largest so far, path, heat, time.
fn states(scene: &Scene, x: &[f64], v: &[f64]) -> Vec<Vec<f64>> {
    let time = scene.time;
    let amplitude = |forget: f64| {
        scene.trace(0.0, |a, i| (a * (-(time[i] - time[i - 1]) / forget).exp()).max(x[i].abs()))
    };
    let heat = low_passed(scene, &v.iter().map(|v| v * v).collect::<Vec<f64>>(), 10.0);
    let path = scene.trace(0.0, |p, i| p + (x[i] - x[i - 1]).abs());
    vec![
        amplitude(0.3),
        amplitude(3.0),
        scene.trace(0.0, |m: f64, i| m.max(x[i].abs())),
        path,
        heat,
        time.iter().map(|t| (t - time[0]) / scene.duration()).collect(),
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
