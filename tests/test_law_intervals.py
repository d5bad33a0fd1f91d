"""Intervals of the values of laws: coverage, a twin, and what has none."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pytest
from mre_core import Recording
from mre_core.current_laws.bounds import bound_of, physical_of
from mre_core.current_laws.campaign import Campaign
from mre_core.current_laws.shapes import ShapeBox
from mre_core.current_laws.structure import Structure
from mre_core.current_laws.tangents import Value
from rig import Cli, made_of, motion, record, write_csv
from scipy.signal import lfilter  # type: ignore[import-untyped]

CURRENTS = (0.0, 0.5, 1.0, 2.0)
LAWS = {"c0": "linear", "k0": "linear", "alpha": "saturating"}
VALUES = (0.3, 1.3, 4.0, 10.0, 8.0, 8 + 20 * (1 - np.exp(-2 / 0.8)), 0.8, 0.3, 0.5)
"""c0 and k0 at 0 and 2 A, alpha there and its saturation, beta, F0."""
NOISE = 2.0


def alpha(current: Any) -> Any:
    return 8 + 20 * (1 - np.exp(-current / 0.8))


def recording_of(current: Any, stroke: float, noise: np.random.Generator, correlated: float) -> Recording:
    t = np.arange(512) / 128
    turn = 2 * np.pi
    x = stroke * (0.7 * np.sin(turn * t) + 0.3 * np.sin(turn * 2.37 * t))
    v = stroke * turn * (0.7 * np.cos(turn * t) + 0.711 * np.cos(turn * 2.37 * t))
    force = (0.3 + 0.5 * current) * v + (4 + 3 * current) * x + alpha(current) * np.sinh(0.3 * x) + 0.5
    white = noise.normal(size=len(t) + 500)
    error = lfilter([np.sqrt(1 - correlated**2)], [1, -correlated], white)[500:]
    return Recording(t, x, force + NOISE * error, velocity=v, current=current)


def campaign(seed: int, correlated: float = 0.0) -> list[Recording]:
    noise = np.random.default_rng(seed)
    return [recording_of(i, stroke, noise, correlated) for i in CURRENTS for stroke in (3.0, 8.0)]


@pytest.mark.parametrize("correlated", [0.0, 0.9])
def test_they_hold_the_truth_as_often_as_they_say(correlated: float) -> None:
    held = []
    for seed in range(60):
        found = mre_core.fit_laws(campaign(seed, correlated), "sinh", LAWS, ["beta", "F0"])
        ends = zip(found.rows(), VALUES, strict=True)
        held.append([row["low"] <= value <= row["high"] for row, value in ends])
        for level in found.model.levels:
            low, high = level.intervals["alpha"]
            held[-1].append(low <= alpha(level.current) <= high)
    assert 0.92 < np.mean(held) < 0.98
    assert np.mean(held, axis=0).min() > 0.85


def test_one_level_meets_the_uncertainty_of_an_identification() -> None:
    one = [recording_of(1.0, stroke, np.random.default_rng(3), 0.5) for stroke in (3.0, 8.0)]
    found = mre_core.fit_laws(one, "sinh", dict.fromkeys(("c0", "k0", "alpha", "beta", "F0"), "constant"))
    twin = mre_core.identify(one, "sinh", optimizer="exact").model.levels[0].intervals
    for row in found.rows():
        low, high = twin[row["parameter"]]
        assert row["high"] - row["low"] == pytest.approx(high - low, rel=0.03)
        assert row["low"] + row["high"] == pytest.approx(low + high, rel=1e-3)


def test_under_a_current_that_changes() -> None:
    noise = np.random.default_rng(5)
    ramps = [recording_of(np.linspace(0, 2, 512), stroke, noise, 0.0) for stroke in (3.0, 8.0)]
    found = mre_core.fit_laws([*campaign(5)[:4], *ramps], "sinh", LAWS, ["beta", "F0"])
    for row, value in zip(found.rows(), VALUES, strict=True):
        reach = (row["high"] - row["low"]) / 2
        assert abs(row["value"] - value) < 1.5 * reach < 0.5 * abs(value)


def test_bouc_wen_has_them_too() -> None:
    truth = {"c0": 0.5, "kx": 3.0, "kw": 40.0, "rho": 0.8, "sigma": 1.5, "n": 1.5, "F0": 1.0}
    tests = []
    for i in (0.0, 1.0):
        device = made_of("bouc_wen", truth | {"kw": 40 + 20 * i}, i)
        for a in (4.0, 8.0):
            tests.append(record(device, motion(a, rate=64.0, current=i), noise=0.5, seed=int(a + i)))
    names = [name for name in truth if name != "kw"]
    found = mre_core.fit_laws(tests, "bouc_wen", {"kw": "linear"}, names)
    rows = {(row["parameter"], row["at"]): row for row in found.rows()}
    for at, value in ((0.0, 40.0), (1.0, 60.0)):
        row = rows["kw", at]
        assert row["low"] < value < row["high"]
        assert row["high"] - row["low"] < 8


def test_what_is_not_determined_has_none() -> None:
    """At 1 mm only k0 + alpha beta is determined."""
    noise = np.random.default_rng(1)
    small = [recording_of(i, 1.0, noise, 0.0) for i in CURRENTS]
    rows = mre_core.fit_laws(small, "sinh", LAWS, ["beta", "F0"]).rows()
    has = {row["parameter"]: row["low"] is not None for row in rows}
    assert has["c0"]
    assert not (has["k0"] or has["alpha"] or has["beta"])


def test_a_bound_that_holds_a_value_leaves_none() -> None:
    held = mre_core.fit_laws(campaign(1), "sinh", LAWS, ["beta", "F0"], bounds={"beta": (0.32, 0.4)})
    fixed = mre_core.fit_laws(campaign(1), "sinh", LAWS, ["beta", "F0"], bounds={"F0": (0.5, 0.5)})
    by_name = [{row["parameter"]: row["low"] for row in found.rows()} for found in (held, fixed)]
    assert by_name[0]["beta"] is None
    assert (by_name[1]["F0"], by_name[1]["beta"] is None) == (None, False)


def test_what_can_be_read_only_once_has_none() -> None:
    once = mre_core.fit_laws(iter(campaign(1)), "sinh", LAWS, ["beta", "F0"])
    again = mre_core.fit_laws(campaign(1), "sinh", LAWS, ["beta", "F0"])
    assert once.spread is None
    assert all(row["low"] is None for row in once.rows())
    assert [row["value"] for row in once.rows()] == [row["value"] for row in again.rows()]


def test_the_command_shows_and_keeps_them(cli: Cli, tmp_path: Path) -> None:
    files = []
    for k, recording in enumerate(campaign(2)):
        files.append(write_csv(tmp_path / f"{k}_{recording.current_level:g}A.csv", recording))
    text = files[0].read_text(encoding="utf-8")
    files[0].write_text(text.replace("time_s", "time", 1), encoding="utf-8")
    out = tmp_path / "out"
    laws = [word for name, kind in LAWS.items() for word in ("--law", f"{name}={kind}")]
    shared = ["--shared", "beta", "--shared", "F0", "--name-pattern", "{test}_{current}A"]
    status, shown, err = cli("laws", *files, "--model", "sinh", *laws, *shared, "--out", out)
    assert (status, err.count("\n"), err.count("no unit")) == (0, 1, 1)  # said once, though it is read twice
    table = pd.read_csv(out / "laws.csv")
    assert list(table) == ["parameter", "law", "at", "value", "unit", "low", "high", "note"]
    assert ((table["low"] < table["value"]) & (table["value"] < table["high"])).all()
    kept = json.loads((out / "laws.json").read_text(encoding="utf-8"))["values"]
    assert [row["high"] for row in kept] == pytest.approx(table["high"].tolist(), rel=1e-14)
    assert f"{kept[0]['low']:.5g} to {kept[0]['high']:.5g}" in shown
    level = json.loads((out / "model.json").read_text(encoding="utf-8"))["levels"][0]["parameters"]
    assert level["c0"]["low"] == pytest.approx(table.at[0, "low"], rel=1e-12)


@pytest.mark.parametrize(
    ("value", "bound"), [(1.0, ("lower", True)), (3.0, ("upper", False)), (2.0, None)], ids=str
)
def test_a_shape_at_its_physical_limit_is_told_from_one_on_a_bound(
    value: float, bound: tuple[str, bool] | None
) -> None:
    limits = (1.0, np.inf)
    searched = {"n": ShapeBox(1.0, 3.0, True, limits)}
    structure = Structure.of("bouc_wen")
    campaign = Campaign(structure, (), {}, searched, {}, None, samples=1, weight=1.0)
    n = Value("n", "constant", None, value, "1")
    assert bound_of(campaign, n) == bound
    assert physical_of(campaign, "n") == limits
    fixed = replace(campaign, shape_boxes={"n": ShapeBox(value, value, True, limits)})
    assert bound_of(fixed, n) is None  # somebody wants it
