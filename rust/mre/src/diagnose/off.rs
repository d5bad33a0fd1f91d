//! Parameters that were kept and are off: where they explain more than effects do, none is named.

use super::alternatives::APART;
use super::begin::Begun;
use super::candidates::{Candidate, TIE};
use super::intervals::{Estimate, estimates};
use super::joint::fit;
use super::least_squares::Data;
use super::search::Named;
use super::verdict::Verdict;
use crate::effect::ParameterOff;

/// What is off of a base that was kept, in the stead of the effects that were named beside it, and what the verdict is then;
/// nothing is off where they explain more.
pub(super) fn parameters_off(
    begun: &Begun,
    named: &Named,
    data: Data,
    verdict: Verdict,
) -> (Vec<Estimate>, Verdict) {
    if !begun.assembly.base().groups().is_empty() || named.added(begun).is_empty() {
        return (Vec::new(), verdict);
    }
    let with = |off: &[ParameterOff]| {
        let mut effects = begun.assembly.effects().to_vec();
        effects.extend(off.iter().map(ParameterOff::as_effect));
        fit(begun.assembly.with(effects), data, &begun.fitted.unit)
    };
    let mut off = Vec::new();
    let mut best = with(&off);
    // One by one, as long as that is worth a parameter.
    loop {
        let others = ParameterOff::ALL.into_iter().filter(|one| !off.contains(one));
        let wider = others.map(|one| (one, with(&[off.as_slice(), &[one]].concat())));
        match wider.min_by(|(_, a), (_, b)| a.criterion().total_cmp(&b.criterion())) {
            Some((one, candidate)) if candidate.criterion() < best.criterion() => {
                off.push(one);
                best = candidate;
            }
            _ => break,
        }
    }
    let Candidate { assembly, fitted } = best;
    let more = fitted.criterion() - named.fitted.criterion();
    let verdict = match verdict {
        // A zero alone is that of the load cell.
        _ if more > APART || off.iter().all(|one| *one == ParameterOff::Zero) => {
            return (Vec::new(), verdict);
        }
        _ if more < -TIE => Verdict::Unexplained,
        Verdict::MissingPhysics | Verdict::PartlyExplained => Verdict::PartlyExplained,
        told => return (Vec::new(), told),
    };
    let mut found = estimates(&assembly, data, &fitted.unit).coefficients;
    (found.split_off(found.len() - off.len()), verdict)
}
