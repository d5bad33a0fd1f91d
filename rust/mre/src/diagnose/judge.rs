//! Judgement of a model that was found: what is left beside it, and whether its names are to be trusted.

use super::agreed::{Agreed, agreed};
use super::begin::Begun;
use super::candidates::Candidate;
use super::exchange::CLEAR;
use super::joint::fit;
use super::least_squares::{Data, Fitted, refine};
use super::missing::{Generic, Mismatch};
use super::monitor::Monitor;
use super::needless::beside_a_hum;
use super::normal::Rows;
use super::null::Null;
use super::point::forces;
use super::resolution::nothing_left;
use super::search::{Named, rms};
use super::strained::any_strained;
use super::uneven::Uneven;
use super::unnamed::{self, Unnamed};
use super::verdict::{Against, BEYOND_CHANCE, Evidence, Tests, Verdict};
use crate::assembly::Assembly;

/// A model with what speaks for and against it.
pub(super) struct Judged<'a> {
    /// The model.
    pub(super) named: Named<'a>,
    /// The base alone, fitted under the same noise.
    pub(super) base: Fitted,
    /// Tests of what is left.
    pub(super) evidence: Evidence,
    /// What they say.
    pub(super) verdict: Verdict,
}

/// Judge a model; where names of several effects are not to be trusted, that of the first alone.
pub(super) fn judge<'a>(
    begun: &Begun<'a>,
    (named, first): (Named<'a>, Option<Named<'a>>),
    rows: &[Rows],
    false_alarm: f64,
    monitor: &dyn Monitor,
) -> Judged<'a> {
    let judged = alone(begun, named, rows, false_alarm, monitor);
    if judged.verdict != Verdict::Unexplained {
        return judged;
    }
    // Where names are not to be trusted, that of a hum still is.
    let simpler = first.into_iter().chain(hum_alone(begun, &judged.named, rows, monitor));
    let mut tried = simpler.map(|simpler| alone(begun, simpler, rows, false_alarm, monitor));
    tried.find(|simpler| simpler.verdict != Verdict::Unexplained).unwrap_or(judged)
}

/// The base with the hum that is named beside other effects.
fn hum_alone<'a>(
    begun: &Begun<'a>,
    named: &Named<'a>,
    rows: &[Rows],
    monitor: &dyn Monitor,
) -> Option<Named<'a>> {
    let data = Data { noise: &named.noise, rows, monitor };
    let Candidate { assembly, fitted } = beside_the_hum(begun, named, data)?;
    let own = named.added(begun).iter().zip(&named.p_values).filter(|(e, _)| !e.follows_the_motion());
    let p_values = own.map(|(_, p)| *p).collect();
    Some(Named { assembly, fitted, next: Some(named.itself()), p_values, ..named.clone() })
}

