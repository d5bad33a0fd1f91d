//! The whole diagnosis.

use super::absorbed::{Absorbed, absorbed};
use super::alternatives::rivals;
use super::begin::{Begun, Given, begin};
use super::candidates::{Candidate, by_effect, fit, residuals};
use super::intervals::{Estimates, estimates};
use super::least_squares::{Data, Fitted, Point, refine};
use super::locate::{Finding, locate};
use super::missing::{Generic, Mismatch};
use super::normal::Rows;
use super::prove::{Proof, prove, splits};
use super::screen::{Null, Score};
use super::search::{Named, Search, rms};
use super::settings::Settings;
use super::unknown::{self, Unknown};
use super::verdict::{Evidence, Verdict};
use crate::assembly::{Assembly, Base, Campaign};
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
    let mut named = search.run();
    settle_reference(&mut named, &rows);
    let data = Data { noise: &named.noise, rows: &rows };
    let base_fit = refine(&begun.assembly, data, &begun.fitted.unit);
    let alone = null(&begun, data, &base_fit);
    let places = alone.as_ref().map_or_else(Vec::new, |n| locate(n, settings.false_alarm));
    let alone_generic = alone.as_ref().map(Null::generic);
    let first = alone_generic.as_ref().map_or(Mismatch::NONE, Generic::mismatch);
    let beside = Null::new(&named.assembly, data, &named.fitted.unit);
    let beside_generic = beside.as_ref().map(Null::generic);
    let rest = beside_generic.as_ref().map_or(Mismatch::NONE, Generic::mismatch);
    let absorbed = absorbed(&named, campaign, settings.false_alarm);
    let explained = (base_fit.left - named.fitted.left).max(0.0);
    let change = rms_change(&named, data);
    let evidence = Evidence::new(first, rest, explained, &named, change, settings.false_alarm);
    let verdict = evidence.verdict(named.assembly.effects().len() - own);
    let unexplained = match verdict {
        Verdict::Unexplained => alone.as_ref().zip(alone_generic.as_ref()),
        Verdict::PartlyExplained => beside.as_ref().zip(beside_generic.as_ref()),
        Verdict::Adequate | Verdict::MissingPhysics => None,
    };
    let unknown = unexplained.map(|(null, generic)| unknown::describe(null, generic));
    let noise_rms = rms(&match &named.next {
        Some(next) => residuals(&next.assembly, data, &next.fitted),
        None => residuals(&named.assembly, data, &named.fitted),
    });
    let mut nearest = Vec::new();
    let noise = named.noise.clone();
    let data = Data { noise: &noise, rows: &rows };
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
    let mut effects: Vec<Effect> = (own..named.assembly.effects().len())
        .map(|place| {
            let without = search.drop(&named, place);
            let proof = prove(&without.assembly, &named.noise, &judged, &without.fitted);
            Effect {
                place,
                p_value: named.p_values.get(place - own).copied().unwrap_or(0.0),
                held_out_before: proof.held_out_rms,
                held_out_after: after.held_out_rms,
                rivals: rivals(&search, &named, place, data),
            }
        })
        .collect();
    effects.sort_by(|a, b| b.held_out_before.total_cmp(&a.held_out_before));
    let force = |assembly: &Assembly, fitted: &Fitted| -> Vec<Vec<f64>> {
        let point = Point::at(assembly, data, fitted.unit.clone());
        point.recordings.into_iter().map(|local| local.force).collect()
    };
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
        base_force: force(&begun.assembly, &base_fit),
        final_force: force(&named.assembly, &named.fitted),
        base: Named {
            assembly: begun.assembly.clone(),
            fitted: base_fit,
            noise: named.noise.clone(),
            scores: Vec::new(),
            next: None,
            p_values: Vec::new(),
        },
        named,
    }
}

fn null<'b>(begun: &'b Begun<'b>, data: Data<'b>, fitted: &Fitted) -> Option<Null<'b>> {
    Null::new(&begun.assembly, data, &fitted.unit)
}

/// Effects refer to the force of the base as it is in the joint model, as a simulation will have it.
fn settle_reference(named: &mut Named, rows: &[Rows]) {
    if named.assembly.effects().is_empty() {
        return;
    }
    for _ in 0..3 {
        let data = Data { noise: &named.noise, rows };
        let force = named.assembly.base_force(&named.fitted.unit, &named.fitted.coefficients);
        named.assembly = named.assembly.referring_to(force);
        let Candidate { assembly, fitted } = fit(named.assembly.clone(), data, &named.fitted.unit);
        (named.assembly, named.fitted) = (assembly, fitted);
    }
}

/// Rms in N of what the best further candidate would change in the force.
fn rms_change(named: &Named, data: Data) -> f64 {
    let Some(next) = &named.next else { return 0.0 };
    let force = |assembly: &Assembly, fitted: &Fitted| {
        Point::at(assembly, data, fitted.unit.clone()).recordings.into_iter().map(|l| l.force).collect()
    };
    let (a, b): (Vec<Vec<f64>>, Vec<Vec<f64>>) =
        (force(&named.assembly, &named.fitted), force(&next.assembly, &next.fitted));
    let change: Vec<Vec<f64>> =
        a.iter().zip(&b).map(|(a, b)| a.iter().zip(b).map(|(a, b)| a - b).collect()).collect();
    rms(&change)
}

/// p-value of every effect beside the final model.
pub fn beside(scores: &[Score]) -> Vec<(&'static str, f64)> {
    by_effect(scores)
}
