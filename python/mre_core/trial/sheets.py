"""Tables of an opened trial."""

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from .outcomes import Scored
from .rates import Rate

_EDGES = (0.35, 0.7, 1.4, 2.4)
"""Between the strengths 0.25, 0.5, 1, 2 and 3 of the standard trial."""


@dataclass(frozen=True)
class Sheet:
    """A table; the first column holds text, the others are aligned to the right where `numbers` says so."""

    name: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    text: tuple[int, ...] = (0,)
    """Columns of text."""

    def markdown(self) -> str:
        """Return the table as in a Markdown file, with its title as a paragraph."""
        line = "|".join("---" if i in self.text else "---:" for i in range(len(self.columns)))
        rows = [f"| {' | '.join(row)} |" for row in (self.columns, *self.rows)]
        return "\n".join([f"{self.title}", "", rows[0], f"|{line}|", *rows[1:]]) + "\n"

    def to_dict(self) -> dict[str, Any]:
        """Return the entry of ``results.json``."""
        return asdict(self)


def sheets_of(cases: Sequence[Scored]) -> list[Sheet]:
    """Make all tables.

    Parameters
    ----------
    cases : sequence of Scored
        An opened trial.

    Returns
    -------
    list of Sheet
        Without those that would be empty.
    """
    single = [c for c in cases if len(c.effects) == 1 and c.counted and c.effects != ("unknown",)]
    nulls = [c for c in cases if not c.effects]
    groups: list[tuple[str, Callable[[Scored], str]]] = [
        ("effect", lambda c: c.effects[0]),
        ("strength", strength_of),
        ("noise", lambda c: c.noise),
        ("excitation", lambda c: c.excitation),
        ("base", lambda c: c.base),
        ("velocity", lambda c: c.velocity),
    ]
    found = [_whole(cases)]
    found += [
        _named(f"by_{what}", f"One effect concealed, by {what}", what, single, key) for what, key in groups
    ]
    found += [
        _confusion(single),
        _wrong_names(cases),
        _kinds("pairs", "Two effects concealed", "effects", (c for c in cases if len(c.effects) == 2), _pair),
        _kinds(
            "unknown",
            "Physics of no catalogue",
            "law",
            (c for c in cases if c.effects == ("unknown",)),
            lambda c: c.laws[0],
        ),
        _nulls("nulls", "noise", nulls, lambda c: c.noise),
        _nulls("nulls_by_channels", "channels", nulls, _channels),
        _parameters(cases),
        _held_out(cases),
    ]
    return [sheet for sheet in found if sheet.rows]


def strength_of(case: Scored) -> str:
    """Return the strength of the standard trial nearest to what was concealed."""
    names = ("0.25", "0.5", "1", "2", "3")
    return names[sum(case.strength > edge for edge in _EDGES)]


def _grouped(cases: Iterable[Scored], key: Callable[[Scored], str]) -> dict[str, list[Scored]]:
    found: dict[str, list[Scored]] = {}
    for case in cases:
        found.setdefault(key(case), []).append(case)
    return dict(sorted(found.items()))


def _right(cases: Sequence[Scored]) -> Rate:
    return Rate(sum(c.outcome.kind == "right" for c in cases), len(cases))


def _otherwise(cases: Iterable[Scored], usual: str = "right") -> str:
    counts = Counter(c.outcome.kind for c in cases if c.outcome.kind != usual)
    return ", ".join(f"{kind} {count}" for kind, count in counts.most_common())


def _whole(cases: Sequence[Scored]) -> Sheet:
    absorbed = [c for c in cases if c.effects and not c.reached]
    parts = [
        ("one effect", [c for c in cases if len(c.effects) == 1 and c.counted and c.effects != ("unknown",)]),
        ("two effects", [c for c in cases if len(c.effects) == 2 and c.counted]),
        ("physics of no catalogue", [c for c in cases if c.effects == ("unknown",) and c.counted]),
        ("nothing", [c for c in cases if not c.effects]),
        ("an effect that the base absorbs", absorbed),
    ]
    good = {"physics of no catalogue": "admitted", "nothing": "clear"}
    rows = []
    for what, members in parts:
        if members:
            usual = good.get(what, "right")
            rate = Rate(sum(c.outcome.kind == usual for c in members), len(members))
            rows.append(
                (what, str(len(members)), f"{rate.count} {usual}", str(rate), _otherwise(members, usual))
            )
    shown = max((c.error_shown for c in cases if c.effects), default=0.0)
    seconds = sorted(c.seconds for c in cases)
    title = (
        f"{len(cases)} cases. At worst the refitted base leaves {100 * shown:.1f} % of the force, noise"
        f" included. A diagnosis took {median(seconds):.1f} s in the median, {seconds[-1]:.0f} s at most, one"
        " thread each. In brackets Wilson's 95 % intervals."
    )
    return Sheet("all", title, ("concealed", "cases", "result", "share", "otherwise"), tuple(rows), (0, 4))


