//! What an excitation is expected to tell of the laws in doubt, effect by effect.

/// A law that is in doubt, and what an excitation tells of it.
pub(super) struct Told {
    /// Its effect.
    pub(super) id: &'static str,
    /// That it is told from the model named; about the same with either of the two as the truth.
    pub(super) chance: f64,
    /// That it is true, over those of the model named.
    pub(super) odds: f64,
}

/// Chance of each effect in doubt: the model named is true and rules out each of its laws, or one of these is true and
/// rules out the model named.
pub(super) fn by_effect(told: &[Told]) -> Vec<(&'static str, f64)> {
    let mut ids: Vec<&'static str> = Vec::new();
    for law in told {
        if !ids.contains(&law.id) {
            ids.push(law.id);
        }
    }
    let chance = |id| {
        let laws = || told.iter().filter(move |law| law.id == id);
        let all = laws().map(|law| law.chance).fold(1.0, f64::min);
        let odds: f64 = laws().map(|law| law.odds).sum();
        let each: f64 = laws().map(|law| law.odds * law.chance).sum();
        (id, (all + each) / (1.0 + odds))
    };
    ids.into_iter().map(chance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_is_told_apart_with_all_of_its_laws() {
        let law = |id, chance, odds| Told { id, chance, odds };
        let told = [law("a", 0.9, 1.0), law("b", 1.0, 1.0), law("b", 0.0, 1.0)];
        let found = by_effect(&told);
        assert_eq!(found.iter().map(|(id, _)| *id).collect::<Vec<_>>(), ["a", "b"]);
        assert!((found[0].1 - 0.9).abs() < 1e-12);
        // Only where the first law of b is true, a test tells.
        assert!((found[1].1 - 1.0 / 3.0).abs() < 1e-12);
    }
}
