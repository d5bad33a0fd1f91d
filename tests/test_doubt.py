"""What a diagnosis admits: physics of no catalogue, effects ruled out, and what to test next."""

import json
from itertools import permutations
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pytest
from missing import SINES, campaign, record, with_series, write_all
from mre_core import InputError, Recording, _core, words
from mre_core.cli.main import main
from mre_core.next_test import command, read_proposal
from mre_core.told_apart import check

STROKE = max(amplitude for _, amplitude in SINES)


def bumpy(recordings: list[Recording]) -> list[Recording]:
    """A force at one position, in one direction only."""

    def of(r: Recording) -> Recording:
        bump = 4.0 * np.exp(-(((r.displacement - 1.5) / 0.3) ** 2)) * (r.velocity > 0)
        return with_series(r, force=np.asarray(r.force) + bump)

    return [of(r) for r in recordings]


@pytest.fixture(scope="module")
def bump() -> mre_core.Diagnosis:
    return mre_core.diagnose(bumpy(campaign(0.0)[::2]), seed=1)


def test_physics_of_no_catalogue_is_admitted(bump: mre_core.Diagnosis) -> None:
    assert bump.verdict == "unexplained"
    assert bump.effects == ()
    assert bump.unknown is not None
    assert {d["on"] for d in bump.unknown["depends_on"]} & {"displacement", "state"}
    assert bump.unknown["statement"].endswith(".")
    assert bump.model.to_dict() == bump.base_model.to_dict()


def test_the_map_shows_where_the_bump_is(bump: mre_core.Diagnosis) -> None:
    assert bump.unknown is not None
    shape = bump.unknown["map"]
    force = np.array(shape["force_N"], dtype=float)
    up = np.array(shape["v_mm_s"]) > 0
    x = np.array(shape["x_mm"])
    row = np.nanmax(np.where(np.isnan(force[up]), -np.inf, force[up]), axis=0)
    assert abs(x[np.argmax(row)] - 1.5) < 2 * STROKE / 12
    assert 0.2 < bump.unknown["odd"] < 0.9


def test_an_effect_that_is_ruled_out_is_not_named() -> None:
    found = mre_core.diagnose(campaign()[::2], seed=1, without=["maxwell_relaxation"])
    assert "maxwell_relaxation" not in {e.id for e in found.effects}
    assert found.verdict != "adequate"
    with pytest.raises(InputError, match="without is 'maxwel'"):
        mre_core.diagnose(campaign(), without=["maxwel"])


@pytest.fixture(scope="module")
def one_frequency() -> mre_core.Diagnosis:
    steady = [record(1.0, amplitude, seed=i) for i, amplitude in enumerate((1.0, 2.0, 4.0))]
    steady = [r.cut(3.0, 11.0) for r in steady]
    return mre_core.diagnose(steady, "sinh", seed=1)


def test_one_frequency_hides_inertia_and_a_test_is_proposed(one_frequency: mre_core.Diagnosis) -> None:
    assert {"inertia", "maxwell_relaxation"} <= set(one_frequency.absorbed)
    proposal = one_frequency.next_test
    assert proposal is not None
    assert {"inertia", "maxwell_relaxation"} <= set(proposal["separates"])
    assert all(0 <= chance <= 1 for chance in proposal["chances"].values())
    worth = [sum(p["chances"].values()) for p in [proposal, *proposal["others"]]]
    assert worth[0] >= max(worth) - 0.1


def steady_filtered(frequency: float, amplitude: float) -> Recording:
    """Spring and dashpot through a filter of the first order, which are just as well a spring in series."""
    rng = np.random.default_rng(round(10 * frequency))
    time = np.arange(0, 10, 0.01)
    turn = 2j * np.pi * frequency
    phasor = amplitude * np.exp(turn * time)
    force = np.imag((5.0 + 0.4 * turn) / (1 + 0.01 * turn) * phasor)
    force += 0.005 * np.abs(force).max() * rng.normal(size=len(time))
    velocity = np.imag(turn * phasor)
    return Recording(time, np.imag(phasor), force, velocity=velocity, name=f"{frequency:g} Hz")


