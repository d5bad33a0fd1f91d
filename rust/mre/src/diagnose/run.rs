//! The whole diagnosis.

use super::absorbed::{Absorbed, absorbed};
use super::alternatives::rivals;
use super::begin::{Given, begin};
use super::candidates::{by_effect, residuals};
use super::intervals::{Estimates, estimates};
use super::judge::{Judged, judge};
use super::least_squares::{Data, forces};
use super::locate::{Finding, locate};
use super::next_test::{Doubt, NextTest, propose};
use super::normal::Rows;
use super::prove::{Proof, prove, splits};
use super::screen::{Null, Score};
use super::search::{Named, Search, rms};
use super::settings::Settings;
use super::unknown::{self, Unknown};
use super::verdict::{Evidence, Verdict};
use crate::assembly::{Base, Campaign};
use crate::recording::Recording;

/// An effect that was named.
#[derive(Debug, Clone)]
pub struct Effect {
    /// Its place in the model.
    pub place: usize,
    /// p-value with which it entered.
    pub p_value: f64,
    /// Held-out rms without it, the other effects in place, N.
    pub held_out_before: f64,
    /// Held-out rms with it, N.
    pub held_out_after: f64,
    /// Ids of effects that the recordings cannot tell from it.
    pub rivals: Vec<&'static str>,
}

/// What a diagnosis found.
pub struct Diagnosis<'a> {
    /// The base as fitted alone.
    pub base: Named<'a>,
    /// The base with the effects named, fitted together on everything.
    pub named: Named<'a>,
    /// Verdict.
    pub verdict: Verdict,
    /// What is left beside the final model.
    pub evidence: Evidence,
    /// The effects, by how much each improves the held-out fit.
    pub effects: Vec<Effect>,
    /// What an unexplained mismatch depends on.
    pub unknown: Option<Unknown>,
    /// Ids of effects that came nearest to an unexplained mismatch, and are not trusted.
    pub nearest: Vec<&'static str>,
    /// The excitation that would best resolve what is in doubt.
    pub next_test: Option<NextTest>,
    /// Effects that the recordings would hide.
    pub absorbed: Vec<Absorbed>,
    /// Where the base model misses.
    pub places: Vec<Finding>,
    /// Parameters of the base alone.
    pub base_estimates: Estimates,
    /// Parameters of the final model.
    pub estimates: Estimates,
    /// The base alone on training and held-out samples.
    pub before: Proof,
    /// The final model on the same.
    pub after: Proof,
    /// Rms of the noise, N.
    pub noise_rms: f64,
    /// Force of the base model in N, by recording.
    pub base_force: Vec<Vec<f64>>,
    /// Force of the final model.
    pub final_force: Vec<Vec<f64>>,
}

/// Diagnose recordings with a base model.
///
/// `given` are effects that belong to the base.
pub fn run<'a>(
    campaign: &'a Campaign,
    base: &'a Base,
    given: &[Given],
    settings: &Settings,
) -> Diagnosis<'a> {
    let rows: Vec<Rows> = campaign.recordings().iter().map(|r| vec![r.scored()]).collect();
    let begun = begin(campaign, base, given, &rows);
    let own = begun.assembly.effects().len();
    let recordings: Vec<&Recording> = campaign.recordings().iter().map(AsRef::as_ref).collect();
    let groups: Vec<Vec<usize>> = match base {
        Base::Fitted(groups) => groups.iter().map(|g| g.members.clone()).collect(),
        Base::Held(_) | Base::Given(_) => vec![(0..recordings.len()).collect()],
    };
    let whole = splits(&recordings, &groups, false);
    let search = Search { begun: &begun, rows: &rows, splits: &whole, settings };
    let judged = judge(&begun, search.run(), &rows, settings.false_alarm);
    let Judged { mut named, base: base_fit, evidence, verdict } = judged;
    let noise = named.noise.clone();
    let data = Data { noise: &noise, rows: &rows };
    let alone = Null::new(&begun.assembly, data, &base_fit.unit);
    let places = alone.as_ref().map_or_else(Vec::new, |n| locate(n, settings.false_alarm));
    let unknown = match verdict {
        Verdict::Unexplained => alone.as_ref().map(unknown::describe),
        Verdict::PartlyExplained => {
            Null::new(&named.assembly, data, &named.fitted.unit).as_ref().map(unknown::describe)
        }
        Verdict::Adequate | Verdict::MissingPhysics => None,
    };
    let absorbed = absorbed(&named, campaign, settings.false_alarm);
    let noise_rms = rms(&match &named.next {
        Some(next) => residuals(&next.assembly, data, &next.fitted),
        None => residuals(&named.assembly, data, &named.fitted),
    });
    let mut nearest = Vec::new();
    if verdict == Verdict::Unexplained {
        // Names that leave so much are not to be trusted: the base stands alone, and they are only told.
        nearest = named.assembly.effects()[own..].iter().map(|e| e.about().effect).collect();
        named.assembly = begun.assembly.clone();
        named.fitted = base_fit.clone();
        named.p_values = Vec::new();
    }
    let sharp = named.assembly.effects().iter().any(|e| e.in_one_recording());
    let judged = if sharp { splits(&recordings, &groups, true) } else { whole.clone() };
    let before = prove(&begun.assembly, &named.noise, &judged, &base_fit);
    let after = prove(&named.assembly, &named.noise, &judged, &named.fitted);
    let mut doubt = Doubt { rivals: Vec::new(), hidden: absorbed.iter().map(|a| a.effect).collect() };
    let mut effects: Vec<Effect> = (own..named.assembly.effects().len())
        .map(|place| {
            let without = search.drop(&named, place);
            let proof = prove(&without.assembly, &named.noise, &judged, &without.fitted);
            let rivals = rivals(&search, &named, place, data);
            let ids = rivals.iter().map(|(id, _)| *id).collect();
            doubt.rivals.extend(rivals);
            Effect {
                place,
                p_value: named.p_values.get(place - own).copied().unwrap_or(0.0),
                held_out_before: proof.held_out_rms,
                held_out_after: after.held_out_rms,
                rivals: ids,
            }
        })
        .collect();
    effects.sort_by(|a, b| b.held_out_before.total_cmp(&a.held_out_before));
    let next_test = propose(&named, base, &doubt, &rows, settings);
    Diagnosis {
        verdict,
        evidence,
        effects,
        absorbed,
        places,
        base_estimates: estimates(&begun.assembly, data, &base_fit.unit),
        estimates: estimates(&named.assembly, data, &named.fitted.unit),
        before,
        after,
        noise_rms,
        unknown,
        nearest,
        next_test,
        base_force: forces(&begun.assembly, data, &base_fit),
        final_force: forces(&named.assembly, data, &named.fitted),
        base: Named {
            assembly: begun.assembly.clone(),
            fitted: base_fit,
            noise: named.noise.clone(),
            scores: Vec::new(),
            next: None,
            later: Vec::new(),
            p_values: Vec::new(),
        },
        named,
    }
}

/// p-value of every effect beside the final model.
pub fn beside(scores: &[Score]) -> Vec<(&'static str, f64)> {
    by_effect(scores)
}
