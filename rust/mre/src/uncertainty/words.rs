//! What is not determined, in words.

use super::Estimate;
use super::derived::{Cycle, combinations};
use super::local::Local;

/// Larger amplitudes that are tried, as shares of the tested one.
const FACTORS: [f64; 3] = [2.0, 4.0, 8.0];
/// Relative standard error that counts as good.
const GOOD: f64 = 0.1;
/// A parameter is named where it makes this share of the weakest direction.
const NAMED: f64 = 0.05;

/// Sentences; none where every parameter is determined.
pub(super) fn words(
    local: &Local<'_>,
    parameters: &[Estimate],
    derived: &[Estimate],
    cycle: Cycle,
) -> Vec<String> {
    let bad: Vec<usize> = (0..parameters.len()).filter(|j| !parameters[*j].determined).collect();
    if bad.is_empty() {
        return Vec::new();
    }
    let names: Vec<&str> = bad.iter().map(|j| parameters[*j].name.as_str()).collect();
    let verb = if names.len() > 1 { "each are" } else { "is" };
    let known = determined_combinations(local, parameters, derived);
    let what = if known.is_empty() {
        format!("{} {verb} not determined", names.join(", "))
    } else {
        let count = if known.len() > 1 { "are" } else { "is" };
        format!("only {} {count} determined; {} {verb} not", known.join(" and "), names.join(", "))
    };
    let remedy = match cure(local, &bad, cycle) {
        Cure::At(amplitude) => {
            format!(": {} {:.2} mm test would fix {}", article(amplitude), Short(amplitude), them(&names))
        }
        Cure::Unknown => {
            format!(": these recordings do not tell which larger stroke would fix {}", them(&names))
        }
        Cure::None => String::new(),
    };
    let first = format!("at {:.2} mm {what}{remedy}", Short(cycle.amplitude));
    let mut out = vec![first];
    out.extend(weakest(local, parameters));
    out
}

fn them(names: &[&str]) -> &'static str {
    if names.len() > 1 { "them" } else { "it" }
}

/// "an 8 mm test", "a 4 mm test".
fn article(number: f64) -> &'static str {
    let text = format!("{:.2}", Short(number));
    let whole = text.split('.').next().unwrap_or_default();
    if text.starts_with('8') || whole == "11" || whole == "18" { "an" } else { "a" }
}

/// Determined combinations with a member that is not.
fn determined_combinations(local: &Local<'_>, parameters: &[Estimate], derived: &[Estimate]) -> Vec<String> {
    let plain = |name: &str| name.split(['(', ' ']).next().unwrap_or_default().to_owned();
    let involved = |members: &[&str]| {
        parameters.iter().any(|p| !p.determined && members.contains(&plain(&p.name).as_str()))
    };
    let formulas = combinations(local.problem.model().name());
    derived
        .iter()
        .filter(|d| d.determined)
        .filter(|d| formulas.iter().any(|c| d.name.starts_with(c.name) && involved(c.members)))
        .map(|d| d.name.clone())
        .collect()
}

/// What would determine what is not.
enum Cure {
    /// The same test at this amplitude, mm.
    At(f64),
    /// None of the amplitudes that were tried.
    None,
    /// Values on a bound say nothing about what a larger test would see.
    Unknown,
}

/// The smallest larger amplitude at which the same test would determine what this one does not.
fn cure(local: &Local<'_>, bad: &[usize], cycle: Cycle) -> Cure {
    let sides = local.problem.bounds().on_bound(local.values);
    if bad.iter().any(|j| sides[*j] != 0) {
        return Cure::Unknown;
    }
    let places: Option<Vec<usize>> = bad.iter().map(|j| local.free.iter().position(|i| i == j)).collect();
    let Some(places) = places else { return Cure::None };
    let good = |errors: &[(f64, f64)]| {
        places.iter().all(|place| {
            let (error, little) = errors[*place];
            error < little.max(GOOD * local.values[local.free[*place]].abs())
        })
    };
    FACTORS
        .into_iter()
        .find(|factor| local.at_amplitude(*factor).is_some_and(|errors| good(&errors)))
        .map_or(Cure::None, |factor| Cure::At(factor * cycle.amplitude))
}

/// The change of the parameters that the recordings see least of, so large that the one that changes
/// most changes by a tenth.
fn weakest(local: &Local<'_>, parameters: &[Estimate]) -> Option<String> {
    let (direction, rms) = local.tangents.weakest();
    let lengths = local.tangents.lengths();
    let named: Vec<(&Estimate, f64)> = (0..direction.len())
        .filter(|i| direction[*i].abs() > NAMED)
        .map(|i| (&parameters[local.free[i]], direction[i] / lengths[i]))
        .collect();
    let shares = named.iter().filter(|(p, _)| p.value != 0.0).map(|(p, change)| change / p.value.abs());
    let step = 0.1 / shares.max_by(|a, b| a.abs().total_cmp(&b.abs()))?;
    let text = |(p, change): &(&Estimate, f64)| {
        if p.value == 0.0 {
            format!("{} {:+.2} {}", p.name, Short(change * step), p.unit)
        } else {
            format!("{} {:+.2} %", p.name, Short(100.0 * change * step / p.value.abs()))
        }
    };
    let changes: Vec<String> = named.iter().map(text).collect();
    let force = Short((rms * step).abs());
    (changes.len() > 1)
        .then(|| format!("{} together change the force by {force:.2} N rms", changes.join(", ")))
}

/// A number with as many significant digits as the precision says.
struct Short(f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let digits = f.precision().unwrap_or(3) as i32;
        let size = if self.0 == 0.0 { 0 } else { self.0.abs().log10().floor() as i32 };
        let text = if (-4..6).contains(&size) {
            let text = format!("{:.*}", (digits - 1 - size).max(0) as usize, self.0);
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            } else {
                text
            }
        } else {
            format!("{:.*e}", (digits - 1) as usize, self.0)
        };
        if f.sign_plus() && self.0 >= 0.0 { write!(f, "+{text}") } else { f.write_str(&text) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_numbers() {
        let cases =
            [(8.0, "8"), (12.3456, "12.3"), (0.012_345, "0.0123"), (1234.5, "1234"), (1e-9, "1.00e-9")];
        for (number, text) in cases {
            assert_eq!(format!("{:.3}", Short(number)), text);
        }
        assert_eq!(format!("{:+.2}", Short(2.84)), "+2.8");
    }

    #[test]
    fn articles() {
        assert_eq!([8.0, 4.0, 11.0, 18.0, 80.0, 110.0].map(article), ["an", "a", "an", "an", "an", "a"]);
    }
}