def _named(name: str, title: str, what: str, cases: Sequence[Scored], key: Callable[[Scored], str]) -> Sheet:
    rows = []
    for group, members in _grouped(cases, key).items():
        rate = _right(members)
        rows.append((group, str(rate.total), str(rate.count), str(rate), _otherwise(members)))
    return Sheet(name, title, (what, "cases", "right", "share", "otherwise"), tuple(rows), (0, 4))


def _confusion(cases: Sequence[Scored]) -> Sheet:
    """List what is off the diagonal, which is sparse."""
    counts = Counter((c.effects[0], ", ".join(c.outcome.named) or "nothing") for c in cases)
    rows = [(truth, said, str(n)) for (truth, said), n in sorted(counts.items()) if truth != said]
    title = "One effect concealed, another answer given"
    return Sheet("confusion", title, ("concealed", "named", "cases"), tuple(rows), (0, 1))


def _wrong_names(cases: Sequence[Scored]) -> Sheet:
    given = Counter(name for c in cases for name in c.outcome.named)
    wrong = Counter(name for c in cases for name in c.outcome.named if name not in c.effects)
    rows = [(name, str(given[name]), str(wrong[name])) for name in sorted(wrong)]
    title = "Names that were given where they were not true"
    return Sheet("wrong_names", title, ("effect", "times named", "of these wrong"), tuple(rows))


def _pair(case: Scored) -> str:
    return " and ".join(sorted(case.effects))


def _kinds(name: str, title: str, what: str, cases: Iterable[Scored], key: Callable[[Scored], str]) -> Sheet:
    rows = [
        (
            group,
            str(len(members)),
            _otherwise(members, ""),
            "; ".join(sorted({", ".join(c.outcome.named) or f"nothing ({c.verdict})" for c in members})),
        )
        for group, members in _grouped(cases, key).items()
    ]
    return Sheet(name, title, (what, "cases", "outcome", "named"), tuple(rows), (0, 2, 3))


def _channels(case: Scored) -> str:
    clean = "exact displacement" if case.displacement_noise == 0 else "noisy displacement"
    return f"{clean}, velocity {case.velocity}"


def _nulls(name: str, what: str, cases: Sequence[Scored], key: Callable[[Scored], str]) -> Sheet:
    rows = []
    for group, members in [*_grouped(cases, key).items(), ("all", list(cases))]:
        false = [c for c in members if c.outcome.kind == "false"]
        names = "; ".join(sorted(", ".join(c.outcome.named) or c.verdict for c in false))
        rows.append((group, str(len(members)), str(len(false)), str(Rate(len(false), len(members))), names))
    title = f"Nothing concealed: false discoveries by {what}"
    columns = (what, "cases", "false", "share", "named")
    return Sheet(name, title, columns, tuple(rows) if cases else (), (0, 4))


def _parameters(cases: Sequence[Scored]) -> Sheet:
    found: dict[tuple[str, str, str], list[Any]] = {}
    for case in cases:
        for one in case.parameters if case.outcome.kind in ("right", "extra") else ():
            found.setdefault((one.effect, one.parameter, one.unit), []).append(one)
    rows = []
    for (effect, name, unit), members in sorted(found.items()):
        errors = [abs(one.error) for one in members]
        known = [one.inside for one in members if one.inside is not None]
        inside = f"{sum(known)} of {len(known)}"
        rows.append(
            (effect, f"{name} / {unit}" if unit else name, str(len(members)), f"{100 * median(errors):.2g} %",
             f"{100 * max(errors):.2g} %", inside)
        )  # fmt: skip
    title = (
        "Parameters of effects named, where both laws are the same formula: error as a share of the truth,"
        " and 95 % intervals that hold the truth"
    )
    columns = ("effect", "parameter", "cases", "median error", "largest error", "within")
    return Sheet("parameters", title, columns, tuple(rows), (0, 1))


def _held_out(cases: Sequence[Scored]) -> Sheet:
    rows = []
    groups = _grouped((c for c in cases if c.counted and c.held_out_after is not None), strength_of)
    for strength, members in groups.items():
        before = median((c.held_out_before or 0.0) / c.noise_rms for c in members)
        after = median((c.held_out_after or 0.0) / c.noise_rms for c in members)
        worst = max((c.held_out_after or 0.0) / c.noise_rms for c in members)
        rows.append((strength, str(len(members)), f"{before:.2f}", f"{after:.2f}", f"{worst:.2f}"))
    title = "Rms error on held-out data over the rms of the noise, medians, and the worst case after"
    columns = ("strength", "cases", "base model", "with effects", "worst")
    return Sheet("held_out", title, columns, tuple(rows))