fn alone<'a>(
    begun: &Begun<'a>,
    mut named: Named<'a>,
    rows: &[Rows],
    false_alarm: f64,
    monitor: &dyn Monitor,
) -> Judged<'a> {
    settle_reference(&mut named, rows, monitor);
    let data = Data { noise: &named.noise, rows, monitor };
    let base = refine(&begun.assembly, data, &begun.fitted.unit);
    let beside = |assembly: &Assembly<'a>, fitted: &Fitted| Null::new(assembly, data, &fitted.unit);
    let (alone, last) = (beside(&begun.assembly, &base), beside(&named.assembly, &named.fitted));
    let hummed = beside_the_hum(begun, &named, data);
    let mismatch =
        |null: Option<&Null>| null.map(Null::generic).as_ref().map_or(Mismatch::NONE, Generic::mismatch);
    let nothing = |assembly: &Assembly<'a>, fitted: &Fitted| nothing_left(assembly, data, fitted);
    let nothing_at_first = nothing(&begun.assembly, &base);
    let nothing_left = nothing(&named.assembly, &named.fitted);
    let first = if nothing_at_first { Mismatch::NONE } else { mismatch(alone.as_ref()) };
    let rest = mismatch(last.as_ref());
    let smooth = |null: Option<&Null>| null.map_or(Unnamed::NONE, |null| unnamed::best(null, base.rows));
    let all = hummed.as_ref().map(|c| beside(&c.assembly, &c.fitted));
    let of_all = smooth(all.as_ref().unwrap_or(&alone).as_ref());
    let of_rest = smooth(last.as_ref());
    let before = hummed.as_ref().map_or(&base, |c| &c.fitted);
    let explained = (before.left - named.fitted.left).max(0.0);
    let change = rms_change(&named, data);
    let hum = hummed.as_ref().map_or(0, |c| c.assembly.effects().len() - begun.assembly.effects().len());
    let effects = named.assembly.effects().len() - begun.assembly.effects().len() - hum;
    let parameters = named.fitted.parameters() - before.parameters();
    let improvement = explained - parameters as f64 * base.price();
    // A drift has parameters in every recording, and even smooth forces have a slow part: it has to leave something.
    let drifts = named.assembly.effects().iter().any(|e| e.slow().is_some() && e.of_the_measurement());
    let leaves_nothing = rest.cautious() > BEYOND_CHANCE;
    let surpassed = effects > 0 && !(drifts && leaves_nothing) && of_all.improvement > improvement + CLEAR;
    let wandering = last.as_ref().map_or(Mismatch::NONE, Null::wandering);
    let odd = last.as_ref().map_or(Mismatch::NONE, Null::odd_recording);
    let uneven = last.as_ref().and_then(Null::uneven).unwrap_or(Uneven::NONE);
    let oscillating = last.as_ref().and_then(Null::oscillating).map_or(Mismatch::NONE, |o| o.mismatch);
    let linked = last.as_ref().map_or(1.0, Null::linked);
    let own = begun.assembly.effects().len()..named.assembly.effects().len();
    let agreed = last.as_ref().map_or(Agreed::NONE, |null| agreed(null, &named, data, own.start));
    let in_step = last.as_ref().map_or(Mismatch::NONE, Null::in_step);
    let against = match any_strained(&named, data, own) {
        _ if surpassed => Against::Surpassed,
        true => Against::AtTheEnd,
        false => Against::Nothing,
    };
    let tests = Tests {
        first,
        rest,
        smooth: of_rest.p_value,
        wandering,
        odd,
        oscillating,
        agreed,
        in_step,
        uneven,
        linked,
        explained,
        change,
        noise: named.noise_rms(data),
        against,
        nothing_left,
    };
    let evidence = Evidence::new(&tests, &named, begun.noise.hidden(), false_alarm);
    let verdict = evidence.verdict(effects, hum > 0);
    Judged { named, base, evidence, verdict }
}

/// The base with the hum that is named: other effects are judged by what they explain beside it.
fn beside_the_hum<'a>(begun: &Begun<'a>, named: &Named<'a>, data: Data) -> Option<Candidate<'a>> {
    let hums = named.added(begun).iter().any(|e| !e.follows_the_motion());
    hums.then(|| beside_a_hum(named, data, begun.assembly.effects().len()))
}

/// Effects refer to the force of the base as it is in the joint model, as a simulation will have it.
pub(super) fn settle_reference(named: &mut Named, rows: &[Rows], monitor: &dyn Monitor) {
    if named.assembly.effects().is_empty() {
        return;
    }
    for _ in 0..3 {
        let data = Data { noise: &named.noise, rows, monitor };
        let force = named.assembly.base_force(&named.fitted.unit, &named.fitted.coefficients);
        let shapes = named.assembly.physical(&named.fitted.unit);
        named.assembly = named.assembly.referring_to(force).fading(&shapes);
        let Candidate { assembly, fitted } = fit(named.assembly.clone(), data, &named.fitted.unit);
        (named.assembly, named.fitted) = (assembly, fitted);
    }
}

/// Rms in N of what the best further candidate would change in the force.
fn rms_change(named: &Named, data: Data) -> f64 {
    let Some(next) = &named.next else { return 0.0 };
    let a = forces(&named.assembly, data, &named.fitted);
    let b = forces(&next.assembly, data, &next.fitted);
    let change: Vec<Vec<f64>> =
        a.iter().zip(&b).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect()).collect();
    rms(&change)
}
