//! The box of a problem: default bounds, some of them replaced.

use crate::error::{Error, Result};
use crate::parameter::{Bounds, Parameter, short};
use crate::physics::SINH_LARGEST;

/// Replace default bounds by those given for a name. `displacement` is the largest one, mm.
pub(super) fn choose(
    parameters: &mut [Parameter],
    given: &[(String, f64, f64)],
    displacement: f64,
) -> Result<Bounds> {
    for (name, lower, upper) in given {
        let Some(i) = parameters.iter().position(|p| p.name == *name) else {
            let known: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
            let wanted = format!("one of {}", known.join(", "));
            return Err(Error::setting("parameter in bounds", format!("'{name}'"), wanted));
        };
        (parameters[i].lower, parameters[i].upper) = (*lower, *upper);
    }
    let refused = |p: &Parameter, wanted: String| {
        Err(Error::setting(
            format!("bound of {}", p.name),
            format!("{}:{}", short(p.lower), short(p.upper)),
            wanted,
        ))
    };
    if let Some(p) = parameters.iter().find(|p| p.lower < p.smallest || p.upper > p.largest) {
        return refused(p, format!("within {} and {}", p.smallest, p.largest));
    }
    let names: Vec<String> = parameters.iter().map(|p| p.name.clone()).collect();
    let pick = |value: fn(&Parameter) -> f64| parameters.iter().map(value).collect();
    let scale = parameters.iter().map(|p| p.scale).collect();
    let bounds = Bounds::new(&names, pick(|p| p.lower), pick(|p| p.upper), scale)?;
    let most = SINH_LARGEST / displacement;
    match parameters.iter().find(|p| p.name == "beta" && p.upper > most) {
        Some(beta) => refused(
            beta,
            format!("at most {most} 1/mm, above which sinh overflows at the largest displacement"),
        ),
        None => Ok(bounds),
    }
}
