"""A table as Markdown, and what its rows are made of."""

from collections.abc import Callable, Iterable, Sequence

from judge import Outcome
from mre_core.trial.rates import Rate

Row = Sequence[object]


def table(head: Row, rows: Iterable[Row]) -> str:
    """A table; numbers to the right."""
    lines = [" | ".join(map(str, head)), " | ".join(["---"] + ["---:"] * (len(head) - 1))]
    return "\n".join(f"| {line} |" for line in [*lines, *(" | ".join(map(str, row)) for row in rows)])


def rate(found: Sequence[Outcome], of: Callable[[Outcome], bool]) -> Rate:
    """Share of outcomes."""
    return Rate(sum(map(of, found)), len(found))


def by(found: Sequence[Outcome], key: Callable[[Outcome], object]) -> dict[object, list[Outcome]]:
    """Outcomes in groups."""
    groups: dict[object, list[Outcome]] = {}
    for outcome in found:
        groups.setdefault(key(outcome), []).append(outcome)
    return groups
