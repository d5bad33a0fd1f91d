//! Autoregressions of the recordings of a campaign.

use rayon::prelude::*;

use super::autoregression::{Choice, FLOOR, Products};
use super::gaps::{Gaps, LeftOut};
use super::hum::without_hum;
use crate::kernel::filter::{dot, prediction_error};

/// Rates that differ by less than this share are one.
const SAME_RATE: f64 = 0.01;
/// A residual of more than this many times the rms of any other may be no noise.
const LOUDER: f64 = 3.0;
/// Nor is it where the autoregression of the others leaves more than this many times the variance of its own.
const UNLIKE: f64 = 4.0;

/// The autoregression of a recording.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Filter {
    pub(super) coefficients: Vec<f64>,
    /// Inverse of the standard deviation of what cannot be predicted, 1/N.
    pub(super) scale: f64,
    /// Coefficients for each sample that they were estimated from.
    pub(super) density: f64,
}

/// Those of residuals in N, with the gaps in their recordings; as of [`super::noise::Noise::of`].
pub(super) fn filters(
    residuals: &[Vec<f64>],
    steps: &[f64],
    freedom: usize,
    left_out: &[LeftOut],
) -> (Vec<Filter>, Vec<Gaps>) {
    let bare: Vec<Products> = residuals
        .par_iter()
        .zip(steps)
        .map(|(e, step)| Products::of(&without_hum(e, *step), *step))
        .collect();
    let products: Vec<Products> = bare.iter().map(Products::with_a_floor).collect();
    let total: usize = residuals.iter().map(Vec::len).sum();
    let mut filters: Vec<Option<Filter>> = vec![None; residuals.len()];
    let mut gaps = vec![Gaps::none(); residuals.len()];
    let of_rate =
        |r: usize| (0..residuals.len()).filter(move |s| (steps[*s] / steps[r] - 1.0).abs() < SAME_RATE);
    let odd = (0..residuals.len()).find_map(|r| beside_the_odd(&bare, &of_rate(r).collect::<Vec<_>>()));
    if let Some((r, others)) = odd {
        let share = freedom as f64 * residuals[r].len() as f64 / total as f64;
        let (filter, gap) = Filter::of(&residuals[r], steps[r], &others, share, &left_out[r]);
        (filters[r], gaps[r]) = (Some(filter), gap);
    }
    for r in 0..residuals.len() {
        if filters[r].is_some() {
            continue;
        }
        let longest = products[r].order();
        let alike: Vec<usize> =
            of_rate(r).filter(|s| filters[*s].is_none() && products[*s].order() == longest).collect();
        let own: Vec<Choice> = alike.iter().map(|s| Choice::of(&products[*s])).collect();
        let together = Choice::best(&alike.iter().map(|s| &products[*s]).collect::<Vec<_>>(), longest);
        let of_alike: usize = alike.iter().map(|s| residuals[*s].len()).sum();
        let shared = together.criterion <= own.iter().map(|c| c.criterion).sum();
        for (k, s) in alike.iter().enumerate() {
            let choice = if shared { &together } else { &own[k] };
            let share = freedom as f64 * residuals[*s].len() as f64 / total as f64;
            let (members, from) = if shared { (alike.len(), of_alike) } else { (1, residuals[*s].len()) };
            let order = choice.coefficients.len() as f64;
            let used = share + order / members as f64;
            let (filter, gap) = Filter::of(&residuals[*s], steps[*s], choice, used, &left_out[*s]);
            let filter = Filter { density: order / from as f64, ..filter };
            (filters[*s], gaps[*s]) = (Some(filter), gap);
        }
    }
    (filters.into_iter().flatten().collect(), gaps)
}

/// The one of these recordings that is far louder and like none of the others, and the noise of those: what it has alone
/// is no noise, although an autoregression of its own would predict it.
fn beside_the_odd(products: &[Products], recordings: &[usize]) -> Option<(usize, Choice)> {
    let size = |r: usize| products[r].variance(&[]);
    let odd = recordings.iter().copied().max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
    let others: Vec<usize> = recordings.iter().copied().filter(|r| *r != odd).collect();
    if others.len() < 2 || others.iter().any(|r| size(odd) < LOUDER.powi(2) * size(*r)) {
        return None;
    }
    let longest = recordings.iter().map(|r| products[*r].order()).min()?;
    let common = Choice::best(&others.iter().map(|r| &products[*r]).collect::<Vec<_>>(), longest);
    let unlike = |r: usize| {
        let own = Choice::best(&[&products[r]], longest);
        products[r].variance(&common.coefficients) > UNLIKE * products[r].variance(&own.coefficients)
    };
    (unlike(odd) && !others.into_iter().any(unlike)).then_some((odd, common))
}

impl Filter {
    fn of(residual: &[f64], step: f64, choice: &Choice, used: f64, left_out: &LeftOut) -> (Self, Gaps) {
        let coefficients = choice.coefficients.clone();
        let calm = without_hum(residual, step);
        let square = dot(&calm, &calm) / calm.len() as f64;
        let mut errors = prediction_error(&calm, &coefficients, 1.0);
        let gaps = left_out.gaps_of_the_scored(&coefficients, 1.0);
        gaps.leave_out(&mut errors);
        let left = (errors.len() as f64 - used - gaps.count() as f64).max(0.5 * errors.len() as f64);
        let taps = 1.0 + dot(&coefficients, &coefficients);
        let variance = dot(&errors, &errors) / left + FLOOR * square * taps;
        // A residual of zeros is no noise: keep the numbers finite.
        let variance = variance.max(f64::MIN_POSITIVE);
        let scale = 1.0 / variance.sqrt();
        let whole = left_out.gaps(&coefficients, scale);
        (Self { coefficients, scale, density: 0.0 }, whole)
    }
}
