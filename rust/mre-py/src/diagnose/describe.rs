//! A diagnosis as JSON.

use mre::assembly::{Assembly, Base};
use mre::device::Level;
use mre::diagnose::{
    self, Blank, Diagnosis, Estimate, Estimates, NextTest, On, Place, Proof, Prospect, Unknown, strained,
};
use serde_json::{Value, json};

/// What came after a diagnosis.
pub(super) struct After {
    /// Of blank campaigns, where some were wanted.
    pub(super) blanks: Option<Blank>,
    /// True where it was broken off before the end.
    pub(super) broken_off: bool,
}

/// `own` effects belong to the base.
pub(super) fn describe(found: &Diagnosis, base: &Base, own: usize, after: &After) -> Value {
    let judgement = found.judgement.as_ref();
    let evidence = judgement.map(|j| j.evidence);
    let proofs = found.proofs.as_ref();
    let begun = &found.base.assembly;
    let of_base = |assembly: &Assembly, estimates: &Estimates| -> Vec<Value> {
        (0..own).map(|place| law(assembly, estimates, place)).collect()
    };
    json!({
        "verdict": judgement.map(|j| j.verdict.id()),
        "effects": found.effects.iter().map(|e| effect(found, e)).collect::<Vec<_>>(),
        "where": found.places.iter().map(|f| place(&f.place, f.strength)).collect::<Vec<_>>(),
        "base_levels": levels(base, &found.base_estimates),
        "final_levels": levels(base, &found.estimates),
        "base_effects": of_base(begun, &found.base_estimates),
        "final_base_effects": of_base(&found.named.assembly, &found.estimates),
        "before": proofs.map(|p| proof(&p.0)),
        "after": proofs.map(|p| proof(&p.1)),
        "noise_rms": judgement.map(|j| j.noise_rms),
        "p_base": evidence.map(|e| e.p_base),
        "p_rest": evidence.map(|e| e.p_rest),
        "p_even": evidence.map(|e| e.p_even),
        "rest_share": evidence.map(|e| e.share),
        "lack_of_fit_N": evidence.map(|e| e.lack_of_fit),
        "approximate": evidence.is_some_and(|e| e.approximate()),
        "candidates": diagnose::beside(&found.named.scores),
        "absorbed": found.absorbed.iter().map(absorbed).collect::<Vec<_>>(),
        "unknown": found.unknown.as_ref().map(unknown),
        "nearest": found.nearest,
        "off": found.off.iter().map(estimate).collect::<Vec<_>>(),
        "next_test": found.next_test.as_ref().map(next_test),
        "left_out": left_out(begun),
        "sizes": sizes(found),
        "blank": after.blanks.as_ref().filter(|b| b.count > 0).map(blank),
        "refitted": found.refitted.map(|r| json!({"rms_as_given": r.as_given, "rms_fitted": r.fitted, "as_well": r.as_well})),
        "interrupted": after.broken_off,
    })
}

/// Samples that count and told nothing, by recording.
fn left_out(assembly: &Assembly) -> Vec<usize> {
    let campaign = assembly.campaign();
    campaign
        .left_out()
        .zip(campaign.recordings())
        .map(|(ranges, recording)| {
            let scored = recording.scored();
            ranges.iter().map(|r| (r.start.max(scored.start)..r.end.min(scored.end)).len()).sum()
        })
        .collect()
}

fn blank(b: &Blank) -> Value {
    let by_effect: serde_json::Map<String, Value> =
        b.by_effect.iter().map(|(id, times)| ((*id).to_owned(), json!(times))).collect();
    json!({"count": b.count, "named": b.named, "unexplained": b.unexplained, "by_effect": by_effect})
}

/// What an unexplained mismatch depends on, and its map.
fn unknown(u: &Unknown) -> Value {
    let depends_on: Vec<Value> = u
        .depends_on
        .iter()
        .map(|d| {
            let (on, size) = match d.on {
                On::Displacement => ("displacement", None),
                On::Velocity => ("velocity", None),
                On::State => ("state", None),
                On::Force => ("force", None),
                On::Acceleration => ("acceleration", None),
                On::Memory(seconds) => ("memory", Some(seconds)),
                On::Reversal(share) => ("reversal", Some(share)),
                On::Amplitude => ("amplitude", None),
                On::Largest => ("largest_displacement", None),
                On::Path => ("path", None),
                On::Heat => ("dissipated_power", None),
                On::Time => ("time", None),
                On::Oscillation(frequency) => ("oscillation", Some(frequency)),
                On::Moments => ("moments", None),
                On::Current => ("current", None),
                On::Recording => ("recording", None),
            };
            json!({"on": on, "size": size, "share": d.share})
        })
        .collect();
    json!({
        "depends_on": depends_on, "odd": u.odd, "dissipative": u.dissipative, "rms_N": u.rms,
        "p_even": u.p_even,
        "map": {"x_mm": u.map.displacement, "v_mm_s": u.map.velocity, "force_N": u.map.force},
    })
}

fn next_test(found: &NextTest) -> Value {
    let prospect = |p: &Prospect| {
        let chances: serde_json::Map<String, Value> =
            p.chances.iter().map(|(id, chance)| ((*id).to_owned(), json!(chance))).collect();
        let leaves: serde_json::Map<String, Value> =
            p.leaves.iter().map(|(id, left)| ((*id).to_owned(), json!(left))).collect();
        json!({
            "excitation": p.kind.id(), "frequency_hz": p.frequency, "amplitude_mm": p.amplitude,
            "duration_s": p.duration, "chances": chances, "leaves": leaves, "certainty": p.certainty,
        })
    };
    let l = &found.limits;
    json!({
        "prospects": found.prospects.iter().map(prospect).collect::<Vec<_>>(),
        "limits": {
            "stroke_mm": l.stroke, "speed_mm_s": l.speed, "highest_hz": l.highest, "duration_s": l.duration,
            "rate_hz": l.rate, "current_A": l.current,
        },
    })
}

