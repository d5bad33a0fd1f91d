"""A velocity column that somebody made by differences of the displacement column, or smoothed."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mre_core import Model, Recording, _core, diagnose, identify
from mre_core.errors import VelocityWarning
from mre_core.model import Level
from numpy.typing import NDArray

Values = NDArray[np.float64]
Made = Callable[[Values, Values], Values]
RATE, NOISE = 128.0, 0.5
TRUTH = {"c0": 0.9, "k0": 12.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}


def central(x: Values, t: Values) -> Values:
    return np.gradient(x, t)


def backward(x: Values, t: Values) -> Values:
    return np.diff(x, prepend=x[0]) * RATE


def forward(x: Values, t: Values) -> Values:
    return np.diff(x, append=x[-1]) * RATE


def mean(x: Values, t: Values) -> Values:
    """Of nine differences."""
    return np.convolve(np.pad(np.gradient(x, t), 4, mode="edge"), np.ones(9) / 9, "valid")


def campaign(made: Made, *, felt: bool = False, drag: float = 0.0) -> list[Recording]:
    """Sines and a sweep to 8 Hz of a displacement in steps of 2 um; `felt`: the device sees what was made."""
    rng = np.random.default_rng(3)
    t = np.arange(1200) / RATE
    found = []
    phases = {
        "sine 1": (2.0, 2 * np.pi * t, np.full(t.size, 2 * np.pi)),
        "sine 3": (4.0, 6 * np.pi * t, np.full(t.size, 6 * np.pi)),
        "sweep": (3.0, np.pi * t * (0.4 + 0.8 * t), np.pi * (0.4 + 1.6 * t)),
    }
    for name, (amplitude, phase, rate) in phases.items():
        x = amplitude * np.sin(phase)
        given = made(np.round(x / 0.002) * 0.002, t)
        v = given if felt else amplitude * rate * np.cos(phase)
        force = 0.9 * v + 12 * x + 10 * np.sinh(0.3 * x) + drag * abs(v) * v + NOISE * rng.normal(size=t.size)
        found.append(Recording(t, np.round(x / 0.002) * 0.002, force, velocity=given, current=0.0, name=name))
    return found


@pytest.mark.parametrize("made", [central, backward, forward, mean])
def test_what_it_lacks_is_no_missing_physics(made: Made) -> None:
    found = diagnose(campaign(made), "sinh", seed=1)
    assert found.verdict == "adequate", found
    assert found.velocity_derived == ("sine 1", "sine 3", "sweep")
    assert "3 recordings is a difference quotient" in str(found)
    assert found.to_dict()["velocity_derived"] == ["sine 1", "sine 3", "sweep"]
    assert found.fit.noise_rms == pytest.approx(NOISE, rel=0.05)


def test_what_is_missing_is_found_beside_it() -> None:
    found = diagnose(campaign(central, drag=2e-3), "sinh", seed=1)
    (effect,) = found.effects
    assert (effect.id, effect.form) == ("quadratic_damping", "exact")
    assert found.velocity_derived == ("sine 1", "sine 3", "sweep")


@pytest.mark.parametrize(("of_displacement", "of_velocity"), [(0.003, 0.0), (0.0, 1.0), (0.003, 1.0)])
def test_noise_is_no_reason(of_displacement: float, of_velocity: float) -> None:
    rng = np.random.default_rng(7)
    t = np.arange(2000) / RATE
    x, v = np.zeros(t.size), np.zeros(t.size)
    for amplitude, w in ((4.0, 3.0), (2.0, 21.0), (0.5, 50.0)):
        x += amplitude * np.sin(w * t)
        v += amplitude * w * np.cos(w * t)
    x += of_displacement * rng.normal(size=t.size)
    v += of_velocity * rng.normal(size=t.size)
    assert _core.with_slopes([Recording(t, x, 12 * x, velocity=v)]) == [None]


def test_recordings_without_a_velocity_stay_as_they_are() -> None:
    first, *others = campaign(central)
    plain = Recording(first.time, first.displacement, first.force, current=0.0, name="plain")
    assert diagnose([plain, *others], "sinh", seed=1).velocity_derived == ("sine 3", "sweep")


@pytest.mark.parametrize("made", [central, backward, mean])
def test_a_simulation_whose_velocity_it_was_keeps_it(made: Made) -> None:
    found = diagnose(campaign(made, felt=True), "sinh", seed=1)
    assert (found.verdict, found.velocity_derived) == ("adequate", ())


def test_a_model_as_it_is_and_a_simulated_force() -> None:
    model = Model("sinh", (Level(0.0, TRUTH),), {"displacement_mm": 4.0, "velocity_mm_s": 160.0})
    found = diagnose(campaign(central), model, fixed=True, seed=1)
    assert (found.verdict, len(found.velocity_derived)) == ("adequate", 3)
    given = [
        Recording(r.time, r.displacement, r.force, velocity=r.velocity, simulated=r.force, name=r.name)
        for r in campaign(central)
    ]
    assert diagnose(given, "simulated", seed=1).velocity_derived == ()


def test_an_identification_warns_where_a_derived_velocity_fits_better() -> None:
    with pytest.warns(VelocityWarning, match="velocity of sine 1, sine 3, sweep is a difference quotient of"):
        biased = identify(campaign(backward), "sinh", optimizer="exact", seed=1)
    derived = [
        Recording(r.time, r.displacement, r.force, current=0.0, name=r.name) for r in campaign(backward)
    ]
    right = identify(derived, "sinh", optimizer="exact", seed=1)
    assert right.runs[0].rms == pytest.approx(NOISE, rel=0.05) and biased.runs[0].rms > 3 * NOISE
    assert right.model.levels[0].parameters["c0"] == pytest.approx(0.9, rel=0.01)
    identify(campaign(backward, felt=True), "sinh", optimizer="exact", seed=1)  # a warning would be an error


def test_the_command_says_it(tmp_path: Path, cli: Callable[..., tuple[int, str, str]]) -> None:
    files: list[Any] = []
    for recording in campaign(central):
        files.append(tmp_path / f"{recording.name}.csv")
        columns = (recording.time, recording.displacement, recording.velocity, recording.force)
        rows = np.column_stack([np.asarray(column) for column in columns])
        head = "time_s,displacement_mm,velocity_mm_s,force_N"
        np.savetxt(files[-1], rows, "%.6f", ",", header=head, comments="")
    options = ["--base", "sinh", "--set", "current=0[A]", "--seed", "1", "--out", tmp_path / "out"]
    status, out, _ = cli("diagnose", *files, *options)
    assert status == 0 and "it was derived anew" in " ".join(out.split())
    assert json.loads((tmp_path / "out" / "diagnosis.json").read_text())["verdict"] == "adequate"
