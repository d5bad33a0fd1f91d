"""Profiles and bootstrap: against the tangents, the exact fit, and the number of threads."""

import json
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import Problem, Recording
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, Cli, made_of, motion, record
from test_uncertainty import noisy


@pytest.fixture(scope="module")
def problem() -> Problem:
    truth = SINH | {"k0": 13.66, "alpha": 5.876}
    return Problem(noisy("sinh", truth, motion(8.0), rms=0.2, memory=0.8, seed=5), "sinh")


def test_profile_of_a_linear_model_is_its_interval() -> None:
    recording = noisy("kelvin_voigt", KELVIN_VOIGT, motion(), rms=0.3, memory=0.8, seed=1)
    problem = Problem(recording, "kelvin_voigt")
    x = mre_core.exact(problem).x
    by_tangents = mre_core.uncertainty(problem, x, level=0.9).parameters
    by_profile = mre_core.profile(problem, x, level=0.9)
    assert [p.name for p in by_profile] == ["c0", "k0", "F0"]
    for one, other in zip(by_tangents, by_profile, strict=True):
        width = (one.high or 0) - (one.low or 0)
        assert one.low is not None
        assert other.low == pytest.approx(one.low, abs=2e-3 * width)
        assert other.high == pytest.approx(one.high, abs=2e-3 * width)


