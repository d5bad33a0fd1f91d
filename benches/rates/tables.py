"""Tables of outcomes, as Markdown."""

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np
from detection import nulls, power
from judge import Outcome
from located import Located
from mre_core.trial.rates import Rate
from resolve import Resolved
from rows import by, rate, table

SURE = 0.9
"""Chance from which a test is said to resolve a doubt."""


def naming(found: Sequence[Outcome]) -> str:
    """Names right, by strength, and every case that is not right."""
    groups = by([o for o in found if o.reached], lambda o: o.trial.case.strength)
    rows = [
        (
            f"{strength:g}",
            len(own),
            rate(own, lambda o: o.right),
            rate(own, lambda o: o.among),
            rate(
                own,
                lambda o: bool(set(o.named) - set(o.trial.case.effects)) and o.verdict == "missing_physics",
            ),
            rate(own, lambda o: o.verdict == "adequate"),
            f"{np.median([o.error for o in own]):.2f}",
            f"{np.median([o.seconds for o in own]):.1f}",
        )
        for strength, own in sorted(groups.items(), key=lambda pair: -float(str(pair[0])))
    ]
    head = ("strength", "cases", "named right", "truth named or listed as indistinguishable")
    more = ("a wrong name as the whole answer", "nothing found", "model error / noise, median", "s, median")
    misses = Counter(
        f"{' + '.join(o.trial.case.effects)}: {o.verdict}{', ' * bool(o.named)}{' + '.join(o.named)}"
        for o in found
        if o.reached and not o.right
    )
    absorbed = sum(not o.reached for o in found)
    sizes = Counter(size for o in found if o.reached for size in o.sets)
    told = ", ".join(f"{size}: {n}" for size, n in sorted(sizes.items()))
    return "\n".join(
        [
            table((*head, *more), rows),
            "",
            f"Effects that may stand in one place, and how often: {told}.",
            "",
            f"Not counted: {absorbed} that the base model absorbs at any size. Not right: "
            + ("; ".join(f"{what} ({n})" for what, n in misses.most_common()) or "none")
            + ".",
        ]
    )


def admission(found: Sequence[Outcome]) -> str:
    """What is said where the truth may not be named."""

    def key(o: Outcome) -> str:
        return o.trial.case.effects[0] if o.trial.without else o.trial.case.laws[0]

    reached = [o for o in found if o.reached]
    groups = {"all": reached, **by(reached, key)}
    rows = [
        (
            what,
            len(own),
            rate(own, lambda o: o.verdict == "unexplained"),
            rate(own, lambda o: o.verdict == "partly_explained"),
            rate(own, lambda o: o.verdict == "missing_physics"),
            sum(o.twin for o in own),
            sum(o.verdict == "missing_physics" and o.p_rest > o.trial.false_alarm for o in own),
            rate(own, lambda o: o.verdict == "adequate"),
            ", ".join(sorted({n for o in own for n in o.named})),
        )
        for what, own in groups.items()
    ]
    head = ("concealed", "cases", "`unexplained`", "`partly_explained`", "a wrong name as the whole answer")
    head = (*head, "of these not to be told from the truth")
    return table((*head, "of these down to the noise", "nothing found", "names given"), rows)


def resolved(found: Sequence[Resolved]) -> str:
    """What the proposed tests decide, by their kind."""
    doubted = [r for r in found if r.doubted]
    tested = [r for r in doubted if r.told]
    groups: dict[object, list[Resolved]] = {"all": tested}
    for one in tested:
        groups.setdefault(one.excitation, []).append(one)
    rows = [
        (
            what,
            len(own),
            _expected(own),
            Rate(sum(r.right for r in own), len(own)),
            Rate(sum(r.as_told for r in own), len(own)),
            sum(len(r.after) > 1 and set(r.trial.case.effects) <= r.after for r in own),
            sum(not set(r.trial.case.effects) <= r.after for r in own),
        )
        for what, own in groups.items()
    ]
    head = (
        *("proposed test", "in doubt before", "the tool expects one effect alone after it"),
        *("the truth alone after", "the truth, and no more beside it than the tool expects"),
        *("still in doubt", "truth lost"),
    )
    of_all = Rate(sum(r.right for r in tested), len(doubted))
    hopeless = [r for r in doubted if not r.told]
    sure = [r for r in tested if r.expected is not None and r.expected >= SURE]
    alone = [r for r in tested if r.left == frozenset()]
    text = (
        f"Of {len(found)} campaigns {len(doubted)} left several, the truth among them."
        f" In {len(hopeless)} the tool says that no test within the limits would tell: {_listed(hopeless)}."
        f" The truth alone after a test, of all: {of_all};"
        f" of those where {100 * SURE:.0f} % or more is expected:"
        f" {Rate(sum(r.right for r in sure), len(sure))}; of those where nothing else is expected beside the"
        f" truth: {Rate(sum(r.right for r in alone), len(alone))}."
        f" Not resolved: {_listed([r for r in tested if not r.right])}."
    )
    return f"{table(head, rows)}\n\n{text}"


def _expected(found: Sequence[Resolved]) -> str:
    """Mean of the chances that are given, and how many are not."""
    given = [r.expected for r in found if r.expected is not None]
    mean = f"{100 * sum(given) / len(given):.0f} %" if given else "-"
    return mean if len(given) == len(found) else f"{mean} ({len(found) - len(given)} without)"


def _listed(found: Sequence[Resolved]) -> str:
    """What is left, with how often."""
    left = Counter(
        f"{', '.join(r.trial.case.effects)}: {' or '.join(sorted(r.after)) or 'nothing'}" for r in found
    )
    return "; ".join(f"{what} ({n})" for what, n in left.most_common()) or "none"


def places(found: Sequence[Located]) -> str:
    """How often the first place told is where the effect is, by effect."""
    groups: dict[object, list[Located]] = {"all": list(found)}
    for one in found:
        case = one.trial.case
        groups.setdefault(case.laws[0] if case.effects[0] == "unknown" else case.effects[0], []).append(one)
    rows = []
    for what, own in groups.items():
        other = Counter(one.told or "no place" for one in own if not one.right)
        said = ", ".join(f"{kind} ({n})" for kind, n in other.most_common())
        rows.append((what, len(own), Rate(sum(one.right for one in own), len(own)), said))
    return table(
        ("concealed", "cases", "first place holds it, and is narrow", "kind of the first place else"), rows
    )


TABLES: dict[str, Callable[..., str]] = {
    "singles": naming,
    "others": naming,
    "pairs": naming,
    "triples": naming,
    "removed": admission,
    "unknown": admission,
    "nulls": nulls,
    "weak": power,
    "doubts": resolved,
    "located": places,
}