def test_what_no_motion_tells_comes_with_what_else_would(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = write_all(tmp_path, [steady_filtered(*sine) for sine in ((0.5, 5.0), (2.0, 3.0), (5.0, 1.0))])
    out = tmp_path / "result"
    assert (
        main(["diagnose", *map(str, files), "--base", "kelvin_voigt", "--out", str(out), "--seed", "1"]) == 0
    )
    (effect,) = json.loads((out / "diagnosis.json").read_text(encoding="utf-8"))["effects"]
    assert {effect["id"], *effect["no_test_tells"]} == {"filter_lag", "rig_compliance"}
    assert effect["checks"].keys() >= set(effect["no_test_tells"])
    said = " ".join(capsys.readouterr().out.split())
    assert (
        f"to tell it from {effect['no_test_tells'][0]}, measure the displacement between the plates" in said
    )


def test_what_else_tells_two_effects_apart() -> None:
    ids = {row["id"] for row in _core.catalogue()}
    told = {frozenset(pair): check(*pair) for pair in permutations(sorted(ids), 2)}
    assert all(told[frozenset(pair)] == check(*pair) for pair in permutations(sorted(ids), 2))
    with_one = {id for pair, how in told.items() if how is not None for id in pair}
    assert with_one == ids  # a fixture or a mass may be taken for anything
    for pair, how in (
        (("filter_lag", "rig_compliance"), "between the plates"),
        (("filter_lag", "inertia"), "weigh"),
        (("filter_lag", "time_delay"), "as fast as the machine can"),
        (("time_delay", "maxwell_relaxation"), "steel spring"),
        (("thermal_softening", "cyclic_degradation"), "hours of rest"),
        (("thermal_softening", "creep"), None),
    ):
        assert set(pair) <= ids
        found = told[frozenset(pair)]
        assert found is None if how is None else found is not None and how in found


@pytest.mark.parametrize("cut", [3.0, 3.1])
def test_one_frequency_hides_a_springpot_wherever_the_recordings_are_cut(cut: float) -> None:
    """In steady motion it is a spring and a dashpot; its memory of what was before is no trace of it."""
    steady = [record(1.0, amplitude, seed=i).cut(cut, 11.0) for i, amplitude in enumerate((1.0, 2.0, 4.0))]
    found = mre_core.diagnose(steady, "sinh", seed=1)
    assert "fractional_viscoelasticity" in found.absorbed


def test_the_command_keeps_its_limits(one_frequency: mre_core.Diagnosis) -> None:
    assert one_frequency.next_test is not None
    signal = command(one_frequency.next_test, stroke=1.5, speed=10.0, duration=20.0)
    assert np.abs(signal.displacement).max() <= 1.5 + 1e-9
    assert np.abs(np.diff(signal.displacement) / np.diff(signal.time)).max() <= 10 + 1e-6
    assert signal.time[-1] == pytest.approx(20.0, abs=0.02)
    refused: list[dict[str, Any]] = [{"stroke": -1.0}, {"rate": 1.0}, {"duration": 0.01}, {"current": (2, 1)}]
    for wrong in refused:
        with pytest.raises(InputError):
            command(one_frequency.next_test, **wrong)


def test_a_test_is_proposed_within_the_limits_given(tmp_path: Path) -> None:
    """The best of what the machine can do, which may be faster than what was tested."""
    files = write_all(
        tmp_path, [record(1.0, 4.0, name="a").cut(3.0, 11.0), record(1.0, 2.0, name="b").cut(3.0, 11.0)]
    )
    out = tmp_path / "result"
    given = [*map(str, files), "--base", "sinh", "--out", str(out), "--seed", "1", "--quiet"]
    limits = {"stroke": 3.0, "speed": 20.0, "highest": 8.0, "duration": 12.0}
    own = [word for name, value in limits.items() for word in ("--limit", f"{name}={value}")]
    assert main(["diagnose", *given, *own]) == 0
    proposal = read_proposal(out)
    for name, value in zip(
        ("stroke_mm", "speed_mm_s", "highest_hz", "duration_s"), limits.values(), strict=True
    ):
        assert proposal["limits"][name] == value
    signal = command(proposal)
    assert np.abs(signal.displacement).max() <= 3.0 + 1e-9
    assert np.abs(np.diff(signal.displacement) / np.diff(signal.time)).max() <= 20 + 1e-6
    assert signal.time[-1] == pytest.approx(12.0, abs=0.02)
    for kind in (proposal, *proposal["others"]):
        assert kind["frequency_hz"] <= 8.0


def test_next_test_from_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    files = write_all(
        tmp_path, [record(1.0, 4.0, name="a").cut(3.0, 11.0), record(1.0, 2.0, name="b").cut(3.0, 11.0)]
    )
    out = tmp_path / "result"
    given = [str(f) for f in files]
    assert main(["diagnose", *given, "--base", "sinh", "--out", str(out), "--seed", "1", "--quiet"]) == 0
    assert main(["next-test", str(out), "--out", str(tmp_path / "command.csv")]) == 0
    assert "inertia" in capsys.readouterr().out
    signal = pd.read_csv(tmp_path / "command.csv")
    assert list(signal.columns)[:2] == ["time_s", "displacement_mm"]
    assert np.isfinite(signal.to_numpy()).all()
    assert main(["next-test", str(tmp_path), "--out", str(tmp_path / "other.csv")]) == 2
    assert not (tmp_path / "other.csv").exists()
    assert "diagnosis.json" in capsys.readouterr().err


def test_words_of_the_unknown() -> None:
    found = {"depends_on": [{"on": "memory", "size": 0.2, "share": 0.9}], "odd": 0.95, "dissipative": 0.1}
    sentence = words.unknown(found | {"rms_N": 1.5}, ["creep"])
    for piece in ("1.5 N", "the motion of the last 0.2 s", "odd", "stores energy", "creep"):
        assert piece in sentence
