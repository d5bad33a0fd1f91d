"""Blank campaigns: how often a diagnosis names something where nothing is missing."""

from typing import Any

import mre_core
import numpy as np
import pytest
from missing import campaign, with_series
from mre_core import Recording, words
from mre_core.report import report_diagnosis
from rig import Cli, force_of
from scipy.stats import binomtest  # type: ignore[import-untyped]

EFFECTS = {row["id"] for row in mre_core._core.catalogue()}


def blank_of(recordings: list[Recording], count: int, base: str = "kelvin_voigt", **given: Any) -> Any:
    return mre_core.diagnose(recordings, base, seed=1, blank=count, **given).blank


def test_a_strong_effect_is_missing_from_the_recordings_and_not_from_the_blanks() -> None:
    few = campaign()[:4]
    found = mre_core.diagnose(few, "kelvin_voigt", seed=1, blank=2, threads=1)
    assert found.verdict == "missing_physics"
    assert found.blank == {
        **{"count": 2, "named": 0, "rate": 0.0, "low": 0.0},
        # Clopper and Pearson's upper end for none of n.
        **{"high": pytest.approx(1 - 0.025 ** (1 / 2)), "stated": 0.01},
        **{"unexplained": 0, "by_effect": {}},
    }
    again = mre_core.diagnose(few, "kelvin_voigt", seed=1, blank=2, threads=3)
    assert again.to_dict() == found.to_dict()
    # The diagnosis itself does not depend on them.
    alone = mre_core.diagnose(few, "kelvin_voigt", seed=1)
    assert alone.blank is None
    assert alone.to_dict() == found.to_dict() | {"blank": None}


def test_what_was_named_is_counted() -> None:
    # At a rate of a half nearly every campaign has something named.
    found = blank_of([r.cut(0, 6) for r in campaign(0.0)[:2]], 10, false_alarm=0.49)
    assert found["count"] == 10
    assert found["named"] > 0
    assert set(found["by_effect"]) <= EFFECTS
    assert found["named"] <= sum(found["by_effect"].values()) <= 4 * found["named"]
    assert found["named"] + found["unexplained"] <= 10
    assert found["rate"] == found["named"] / 10
    ends = binomtest(found["named"], 10).proportion_ci(0.95, method="exact")
    assert (found["low"], found["high"]) == pytest.approx((ends.low, ends.high), rel=1e-9)


@pytest.mark.parametrize("base", ["sinh", "kelvin_voigt"])
def test_little_is_named_in_quantised_force(base: str) -> None:
    step = 0.5
    measured = [with_series(r, force=step * np.round(force_of(r) / step)) for r in campaign(0.0)[:3]]
    assert blank_of(measured, 6, base)["named"] == 0


def test_fixed_and_simulated_bases() -> None:
    few = campaign(0.0)[:2]
    model = mre_core.diagnose(few, "sinh", seed=1).base_model
    held = mre_core.diagnose(few, model, fixed=True, seed=1, blank=3)
    assert held.blank is not None
    assert (held.blank["count"], held.blank["named"]) == (3, 0)
    simulated = [with_series(r, simulated=mre_core.simulate(model, r)) for r in few]
    assert blank_of(simulated, 3, "simulated")["named"] == 0


def test_those_that_were_done_count() -> None:
    def on_stage(stage: str) -> None:
        if stage.startswith("blank campaigns: 2 of"):
            raise KeyboardInterrupt

    found = mre_core.diagnose(
        campaign()[:3], seed=1, blank=1000, on_stage=on_stage, on_interrupt="return", threads=1
    )
    assert found.interrupted
    assert found.verdict == "missing_physics"
    assert found.blank is not None
    assert 2 <= found.blank["count"] < 1000
    assert "Interrupted" not in str(found)


@pytest.mark.parametrize("value", [-1, 1.5, True, "3", 100_001])
def test_a_bad_number(value: Any) -> None:
    with pytest.raises(mre_core.MreError, match=r"blank is .*, wanted a whole number from 0 to 100000"):
        mre_core.diagnose(campaign()[:1], blank=value)


def test_words_on_the_screen_and_the_page(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    found = mre_core.diagnose(campaign(0.0)[:2], seed=1, blank=2)
    assert found.blank is not None
    sentence = words.blank(found.blank)
    assert sentence == (
        "In 0 of 2 simulated campaigns from which nothing is missing something was named: 0 %"
        " (95 % interval 0 % to 84.2 %), where 1 % is stated."
    )
    page = report_diagnosis(found)
    assert page.index("How this was computed") < page.index(sentence)
    some = dict(found.blank) | {"named": 2, "rate": 1.0, "by_effect": {"inertia": 2, "creep": 1}}
    assert words.blank(some).endswith("1 % is stated; named were inertia 2, creep 1.")
