//! The whole diagnosis.

use super::absorbed::Detection;
use super::alternatives::{Alternatives, rivals};
use super::begin::{Begun, Given, begin};
use super::candidates::by_effect;
use super::diagnosis::{Diagnosis, Effect, HeldOut, Judgement};
use super::intervals::estimates;
use super::judge::{Judged, judge, settle_reference};
use super::least_squares::{Data, Fitted};
use super::locate::locate;
use super::moments::with_moments;
use super::monitor::{Monitor, Stage};
use super::next_test::{Doubt, propose};
use super::normal::Rows;
use super::null::Null;
use super::off::parameters_off;
use super::point::forces;
use super::prove::{Proof, prove};
use super::screen::Score;
use super::search::{Named, Search};
use super::settings::Settings;
use super::splits::{Split, Splits};
use super::starts::with_initial_states;
use super::unknown::{self, Unknown};
use super::verdict::Verdict;
use crate::assembly::{Base, Campaign};

/// Diagnose recordings with a base model.
///
/// `given` are effects that belong to the base. Where the monitor breaks off, what is known by then is
/// found; `None` where that is before the base is fitted.
pub fn run<'a>(
    campaign: &'a Campaign,
    base: &'a Base,
    given: &[Given],
    settings: &Settings,
    monitor: &dyn Monitor,
) -> Option<Diagnosis<'a>> {
    let rows: Vec<Rows> = campaign.recordings().iter().map(|r| vec![r.scored()]).collect();
    let begun = monitor.stage(Stage::Base, || begin(campaign, base, given, &rows, monitor))?;
    let splits = Splits::of(campaign, base);
    let search = Search { begun: &begun, rows: &rows, splits: &splits, settings, monitor };
    let found = search.run();
    let judged = monitor.stage(Stage::Verdict, || {
        let judged = judge(&begun, found.clone(), &rows, settings.false_alarm, monitor);
        let data = Data { noise: &judged.named.noise, rows: &rows, monitor };
        let instead = parameters_off(&begun, &judged.named, data, judged.verdict);
        (judged, instead)
    });
    let Some((Judged { mut named, base: base_fit, evidence, .. }, (off, verdict))) = judged else {
        let mut named = found.0;
        settle_reference(&mut named, &rows, monitor);
        let noise = named.noise.clone();
        let data = Data { noise: &noise, rows: &rows, monitor };
        return Some(models(&begun, begun.fitted.clone(), named, data));
    };
    let noise = named.noise.clone();
    let data = Data { noise: &noise, rows: &rows, monitor };
    let noise_rms = named.noise_rms(data);
    let alone = Null::new(&begun.assembly, data, &base_fit.unit);
    let places = monitor
        .stage(Stage::Location, || alone.as_ref().map_or_else(Vec::new, |n| locate(n, settings.false_alarm)));
    let absorbed = monitor.stage(Stage::Identifiability, || {
        Detection::beside(&named, settings.false_alarm).hidden(&named.scores, campaign)
    });
    let absorbed = absorbed.unwrap_or_default();
    let mut nearest = Vec::new();
    if verdict == Verdict::Unexplained {
        // Names that leave so much are not to be trusted: the base stands alone, and they are only told, unless what is off
        // surpasses them.
        if off.is_empty() {
            nearest = named.added(&begun).iter().map(|e| e.about().effect).collect();
        }
        named.assembly = begun.assembly.clone();
        named.fitted = base_fit.clone();
        named.p_values = Vec::new();
    }
    let places = places.unwrap_or_default();
    let sharper = monitor.whole(with_moments(places.clone(), &search, &named));
    let judged = splits.fit_for(&named.assembly);
    let proofs = monitor.stage(Stage::Proof, || {
        let proof = |of, fitted| prove(of, &named.noise, judged, fitted, monitor);
        (proof(&begun.assembly, &base_fit), proof(&named.assembly, &named.fitted))
    });
    let hidden = absorbed.iter().map(|a| a.effect).collect();
    let mut doubt = Doubt { rivals: Vec::new(), laws: Vec::new(), hidden, left: evidence.left };
    let after = proofs.as_ref().map(|p| &p.1);
    let effects = effects(&search, &named, judged, after, &mut doubt);
    let verdict = evidence.beside_rivals(verdict, effects.iter().any(|effect| !effect.rivals.is_empty()));
    let proved =
        |(before, after): &(Proof, Proof)| verdict.beside_proofs(before.held_out_rms, after.held_out_rms);
    let verdict = proofs.as_ref().map_or(verdict, proved);
    // Where effects leave no more, there is nothing to describe.
    let whole = verdict == Verdict::PartlyExplained && !evidence.approximate();
    let unknown = if whole { None } else { describe(verdict, alone.as_ref(), &named, data) };
    let next_test =
        monitor.stage(Stage::NextTest, || propose(&named, base, &doubt, &rows, settings, monitor));
    Some(Diagnosis {
        judgement: Some(Judgement { verdict, evidence, noise_rms }),
        effects,
        unknown,
        nearest,
        off,
        next_test: next_test.flatten(),
        absorbed,
        places: sharper.unwrap_or(places),
        proofs,
        ..models(&begun, base_fit, named, data)
    })
}

