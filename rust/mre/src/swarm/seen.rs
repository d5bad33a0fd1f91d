//! What the costs of some points come to.

/// The best of some points, and how many could not be evaluated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    /// The least finite cost; infinity where there is none.
    pub(super) least: f64,
    /// The first point with it.
    pub(super) at: usize,
    /// Points with an infinite cost,
    pub(super) infinite: u32,
    /// and those with none.
    pub(super) unknown: u32,
}

impl Seen {
    /// Of no point.
    pub(super) const NOTHING: Self = Self { least: f64::INFINITY, at: 0, infinite: 0, unknown: 0 };

    pub(super) fn of(costs: &[f64]) -> Self {
        let least = least(costs);
        let finite = least < f64::INFINITY;
        let at = if finite { costs.iter().position(|cost| *cost == least) } else { None };
        let count = |is: fn(f64) -> bool| costs.iter().filter(|cost| is(**cost)).count() as u32;
        Self { least, at: at.unwrap_or(0), infinite: count(f64::is_infinite), unknown: count(f64::is_nan) }
    }
}

/// The least finite cost; infinity where there is none. In lanes: one after the other, every comparison would
/// wait for the one before.
fn least(costs: &[f64]) -> f64 {
    let less = |least: &mut f64, cost: &f64| {
        if *cost < *least && *cost > f64::NEG_INFINITY {
            *least = *cost;
        }
    };
    let mut lanes = [f64::INFINITY; 8];
    let (chunks, rest) = costs.as_chunks::<8>();
    for chunk in chunks {
        lanes.iter_mut().zip(chunk).for_each(|(least, cost)| less(least, cost));
    }
    let mut all = f64::INFINITY;
    lanes.iter().chain(rest).for_each(|cost| less(&mut all, cost));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equals_is_seen_and_what_is_not_finite_is_counted() {
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        let mut costs = vec![5.0, nan, 3.0, inf, 3.0, -inf, 4.0, 9.0, 8.0, 3.0, 7.0];
        assert_eq!(Seen::of(&costs), Seen { least: 3.0, at: 2, infinite: 2, unknown: 1 });
        costs[10] = -2.0;
        assert_eq!(Seen::of(&costs), Seen { least: -2.0, at: 10, infinite: 2, unknown: 1 });
        assert_eq!(Seen::of(&[nan, inf]), Seen { least: inf, at: 0, infinite: 1, unknown: 1 });
        assert_eq!(Seen::of(&[]), Seen::NOTHING);
    }
}
