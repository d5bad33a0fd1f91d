//! A residual that follows the motion of its own recording is a mismatch: an autoregression of a recording would
//! take it for a narrow band of noise, and whiten the mismatch away. Of a sine that is its frequency, and multiples of it. One
//! that follows a current that changes is as little noise.

use std::ops::Range;

use rayon::prelude::*;

use super::autoregression::{Choice, Products};
use super::distribution::{CAUTION, chi_square_tail};
use super::hum::without_hum;
use crate::assembly::Assembly;
use crate::kernel::filter::dot;
use crate::recording::Recording;

/// A residual follows the motion where that is more than such a share of its squares in two halves,
const MOST: f64 = 0.5;
/// each of so many cycles: slow noise follows a motion of fewer too.
const MANY_CYCLES: usize = 5;
/// Or where it is such a share in more stretches, or that above of higher orders: a narrow band of noise as large as the
/// rest may be at a multiple of the motion by chance,
const SOME: f64 = 0.2;
/// each of so many cycles,
const CYCLES: usize = 2;
/// and an autoregression predicts the rest so much better as chance would let it this seldom.
const BY_CHANCE: f64 = 1e-6;
/// Or where so little of the squares stays over many cycles: an autoregression predicts pure lines as well as it does
/// the rest.
const PURE: f64 = 0.01;
/// Displacement and velocity, and what goes with their products of the second and the third order.
const ORDERS: usize = 3;
/// Most stretches of a recording, in each of which its residual may follow the motion in another way.
const STRETCHES: usize = 8;
/// Share of its range by which a motion leaves its middle to count.
const ASIDE: f64 = 0.1;

/// Residuals in N of the scored samples, those that follow the motion less what follows it.
pub(super) fn without_the_coherent(assembly: &Assembly, residuals: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let recordings = assembly.campaign().recordings();
    residuals
        .into_par_iter()
        .zip(recordings)
        .map(|(residual, recording)| {
            let of = |series: &[f64]| series[recording.scored()].to_vec();
            let motion = [of(recording.displacement()), of(recording.velocity())];
            let left = beside_the_motion(&residual, &motion, recording).unwrap_or(residual);
            let Some(current) = recording.current().changing() else { return left };
            let current = [of(current), of(&differences(current))];
            beside_the_motion(&left, &current, recording).unwrap_or(left)
        })
        .collect()
}

/// Differences of a series from sample to sample; the first is that of the second.
fn differences(series: &[f64]) -> Vec<f64> {
    let later = series.windows(2).map(|pair| pair[1] - pair[0]);
    later.clone().take(1).chain(later).collect()
}

/// A residual that follows the motion, less what follows it.
fn beside_the_motion(residual: &[f64], motion: &[Vec<f64>; 2], recording: &Recording) -> Option<Vec<f64>> {
    let each_has = |count: usize, least: usize| {
        stretches(residual.len(), count).all(|s| cycles(&about_its_mean(&motion[0][s])) >= least)
    };
    let most = (1..=STRETCHES).rev().find(|count| each_has(*count, CYCLES))?;
    let step = 1.0 / recording.sampling_rate();
    let calm = without_hum(residual, step);
    let predicted = |series: &[f64]| Choice::of(&Products::of(series, step)).criterion;
    let mut left = None;
    for order in 1..=ORDERS {
        let before = left.as_ref().unwrap_or(&calm);
        let (after, share) = without(before, motion, order, most);
        let in_halves =
            || order == 1 && each_has(2, MANY_CYCLES) && without(before, motion, order, 2).1 < 1.0 - MOST;
        let is_pure = || each_has(1, MANY_CYCLES) && without(before, motion, order, 1).1 < PURE;
        let least = if order == 1 { SOME } else { MOST };
        let beyond_chance = || {
            let gain = || predicted(before) - predicted(&after);
            share < 1.0 - least && chi_square_tail(gain() / CAUTION, 2 * most) < BY_CHANCE
        };
        if in_halves() || is_pure() || beyond_chance() {
            left = Some(after);
        }
    }
    Some(residual.iter().zip(calm).zip(left?).map(|((e, calm), left)| e - calm + left).collect())
}

/// A residual less what follows products of an order in each of some stretches, and the share of its squares that stays.
fn without(residual: &[f64], motion: &[Vec<f64>; 2], order: usize, count: usize) -> (Vec<f64>, f64) {
    let mut left = Vec::with_capacity(residual.len());
    let (mut before, mut after) = (0.0, 0.0);
    for stretch in stretches(residual.len(), count) {
        let own = &residual[stretch.clone()];
        let e = about_its_mean(own);
        let products = products(&motion[0][stretch.clone()], &motion[1][stretch], order);
        let rest = products.iter().fold(e.clone(), |rest, column| beside(&rest, column));
        before += dot(&e, &e);
        after += dot(&rest, &rest);
        let mean = own.iter().sum::<f64>() / own.len() as f64;
        left.extend(rest.into_iter().map(|e| e + mean));
    }
    (left, after / before.max(f64::MIN_POSITIVE))
}

/// Two products of an order, beside each other and all of lower orders; the square of a sine's velocity is in those.
fn products(x: &[f64], v: &[f64], order: usize) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = Vec::new();
    for power in 0..order as i32 {
        for factor in [x, v] {
            let product: Vec<f64> = x.iter().zip(factor).map(|(x, factor)| x.powi(power) * factor).collect();
            let own = found.iter().fold(about_its_mean(&product), |own, lower| beside(&own, lower));
            found.push(own);
        }
    }
    found.split_off(2 * (order - 1))
}

/// Equal parts of so many samples.
fn stretches(samples: usize, count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).map(move |k| samples * k / count..samples * (k + 1) / count)
}

fn about_its_mean(series: &[f64]) -> Vec<f64> {
    let mean = series.iter().sum::<f64>() / series.len() as f64;
    series.iter().map(|value| value - mean).collect()
}

/// A series less its projection onto another.
fn beside(series: &[f64], other: &[f64]) -> Vec<f64> {
    let share = dot(series, other) / dot(other, other).max(f64::MIN_POSITIVE);
    series.iter().zip(other).map(|(s, o)| s - share * o).collect()
}

/// Whole cycles of a motion about zero.
fn cycles(x: &[f64]) -> usize {
    let aside = ASIDE * x.iter().fold(0.0_f64, |far, x| far.max(x.abs()));
    let sides = x.iter().filter(|x| x.abs() > aside).map(|x| *x > 0.0).collect::<Vec<_>>();
    sides.windows(2).filter(|pair| pair[0] != pair[1]).count() / 2
}
