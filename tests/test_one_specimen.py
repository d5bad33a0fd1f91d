"""Recordings that follow each other on one specimen: wear and Mullins softening go on, and are named so."""

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from mre_core import (
    Dependence,
    Effect,
    Law,
    Level,
    Model,
    MreError,
    Recording,
    diagnose,
    one_specimen,
    simulate,
)
from rig import Cli, rows_of, write_csv

NOISE = 0.5
TESTS = ((3, 0.5), (6, 0.5), (9, 1.0), (6, 1.0), (9, 0.5), (4, 2.0))
"""Amplitude in mm and frequency in Hz."""
Lost = Callable[[np.ndarray], np.ndarray]


def swelling(amplitude: float, frequency: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, displacement and velocity of a sine of 12 s that swells for 2 s from rest."""
    t = np.arange(2400) / 200
    rising = np.clip(t / 2, 0, 1)
    x = amplitude * rising**2 * (3 - 2 * rising) * np.sin(2 * np.pi * frequency * t)
    return t, x, np.gradient(x, t)


def worn(lost: Lost) -> list[Recording]:
    """Six sines one after the other; `lost` is the share of the stiffness over all displacements so far."""
    rng = np.random.default_rng([45, 0])
    so_far = np.zeros(0)
    recordings = []
    for amplitude, frequency in TESTS:
        t, x, v = swelling(amplitude, frequency)
        so_far = np.concatenate([so_far, x])
        force = 10 * x * (1 - lost(so_far)[-x.size :]) + 0.3 * v + NOISE * rng.normal(size=x.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"{amplitude} mm {frequency} Hz"))
    return recordings


def by_path(x: np.ndarray) -> np.ndarray:
    """A quarter is lost in the end, 63 % of it after 600 mm."""
    path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(x)))])
    return 0.25 * -np.expm1(-path / 600)


def by_largest(x: np.ndarray) -> np.ndarray:
    """A fifth is lost in the end, 63 % of it at 4 mm."""
    return 0.2 * -np.expm1(-np.maximum.accumulate(np.abs(x)) / 4)


@pytest.mark.parametrize(
    ("lost", "effect", "law", "wanted"),
    [
        (by_path, "cyclic_degradation", "path, saturating, stiffness", {"s": 0.25, "P_c": 600}),
        (by_largest, "mullins_softening", "largest strain, stiffness", {"s": 0.2, "x_c": 4}),
    ],
)
def test_what_goes_on_is_named(lost: Lost, effect: str, law: str, wanted: dict[str, float]) -> None:
    recordings = worn(lost)
    found = diagnose(one_specimen(recordings), "kelvin_voigt", seed=1)
    assert [(e.id, e.law, e.indistinguishable_from) for e in found.effects] == [(effect, law, ())], found
    assert found.verdict == "missing_physics"
    assert found.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.03)
    named = {name: p.value for name, p in found.effects[0].parameters.items()}
    assert named == pytest.approx(wanted, rel=0.05)
    for recording, history in zip(one_specimen(recordings), found.histories, strict=True):
        np.testing.assert_allclose(simulate(found.model, recording), history.final, rtol=1e-9, atol=1e-9)
    assert str(found).endswith("follow each other on one specimen.")
    virgin = diagnose(recordings, "kelvin_voigt", seed=1)
    assert "specimen" not in str(virgin)
    assert virgin.verdict == "partly_explained", virgin


def test_nothing_goes_on_where_nothing_is_missing() -> None:
    recordings = worn(np.zeros_like)
    given, told = (diagnose(each, "kelvin_voigt", seed=1) for each in (recordings, one_specimen(recordings)))
    assert given.verdict == told.verdict == "adequate"


@pytest.mark.parametrize(
    ("id", "law", "parameters"),
    [
        ("cyclic_degradation", "path, whole force", {"s": 0.3}),
        ("cyclic_degradation", "strokes, hyperbolic, stiffness", {"s": 0.5, "E_c": 300.0}),
        ("cyclic_degradation", "energy, saturating, stiffness", {"s": 0.4, "E_c": 4000.0}),
        ("cyclic_degradation", "dissipated energy, saturating, stiffness", {"s": 0.4, "E_c": 800.0}),
        ("cyclic_degradation", "viscous heat, stiffness", {"s": 0.4}),
        ("mullins_softening", "Ogden-Roxburgh, stiffness", {"s": 0.4, "x_m": 2.0, "b": 0.1}),
        ("creep", "ageing by a power, stiffness", {"p": 0.3, "t_0": 0.5}),
        ("creep", "ageing to an end, stiffness", {"s": 0.4, "tau_a": 5.0}),
    ],
)
def test_a_recording_in_two_parts_is_the_whole(id: str, law: str, parameters: dict[str, float]) -> None:
    sizes = {
        "displacement": 9.0, "velocity": 60.0, "force": 100.0, "step": 0.005, "duration": 12.0, "total": 12.0,
        "path": 220.0, "energy": 1.2e4, "dissipated": 900.0,
    }  # fmt: skip
    model = Model("kelvin_voigt", (Level(None, {"k0": 10.0, "c0": 0.3, "F0": 0.0}),))
    t, x, v = swelling(9, 0.5)
    whole = Recording(t, x, simulate(model, Recording(t, x, None, velocity=v)), velocity=v)
    first, last = whole.cut(stop=t[1350]), whole.cut(start=t[1350])
    wearing = Model("kelvin_voigt", model.levels, effects=(Effect(id, law, parameters),), sizes=sizes)
    wanted = simulate(wearing, whole)
    np.testing.assert_allclose(simulate(wearing, first), wanted[:1351], rtol=1e-9)
    np.testing.assert_allclose(simulate(wearing, last.after([first])), wanted[1350:], rtol=1e-9)
    assert not np.allclose(simulate(wearing, last), wanted[1350:], rtol=1e-3)
    (told,) = one_specimen([whole])
    np.testing.assert_allclose(simulate(wearing, told.cut(start=t[1350])), wanted[1350:], rtol=1e-9)


def test_the_past_of_a_sine_is_its_closed_form() -> None:
    t = np.arange(4001) / 1000
    turn = 2 * np.pi * t
    x, v = 5 * np.sin(turn), 10 * np.pi * np.cos(turn)
    sine = Recording(t, x, 8 * x + 0.4 * v, velocity=v)
    first, second, third = one_specimen([sine, sine, sine])
    assert sine.past is None
    assert first.past is not None and not any(first.past.values())
    stored, heat = 4 * 4 * 0.5 * 25, 4 * 0.5 * (10 * np.pi) ** 2
    path, dissipated = 4 * 4 * 5, 0.4 * heat
    assert second.past is not None and third.past is not None
    wanted = {"time": 4, "displacement": 5, "path": path, "strokes": stored, "heat": heat}
    wanted["stayed"] = dissipated
    assert {name: second.past[name] for name in wanted} == pytest.approx(wanted, rel=3e-5)
    assert second.past["energy"] > second.past["dissipated"] >= second.past["stayed"]
    twice = {name: 2 * value for name, value in second.past.items()}
    most = {"displacement": 5, "dissipated": second.past["stayed"] + second.past["dissipated"]}
    assert third.past == pytest.approx(twice | most, rel=1e-9)
    assert pickle.loads(pickle.dumps(third)).past == third.past
    assert third.cut(stop=3).past == third.past
    cut = third.cut(start=2).past
    assert cut is not None and cut["path"] == pytest.approx(2.5 * path, rel=3e-5)
    assert sine.after([second]).past == third.past
    assert [r.past for r in one_specimen([second, sine])] == [second.past, third.past]


def test_a_specimen_at_rest_goes_nowhere() -> None:
    t, x, v = swelling(3, 1)
    noise = np.random.default_rng(3).normal(size=(2, 12 * t.size))
    rest = np.zeros(11 * t.size)
    x, v = np.concatenate([x, rest]), np.concatenate([v, rest])
    t = np.arange(x.size) / 200
    clean, noisy = (
        Recording(t, x, x, velocity=v + size * noise[1]).after(
            [Recording(t, x, x, velocity=v + size * noise[1])]
        )
        for size in (0.0, 0.5)
    )
    assert clean.past is not None and noisy.past is not None
    assert noisy.past["path"] == pytest.approx(clean.past["path"], rel=0.15)


def test_heat_does_not_go_on() -> None:
    """A specimen cools between its recordings: what heat may take is the same in each."""
    rng = np.random.default_rng(2)
    recordings = []
    for amplitude, frequency in (*TESTS, *TESTS):
        t, x, v = swelling(amplitude, frequency)
        heat = np.cumsum(v**2) / 200
        force = 10 * x * (1 - 0.35 * heat / 9000) + 0.3 * v + NOISE * rng.normal(size=x.size)
        recordings.append(Recording(t, x, force, velocity=v))
    for told in (recordings, one_specimen(recordings)):
        found = diagnose(told, "kelvin_voigt", seed=1)
        assert found.effects[0].id in {"thermal_softening", "cyclic_degradation"}, found
        assert found.effects[0].law.startswith("viscous heat"), found
        assert found.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.03)
    assert found.effects[0].id == "thermal_softening"


def test_a_model_over_the_temperature_knows_the_past() -> None:
    t, x, v = swelling(6, 0.5)
    sizes = dict.fromkeys(
        ["displacement", "velocity", "force", "step", "duration", "total", "path", "energy"], 10.0
    )
    law = {
        name: Dependence(Law.of("constant", [1.0, 2.0]), (value,))
        for name, value in {"k0": 10.0, "c0": 0.3, "F0": 0.0}.items()
    }
    wear = Effect("cyclic_degradation", "path, saturating, stiffness", {"s": 0.4, "P_c": 100.0})
    first = Recording(t, x, 10 * x, velocity=v, temperature=20 + t, current=1 + t / 10)
    last, forces = first.after([first]), []
    for over in ("current", "temperature"):
        model = Model(
            "kelvin_voigt", (Level(None, {"k0": 10.0, "c0": 0.3, "F0": 0.0}),), {}, (wear,), sizes, law, over
        )
        forces.append(simulate(model, last))
    np.testing.assert_allclose(forces[0], forces[1], rtol=1e-9)


def test_a_past_needs_a_force() -> None:
    t, x, v = swelling(3, 1)
    with pytest.raises(MreError, match=r"'run': no force: what it does to the specimen is not known"):
        one_specimen([Recording(t, x, None, velocity=v, name="run"), Recording(t, x, x, velocity=v)])


def test_at_the_command_line(cli: Cli, tmp_path: Path) -> None:
    paths = []
    for place, recording in enumerate(worn(by_path)):
        paths.append(tmp_path / f"{place}.csv")
        write_csv(paths[-1], recording)
    out = tmp_path / "out"
    options = ["--base", "kelvin_voigt", "--one-specimen", "--seed", "1", "--quiet", "--out", str(out)]
    assert cli("diagnose", *paths, *options) == (0, "", "")
    assert [e.id for e in Model.load(out / "model.json").effects] == ["cyclic_degradation"]
    assert "one_specimen = true" in (out / "settings.toml").read_text()
    last, earlier = paths[-1], [text for path in paths[:-1] for text in ("--after", str(path))]
    for after, file in (earlier, "worn.csv"), ([], "virgin.csv"):
        assert cli("simulate", out / "model.json", last, *after, "--out", tmp_path / file)[0] == 0
    predicted, virgin = (rows_of(tmp_path / file)[:, 1] for file in ("worn.csv", "virgin.csv"))
    measured = np.loadtxt(last, delimiter=",", skiprows=1)[:, 2]
    assert np.std(measured - predicted) == pytest.approx(NOISE, rel=0.05)
    assert np.std(measured - virgin) > 5 * NOISE
