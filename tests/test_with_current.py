"""Effects that follow the coil current, and a base whose current law has the wrong form."""

import mre_core
import numpy as np
import pytest
from mre_core import Level, Model, Recording, simulate
from rig import made_of

NOISE = 0.01


def swept(rate: float = 100.0, seconds: float = 24.0, amplitude: float = 5.0) -> Recording:
    """A sweep that swells from rest and shrinks again, with its true velocity."""
    t = np.arange(0.0, seconds, 1 / rate)
    turn, fast = 2 * np.pi * (0.3 + 0.04 * t) * t, 2 * np.pi * (0.3 + 0.08 * t)
    swell, growth = np.sin(np.pi * t / seconds), np.pi / seconds * np.cos(np.pi * t / seconds)
    velocity = amplitude * (growth * np.sin(turn) + swell * np.cos(turn) * fast)
    return Recording(t, amplitude * swell * np.sin(turn), np.zeros_like(t), velocity=velocity)


def measured(force: np.ndarray, moved: Recording, current: float, seed: int) -> Recording:
    noise = NOISE * np.std(force) * np.random.default_rng(seed).normal(size=len(force))
    return Recording(
        moved.time,
        moved.displacement,
        force + noise,
        velocity=moved.velocity,
        current=current,
        name=f"{current} A, {seed}",
    )


def friction(moved: Recording) -> np.ndarray:
    """Dry friction of unit size with a pre-sliding displacement of 0.02 mm (Dahl 1968)."""
    z = np.zeros_like(moved.time)
    for i, step in enumerate(np.diff(moved.displacement), start=1):
        end = np.sign(step)
        z[i] = end + (z[i - 1] - end) * np.exp(-abs(step) / 0.02)
    return z


def campaign(sizes: dict[float, float]) -> list[Recording]:
    """A spring and a dashpot that follow the current, with friction of these sizes in N at these currents."""
    found = []
    for seed, (current, size) in enumerate(sizes.items()):
        base = made_of("kelvin_voigt", {"c0": 0.2 + 0.1 * current, "k0": 3.0 + current, "F0": 0.0})
        for copy, amplitude in enumerate((5.0, 3.0)):
            moved = swept(amplitude=amplitude)
            force = simulate(base, moved) + size * friction(moved)
            found.append(measured(force, moved, current, 10 * seed + copy))
    return found


def test_friction_that_follows_the_current() -> None:
    found = mre_core.diagnose(campaign({0.0: 1.0, 0.5: 2.0, 1.0: 3.0}), "kelvin_voigt", seed=1)
    assert [e.id for e in found.effects] == ["coulomb_friction"], found.verdict
    (effect,) = found.effects
    assert effect.law == "Dahl, with the current"
    assert abs(effect.parameters["F_c_low"].value - 1.0) < 0.02
    assert abs(effect.parameters["F_c_high"].value - 3.0) < 0.06
    # Between the levels the model of the file interpolates.
    between = swept(amplitude=4.0)
    seen = Recording(between.time, between.displacement, None, velocity=between.velocity, current=0.75)
    base = made_of("kelvin_voigt", {"c0": 0.275, "k0": 3.75, "F0": 0.0})
    truth = simulate(base, seen) + 2.5 * friction(seen)
    error = float(np.std(simulate(found.model, seen) - truth))
    assert error < 0.01 * np.std(truth), error


def test_a_springpot_that_follows_the_current() -> None:
    """Its derivative by the sum of Gruenwald and Letnikov."""
    order, recordings = 0.3, []
    for seed, (current, size) in enumerate({0.0: 0.5, 0.5: 1.0, 1.0: 1.5}.items()):
        base = made_of("kelvin_voigt", {"c0": 0.2 + 0.1 * current, "k0": 3.0 + current, "F0": 0.0})
        moved = swept()
        k = np.arange(1, len(moved))
        weights = np.concatenate([[1.0], np.cumprod((k - 1 - order) / k)])
        springpot = np.convolve(np.asarray(moved.displacement), weights)[: len(moved)] * 100.0**order
        recordings.append(measured(simulate(base, moved) + size * springpot, moved, current, seed))
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    (effect,) = found.effects
    assert (effect.id, effect.law) == ("fractional_viscoelasticity", "springpot, with the current")
    values = {name: p.value for name, p in effect.parameters.items()}
    assert values == pytest.approx({"c_a_low": 0.5, "c_a_high": 1.5, "a": order}, rel=0.1)


def test_friction_of_one_size_keeps_the_plain_law() -> None:
    found = mre_core.diagnose(campaign({0.0: 2.0, 0.5: 2.0, 1.0: 2.0}), "kelvin_voigt", seed=1)
    assert [e.id for e in found.effects] == ["coulomb_friction"], found.verdict
    assert "current" not in found.effects[0].law


def test_a_current_law_of_the_wrong_form() -> None:
    """A model between two levels is kept as it is; between them the device is stiffer than the chord."""
    moved, levels = swept(), {0.0: (0.2, 3.0), 0.5: (0.4, 6.5), 1.0: (0.5, 8.0)}
    tests = []
    for seed, (current, (c0, k0)) in enumerate(levels.items()):
        force = simulate(made_of("kelvin_voigt", {"c0": c0, "k0": k0, "F0": 0.0}), moved)
        tests.append(measured(force, moved, current, seed))
    ends = tuple(
        Level(current, {"c0": levels[current][0], "k0": levels[current][1], "F0": 0.0})
        for current in (0.0, 1.0)
    )
    found = mre_core.diagnose(tests, Model("kelvin_voigt", ends), fixed=True, seed=1)
    assert [e.id for e in found.effects] == ["field_dependence"], found.verdict
    assert found.verdict == "missing_physics"
    assert found.fit.held_out_rms_after < 1.1 * found.fit.noise_rms