def test_others_are_fitted_again_exactly_along_a_profile(problem: Problem) -> None:
    x = mre_core.exact(problem).x
    for place, found in enumerate(mre_core.profile(problem, x)):
        assert found.low is not None
        assert found.high is not None
        assert found.low < found.value < found.high
        values, costs = found.points.T
        assert np.all(np.diff(values) > 0)
        assert costs.min() == problem.fitness(x)
        for value, cost in found.points[:: max(1, len(values) // 4)]:
            held = {problem.names[place]: (float(value), float(np.nextafter(value, np.inf)))}
            assert cost == pytest.approx(
                mre_core.exact(Problem(problem.recordings, "sinh", held)).fun, rel=1e-9
            )


def test_profile_is_open_where_nothing_ends_it() -> None:
    recording = record(made_of("sinh", SINH), motion(2.0), noise=0.4, seed=1)
    problem = Problem(recording, "sinh")
    found = {p.name: p for p in mre_core.profile(problem, mre_core.exact(problem).x)}
    assert found["beta"].high is None
    assert found["c0"].low is not None
    assert "bound" in found["beta"].interval


def test_profile_of_bouc_wen_holds_the_truth() -> None:
    recording = noisy("bouc_wen", BOUC_WEN, motion(8.0, rate=100.0), rms=0.3, memory=0.5, seed=2)
    problem = Problem(recording, "bouc_wen")
    for found, truth in zip(
        mre_core.profile(problem, mre_core.exact(problem).x, level=0.999), BOUC_WEN.values(), strict=True
    ):
        assert (found.low or -np.inf) < truth < (found.high or np.inf)


def test_bootstrap_spreads_as_the_tangents_say(problem: Problem) -> None:
    x = mre_core.exact(problem).x
    by_tangents = mre_core.uncertainty(problem, x)
    found = mre_core.bootstrap(problem, x, 3000, seed=1)
    assert found.replicates.shape == (3000, 9)
    estimates = (*by_tangents.parameters, *by_tangents.derived)
    assert list(found.intervals) == [e.name for e in estimates]
    for column, e in zip(found.replicates.T, estimates, strict=True):
        assert e.standard_error is not None
        assert np.std(column) == pytest.approx(e.standard_error, rel=0.08)
        low, high = found.intervals[e.name]
        assert (low, high) == pytest.approx(np.quantile(column, [0.025, 0.975]), rel=1e-12)
        assert e.low is not None
        assert e.high is not None
        assert high - low == pytest.approx(e.high - e.low, rel=0.15)


def test_a_replicate_is_a_fit_of_its_own(problem: Problem) -> None:
    x = mre_core.exact(problem).x
    few, many = (mre_core.bootstrap(problem, x, n, seed=3).replicates for n in (5, 50))
    np.testing.assert_array_equal(few, many[:5])
    assert not np.array_equal(few, mre_core.bootstrap(problem, x, 5, seed=4).replicates)


@pytest.mark.parametrize("model", ["kelvin_voigt", "sinh", "bouc_wen"])
def test_same_bits_for_any_number_of_threads(model: str, sinh_4mm: Recording) -> None:
    problem = Problem(sinh_4mm, model)
    x = mre_core.exact(problem).x
    one, two = (mre_core.bootstrap(problem, x, 8, seed=1, threads=n) for n in (1, 2))
    assert one.replicates.tobytes() == two.replicates.tobytes()
    first, second = (mre_core.profile(problem, x, threads=n) for n in (1, 2))
    assert [p.points.tobytes() for p in first] == [p.points.tobytes() for p in second]


@pytest.mark.parametrize("replicates", [0, 1, -3, 10**7])
def test_numbers_of_replicates_that_are_none(problem: Problem, replicates: int) -> None:
    with pytest.raises(mre_core.MreError, match=f"replicates is {replicates}"):
        mre_core.bootstrap(problem, list(SINH.values()), replicates, seed=1)
    with pytest.raises(mre_core.MreError, match="seed is -1"):
        mre_core.bootstrap(problem, list(SINH.values()), 10, seed=-1)


def test_command_writes_and_shows_what_was_asked_for(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    common: list[str | Path] = [
        "identify",
        sinh_csv,
        "--model",
        "sinh",
        "--seed",
        "1",
        "--no-figures",
        "--out",
        tmp_path / "r",
    ]
    code, out, _ = cli(*common)
    assert code == 0
    assert "95 % interval" in out
    assert "by profile" not in out
    assert "only k0 + alpha beta" in out
    run = json.loads((tmp_path / "r" / "identification.json").read_text())["runs"][0]
    assert "profile" not in run
    assert run["parameters"][0]["low"] < run["parameters"][0]["value"] < run["parameters"][0]["high"]
    assert run["parameters"][2] == run["parameters"][2] | {"low": None, "determined": False}
    assert [d["name"] for d in run["derived"]][:1] == ["k0 + alpha beta"]
    assert run["identifiability"]["words"][0].startswith("at 4 mm only k0 + alpha beta")
    level = json.loads((tmp_path / "r" / "model.json").read_text())["levels"][0]["parameters"]
    assert level["c0"]["low"] == run["parameters"][0]["low"]
    assert "low" not in level["alpha"]
    model = mre_core.Model.load(tmp_path / "r" / "model.json")
    assert model.levels[0].intervals["c0"] == (level["c0"]["low"], level["c0"]["high"])
    assert mre_core.Model.from_dict(model.to_dict()) == model
    code, out, _ = cli(*common, "--profile", "--bootstrap", "20")
    assert code == 0
    assert "by profile" in out
    assert "by bootstrap" in out
    run = json.loads((tmp_path / "r" / "identification.json").read_text())["runs"][0]
    assert [p["name"] for p in run["profile"]] == list(SINH)
    assert run["bootstrap"]["replicates"] == 20
    assert len(run["bootstrap"]["intervals"]) == 9
    code, _, err = cli(*common, "--bootstrap", "0")
    assert code == 2
    assert "replicates is 0" in err


def test_identification_asks_for_every_run(sinh_4mm: Recording) -> None:
    found = mre_core.identify(sinh_4mm, "kelvin_voigt", seed=4)
    assert found.bootstrap(4)[0].seed == 4
    assert found.bootstrap(4, seed=9)[0].seed == 9
    assert [p.name for p in found.profile()[0]] == list(KELVIN_VOIGT)


def test_refits_of_a_model_without_shapes_over_a_changing_current() -> None:
    # Found by fuzzing: the refit of each replicate looked for shapes, of which there are none.
    t = np.arange(64) / 16
    x, current = np.sin(6 * t), np.linspace(0.0, 1.0, 64)
    recording = Recording(t, x, (2 + current) * x, current=current)
    problem = Problem(recording, "kelvin_voigt")
    found = mre_core.bootstrap(problem, mre_core.exact(problem).x, 3, seed=1)
    assert np.isfinite(found.replicates).all()
