"""What stands beside the base belongs to the device: it has the motion that a fixture leaves it."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from missing import NOISE, SINES, record
from mre_core import Effect, Level, Model, Recording
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]
from test_effects import SIZES

FLEXIBILITY = 1 / 60
"""mm/N."""
EARLY = 0.006
"""s."""
SINH = {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}
Series = NDArray[np.float64]
Beside = Callable[[Series, Series], Series]


def square(_x: Series, v: Series) -> Series:
    return np.asarray(0.006 * np.abs(v) * v)


def stop(x: Series, _v: Series) -> Series:
    return np.asarray(20 * np.sign(x) * np.maximum(np.abs(x) - 3, 0))


def behind_a_fixture(device: Recording, beside: Beside, noise: float = 0.0, seed: int = 0) -> Recording:
    """What is measured of a device in this motion: the fixture moves with it."""
    x, v = device.displacement, device.velocity
    force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + beside(x, v)
    rate = CubicSpline(device.time, force)(device.time, 1)
    measured = force + noise * np.random.default_rng(seed).normal(size=len(force))
    moved, speed = x + FLEXIBILITY * force, v + FLEXIBILITY * rate
    return Recording(device.time, moved, measured, velocity=speed, name=device.name)


FIXTURE = Effect("rig_compliance", "spring in series", {"f_r": FLEXIBILITY})
HARD = 200.0
"""N/mm, fifteen times the device and three times the fixture."""


def hard_stop(x: Series, _v: Series) -> Series:
    return np.asarray(HARD * np.sign(x) * np.maximum(np.abs(x) - 3.5, 0))


LAWS = [
    (square, Effect("quadratic_damping", "square", {"c_2": 0.006})),
    (stop, Effect("end_stop", "both ends", {"k_c": 20.0, "g": 3.0})),
]


@pytest.mark.parametrize(
    ("beside", "effect"), [*LAWS, (hard_stop, Effect("end_stop", "both ends", {"k_c": HARD, "g": 3.5}))]
)
def test_an_effect_has_the_motion_that_a_fixture_leaves_the_device(beside: Beside, effect: Effect) -> None:
    seen = behind_a_fixture(record(1.0, 4.0), beside)
    model = Model("sinh", (Level(None, SINH),), effects=(effect, FIXTURE), sizes=SIZES)
    force = mre_core.simulate(model, seen)
    apart = force - np.asarray(seen.force)
    # Slopes by differences, and steps to the force that agrees with its motion.
    assert np.sqrt(np.mean(apart**2)) < 2e-3 * np.std(force)


@pytest.mark.parametrize(("beside", "effect"), LAWS)
def test_a_motion_that_is_shown_early_is_so_for_every_effect(beside: Beside, effect: Effect) -> None:
    device = record(1.0, 4.0)
    x, v = device.displacement, device.velocity
    force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + beside(x, v)
    shown = [CubicSpline(device.time, series)(device.time + EARLY) for series in (x, v)]
    seen = Recording(device.time, shown[0], force, velocity=shown[1])
    delay = Effect("time_delay", "pure delay of the motion", {"d": EARLY})
    model = Model("sinh", (Level(None, SINH),), effects=(effect, delay), sizes=SIZES)
    apart = (mre_core.simulate(model, seen) - force)[20:-20]
    assert np.sqrt(np.mean(apart**2)) < 2e-3 * np.std(force)


@pytest.mark.parametrize(
    ("law", "whole"), [("dead zone", False), ("dead zone without damping", True), ("play", True)]
)
def test_a_play_of_the_whole_device_is_one_of_all_that_stands_beside_it(law: str, whole: bool) -> None:
    seen = record(1.0, 4.0)
    cubic, play = Effect("cubic_stiffness", "cubic", {"k_3": 0.2}), Effect("backlash", law, {"g": 0.5})

    def force(*effects: Effect) -> Series:
        return mre_core.simulate(Model("sinh", (Level(None, SINH),), effects=effects, sizes=SIZES), seen)

    added = force(cubic, play) - force(play)
    x = seen.displacement
    moved = np.zeros(len(x))
    if law == "play":
        for i, value in enumerate(x[1:]):
            moved[i + 1] = np.clip(moved[i], value - 0.5, value + 0.5)
    else:
        moved = x - np.clip(x, -0.5, 0.5) if whole else x
    # Turns of a play are between samples.
    np.testing.assert_allclose(added, 0.2 * moved**3, atol=0.01 * np.ptp(added))
    np.testing.assert_array_equal(force(play, cubic), force(cubic, play))


def test_both_are_named_with_their_sizes() -> None:
    motions = [record(*sine) for sine in SINES]
    recordings = [behind_a_fixture(r, square, NOISE, seed) for seed, r in enumerate(motions)]
    found = mre_core.diagnose(recordings, "sinh", seed=1)
    assert found.verdict == "missing_physics"
    named = {effect.id: effect for effect in found.effects}
    assert set(named) == {"quadratic_damping", "rig_compliance"}
    assert all(effect.form == "exact" for effect in named.values())
    assert named["quadratic_damping"].parameters["c_2"].value == pytest.approx(0.006, rel=0.05)
    assert named["rig_compliance"].parameters["f_r"].value == pytest.approx(FLEXIBILITY, rel=0.05)