fn absorbed(a: &diagnose::Absorbed) -> Value {
    let (parameter, up_to, unit) = &a.up_to;
    let with = |(name, value, unit): &diagnose::Quantity| json!({"name": name, "value": value, "unit": unit});
    json!({
        "id": a.effect, "law": a.law, "limit": a.limit, "parameter": parameter, "unit": unit, "up_to": up_to,
        "with": a.with.iter().map(with).collect::<Vec<_>>(),
        "whatever_its_size": a.whatever_its_size,
    })
}

fn proof(proof: &Proof) -> Value {
    json!({
        "train_rms": proof.train_rms,
        "held_out_rms": proof.held_out_rms,
        "by_recording": proof.by_recording,
    })
}

fn estimate(e: &Estimate) -> Value {
    let finite = |v: f64| if v.is_finite() { json!(v) } else { Value::Null };
    json!({"name": e.name, "unit": e.unit, "value": e.value, "low": finite(e.low), "high": finite(e.high)})
}

fn effect(found: &Diagnosis, named: &diagnose::Effect) -> Value {
    let mut row = law(&found.named.assembly, &found.estimates, named.place);
    row["p_value"] = json!(named.p_value);
    row["indistinguishable_from"] = json!(named.rivals);
    row["at_the_end"] = json!(strained(&found.named.assembly, &found.estimates, named.place));
    row["held_out_rms_before"] = json!(named.held_out.map(|h| h.before));
    row["held_out_rms_after"] = json!(named.held_out.map(|h| h.after));
    row
}

/// One of the effects of an assembly, with its parameters. Coefficients of the measurement come recording by
/// recording.
fn law(assembly: &Assembly, estimates: &Estimates, place: usize) -> Value {
    let (coefficients, shapes) = assembly.of_effect(place);
    let this = &assembly.effects()[place];
    let about = this.about();
    let rows = |all: &[Estimate]| all.iter().map(estimate).collect::<Vec<_>>();
    json!({
        "place": place, "id": about.effect, "law": about.law, "plain": about.plain, "equation": about.equation,
        "reference": about.reference, "limit": about.limit, "of_the_measurement": this.of_the_measurement(),
        "coefficients": rows(&estimates.coefficients[coefficients]),
        "shapes": rows(&estimates.shapes[shapes]),
    })
}

fn place(place: &Place, strength: f64) -> Value {
    match place {
        Place::Time { recording, from, to } => json!({
            "kind": "time", "recording": recording, "from": from, "to": to, "strength": strength,
        }),
        Place::State { x, v } => json!({"kind": "state", "x_mm": x, "v_mm_s": v, "strength": strength}),
        Place::Harmonic { recording, harmonic, drive, in_phase } => json!({
            "kind": "harmonic", "recording": recording, "harmonic": harmonic, "drive_hz": drive,
            "in_phase": in_phase, "strength": strength,
        }),
        Place::Recording { recording, damping } => json!({
            "kind": "recording", "recording": recording, "damping": damping, "strength": strength,
        }),
    }
}

/// Parameters of the model for every group, in the model's order, with their intervals and which of them the recordings
/// press beyond a limit where a group has one level.
fn levels(base: &Base, estimates: &Estimates) -> Vec<Value> {
    let (mut coefficients, mut shapes) = (estimates.coefficients.iter(), estimates.shapes.iter());
    base.groups()
        .iter()
        .map(|group| {
            let mut own: Vec<Option<&Estimate>> = vec![None; group.problem.parameters().len()];
            for (place, estimate) in group.coefficients.iter().zip(coefficients.by_ref()) {
                own[*place] = Some(estimate);
            }
            for (place, estimate) in group.shapes.iter().zip(shapes.by_ref()) {
                own[*place] = Some(estimate);
            }
            let values: Vec<f64> = own.iter().map(|e| e.map_or(0.0, |e| e.value)).collect();
            let levels = group.problem.law().levels(&values, None);
            let ends = |e: &Estimate| (e.low.is_finite() && e.high.is_finite()).then_some([e.low, e.high]);
            let intervals: Vec<Option<[f64; 2]>> = match levels.len() {
                1 => own.iter().map(|e| e.and_then(ends)).collect(),
                _ => vec![None; levels[0].values.len()],
            };
            let symbols = group.problem.parameters().iter().zip(&own);
            let pressed = symbols.filter(|(_, e)| levels.len() == 1 && e.is_some_and(|e| e.pressed));
            let pressed: Vec<&str> = pressed.map(|(p, _)| p.name.as_str()).collect();
            let level = |l: &Level| {
                json!({"current": l.current, "values": l.values, "intervals": intervals, "pressed": pressed})
            };
            json!({"members": group.members, "levels": levels.iter().map(level).collect::<Vec<_>>()})
        })
        .collect()
}

fn sizes(found: &Diagnosis) -> Value {
    let s = found.named.assembly.campaign().sizes();
    json!({
        "displacement": s.displacement, "noise": s.noise, "velocity": s.velocity, "force": s.force, "step": s.step,
        "duration": s.duration, "total": s.total, "path": s.path, "energy": s.energy,
        "dissipated": s.dissipated, "life": s.life,
        "current": s.current, "current_varies": s.current_varies, "current_steps": s.current_steps,
        "temperature": s.temperature, "quantum": s.quantum,
    })
}
