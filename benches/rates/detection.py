"""Tables of what is detected: where nothing is missing, and beside an oracle."""

from collections.abc import Sequence

from judge import Outcome
from plans import LEVEL
from rows import by, rate, table
from scipy.stats import kstest


def nulls(found: Sequence[Outcome]) -> str:
    """False discoveries by noise."""

    def of_the_noise(o: Outcome) -> bool:
        """A hum is there: to name it is right."""
        return o.trial.case.noise == "mains" and set(o.named) == {"mains_interference"}

    def false(o: Outcome) -> bool:
        return o.verdict != "adequate" and not of_the_noise(o)

    groups = {"all": list(found), **by(found, lambda o: o.trial.case.noise)}
    rows = []
    for what, own in groups.items():
        rows.append(
            (
                what,
                len(own),
                sum(map(false, own)),
                rate(own, false),
                sum(map(of_the_noise, own)),
                f"{kstest([o.p_base for o in own], 'uniform').pvalue:.2g}",
                ", ".join(sorted({n for o in own if false(o) for n in (o.named or (o.verdict,))})),
            )
        )
    head = ("noise", "nulls", "false", f"rate (stated: {100 * LEVEL:g} %)", "hum named", "p uniform")
    return table((*head, "what was said"), rows)


def power(found: Sequence[Outcome]) -> str:
    """Detection beside the oracle's, by strength and by effect."""
    ours = [o for o in found if not o.trial.without]
    oracle = [o for o in found if o.trial.without]
    rows = []
    for strength, own in sorted(by(ours, lambda o: o.trial.case.strength).items(), key=str, reverse=True):
        best = [o for o in oracle if o.trial.case.strength == strength]
        said = (rate(own, lambda o: o.verdict != "adequate"), rate(own, lambda o: o.among))
        rows.append((f"{strength:g}", len(own), rate(best, lambda o: bool(o.named)), *said))
    head = ("strength", "cases", "oracle detects", "ours says that something is missing")
    named = table((*head, "ours: truth named or listed as indistinguishable"), rows)
    return "\n\n".join(
        [named, "Detected by us / by the oracle / of so many cases, by effect:", _each(ours, oracle)]
    )


def _each(ours: Sequence[Outcome], oracle: Sequence[Outcome]) -> str:
    """Detections of every effect at every strength."""
    strengths = sorted({o.trial.case.strength for o in ours}, reverse=True)
    rows = []
    for effect, own in by(ours, lambda o: o.trial.case.effects[0]).items():
        best = [o for o in oracle if o.trial.case.effects[0] == effect]
        cells = []
        for strength in strengths:
            at = [o for o in own if o.trial.case.strength == strength]
            seen = sum(o.verdict != "adequate" for o in at)
            known = sum(bool(o.named) for o in best if o.trial.case.strength == strength)
            cells.append(f"{seen} / {known} / {len(at)}")
        rows.append((effect, *cells))
    return table(("effect", *(f"{strength:g}" for strength in strengths)), rows)