/// What a mismatch depends on that the verdict leaves unexplained.
fn describe(verdict: Verdict, alone: Option<&Null>, named: &Named, data: Data) -> Option<Unknown> {
    let beside = |null: Option<&Null>| data.monitor.stage(Stage::Unknown, || null.map(unknown::describe));
    match verdict {
        Verdict::Unexplained => beside(alone).flatten(),
        Verdict::PartlyExplained => {
            beside(Null::new(&named.assembly, data, &named.fitted.unit).as_ref()).flatten()
        }
        Verdict::Adequate | Verdict::MissingPhysics => None,
    }
}

/// The effects named, with what each does for held-out data and its rivals, which are in doubt then.
fn effects<'a>(
    search: &Search<'_, 'a>,
    named: &Named<'a>,
    splits: &[Split],
    after: Option<&Proof>,
    doubt: &mut Doubt<'a>,
) -> Vec<Effect> {
    let monitor = search.monitor;
    let mut found = entered(search.begun, named);
    for effect in &mut found {
        let Some(after) = after else { break };
        let told = monitor.stage(Stage::Alternatives, || {
            let without = search.drop(named, effect.place);
            let before = prove(&without.assembly, &named.noise, splits, &without.fitted, monitor);
            (before.held_out_rms, rivals(search, named, effect.place, doubt.left, search.data(&named.noise)))
        });
        let Some((before, Alternatives { effects, rivals, laws })) = told else { break };
        effect.held_out = Some(HeldOut { before, after: after.held_out_rms });
        effect.rivals = effects;
        doubt.rivals.extend(rivals);
        doubt.laws.extend(laws);
    }
    let before = |e: &Effect| e.held_out.map_or(0.0, |h| h.before);
    found.sort_by(|a, b| before(b).total_cmp(&before(a)));
    found
}

/// The effects named, as they entered.
fn entered(begun: &Begun, named: &Named) -> Vec<Effect> {
    let own = begun.assembly.effects().len();
    let effect = |place: usize| Effect {
        place,
        p_value: named.p_values.get(place - own).copied().unwrap_or(0.0),
        held_out: None,
        rivals: Vec::new(),
    };
    (own..named.assembly.effects().len()).map(effect).collect()
}

/// Models with their parameters and forces, and nothing else.
fn models<'a>(begun: &Begun<'a>, base: Fitted, named: Named<'a>, data: Data) -> Diagnosis<'a> {
    Diagnosis {
        judgement: None,
        effects: entered(begun, &named),
        unknown: None,
        nearest: Vec::new(),
        off: Vec::new(),
        refitted: None,
        next_test: None,
        absorbed: Vec::new(),
        places: Vec::new(),
        base_estimates: estimates(&begun.assembly, data, &base.unit),
        estimates: estimates(&named.assembly, data, &named.fitted.unit),
        proofs: None,
        base_force: with_initial_states(&begun.assembly, forces(&begun.assembly, data, &base)),
        final_force: with_initial_states(&named.assembly, forces(&named.assembly, data, &named.fitted)),
        base: Named::bare(begun.assembly.clone(), base, named.noise.clone()),
        named,
        broken_off: data.monitor.broken_off(),
    }
}

/// p-value of every effect beside the final model.
pub fn beside(scores: &[Score]) -> Vec<(&'static str, f64)> {
    by_effect(scores)
}
