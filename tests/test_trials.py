"""A short trial of the diagnosis: it may not get worse than it was when its rates were measured.

The floors follow from those rates: of a tool that is as good as the lower end of Wilson's interval, one trial
in a thousand falls below.
"""

import pytest
from mre_core.trial.outcomes import Scored
from mre_core.trial.rates import Rate
from scipy.stats import binom  # type: ignore[import-untyped]
from short_trial import EFFECTS, NULLS, counts, short_trial

SEED = 500
MEASURED = Rate(51, 56), Rate(23, 24)
"""Named right and clear, by ``tests/short_trial.py 2 3``; the seed above is not among these."""
TAIL = 1e-3


def floor(measured: Rate, cases: int) -> int:
    return int(binom.ppf(TAIL, cases, measured.interval[0]))


@pytest.fixture(scope="module")
def cases(tmp_path_factory: pytest.TempPathFactory) -> list[Scored]:
    return list(short_trial(SEED, tmp_path_factory.mktemp("short") / "trial"))


def told(cases: list[Scored]) -> str:
    return "; ".join(f"{c.effects} {c.base} {c.noise}: {c.outcome.named}, {c.outcome.kind}" for c in cases)


def test_effects_are_named(cases: list[Scored]) -> None:
    right, seen, _, _ = counts(cases)
    assert seen > 0.7 * EFFECTS
    assert right >= floor(MEASURED[0], seen), told(cases)


def test_nothing_is_named_where_nothing_is_missing(cases: list[Scored]) -> None:
    *_, clear, nulls = counts(cases)
    assert nulls == NULLS
    assert clear >= floor(MEASURED[1], nulls), told([c for c in cases if not c.effects])


def test_floors_would_fail_a_worse_tool() -> None:
    # One that names half of what it named would fall below.
    assert floor(MEASURED[0], EFFECTS) > 0.5 * MEASURED[0].share * EFFECTS
