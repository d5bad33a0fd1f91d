//! Laws that are worth a joint fit, by their scores beside a fitted model.

use rayon::prelude::*;

use super::candidates::TIE;
use super::held::Held;
use super::null::Null;
use super::screen::Score;
use super::search::REFITTED;
use crate::effect::Flexibility;

/// Laws of one effect that are fitted jointly.
const LAWS_EACH: usize = 2;
/// A law whose score is below this share of the best is not looked at further.
const PROMISING: f64 = 0.1;
/// Laws that are as strong by chance more often than this are not looked at; where one is seen plainly, with a chance
/// below this, more often than the second.
const BY_CHANCE: [f64; 2] = [0.5, 0.05];
const PLAIN: f64 = 1e-6;
/// What gives way in series is looked at where one of its laws has a smaller p-value.
const SEEN: f64 = 1e-3;
/// A law that takes off less than this share of the best, the model's tangents held, is not fitted jointly.
const CLOSE: f64 = 0.4;

/// The laws that are worth a joint fit, strongest first: a few of each effect, so that the many laws of one do
/// not crowd out the others.
pub(super) fn promising<'s>(null: &Null, scores: &'s [Score], most: usize) -> Vec<Held<'s>> {
    // Where something is plainly seen, what may be chance is a wild sample's, however much it would take off.
    let plainly = null.has_heavy_tails() && scores.iter().any(|s| s.p_value < PLAIN);
    let chance = if plainly { BY_CHANCE[1] } else { BY_CHANCE[0] };
    let seen = |s: &&Score| s.gain > 0.0 && s.p_value < chance;
    let best = scores.iter().filter(seen).map(|s| s.gain).fold(0.0, f64::max);
    let mut refined: Vec<Held> =
        scores.par_iter().filter(|s| seen(s) && s.gain >= PROMISING * best).map(|s| null.held(s)).collect();
    let best = refined.iter().map(|held| held.gain).fold(0.0, f64::max);
    // What changes the motion or the force acts on the model as it will be, not as it is: where much is missing, its
    // direction tells more than its size beside the tangents.
    let gain = |held: &Held| {
        if held.score.effect.coefficients().is_empty() { held.gain.max(held.score.gain) } else { held.gain }
    };
    let price = null.point.fitted.price();
    let size = |held: &Held| held.score.parameters();
    let paid = |held: &Held| gain(held) - price * size(held) as f64;
    refined.sort_by(|a, b| paid(b).total_cmp(&paid(a)));
    let mut kept: Vec<Held> = Vec::new();
    for held in refined {
        let id = held.score.effect.about().effect;
        let alike: Vec<&Held> = kept.iter().filter(|k| k.score.effect.about().effect == id).collect();
        // A simpler law that does as well may decide a tie.
        let simpler = alike.iter().all(|k| size(&held) < size(k) && paid(&held) > paid(k) - TIE);
        if (alike.len() < LAWS_EACH || simpler) && gain(&held) >= CLOSE * best && kept.len() < most {
            kept.push(held);
        }
    }
    if most >= REFITTED {
        kept.extend(in_series(null, scores, &kept));
    }
    kept
}

/// The plainest law of what gives way in series with a hysteretic base, unless one is there: behind it the base is
/// another, of which its tangents as it is tell little.
fn in_series<'s>(null: &Null, scores: &'s [Score], kept: &[Held]) -> Option<Held<'s>> {
    let gives_way =
        |score: &Score| score.effect.flexibility(&score.start).is_some_and(Flexibility::gives_way);
    let base = null.assembly().base();
    if base.groups().is_empty() || !base.is_hysteretic() || kept.iter().any(|held| gives_way(held.score)) {
        return None;
    }
    let mut of_them = scores.iter().filter(|score| gives_way(score));
    // Where no law of it is seen, it could not enter.
    let seen = of_them.clone().any(|score| score.p_value < SEEN);
    let score = of_them.next().filter(|_| seen)?;
    Some(Held { score, shape: score.start.clone(), gain: score.gain })
}
