"""A coefficient that stands at its limit on the way of a fit does not keep the shapes where they are."""

import mre_core
import numpy as np
import pytest
from mre_core import Effect, Level, Model, Recording
from numpy.typing import NDArray
from test_effects import SIZES

RATE = 200.0
SINES = ((0.5, 4.0), (1.0, 2.0), (2.0, 4.0), (3.0, 3.0), (1.0, 4.0))
"""Hz and mm."""
SINH = {"c0": 0.3, "k0": 5.0, "alpha": 8.0, "beta": 0.3, "F0": 0.0}
FIXTURE = Effect("rig_compliance", "spring in series", {"f_r": 0.02})
CREEP = Effect("creep", "logarithmic", {"k_c": 1.5, "t_0": 0.1})


def wave(place: int) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Time, displacement and velocity of a sine that begins slowly; the last one waxes and wanes."""
    hertz, amplitude = SINES[place]
    t = np.arange(2400) / RATE
    ramp, turn = np.clip(t, 0, 1), 2 * np.pi * hertz
    size, growth = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
    if place == len(SINES) - 1:
        size = size * (0.5 + 0.5 * np.sin(2 * np.pi * t / 7) ** 2)
        growth = np.gradient(size, t)
    x = amplitude * size * np.sin(turn * t)
    return t, x, amplitude * (growth * np.sin(turn * t) + size * turn * np.cos(turn * t))


def model(effect: Effect) -> Model:
    return Model("sinh", (Level(None, SINH),), effects=(effect,), sizes=SIZES)


def campaign(effect: Effect, seed: int) -> list[Recording]:
    """Recordings of the device with the effect, and white noise of 1 %."""
    rng, recordings = np.random.default_rng([seed, 7]), []
    for place in range(len(SINES)):
        t, x, v = wave(place)
        force = mre_core.simulate(model(effect), Recording(t, x, None, velocity=v))
        force = force + 0.01 * force.std() * rng.normal(size=t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"{place}"))
    return recordings


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_base_with_a_fixture_is_fitted_again(seed: int) -> None:
    # Before the fixture is seen k0 is at zero, and alpha and beta do with less hardening.
    found = mre_core.diagnose(campaign(FIXTURE, seed), model(FIXTURE), seed=1)
    assert (found.verdict, found.effects) == ("adequate", ())
    assert found.base_model.effects[0].parameters["f_r"] == pytest.approx(0.02, rel=0.02)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_creep_beside_a_base_that_bends_to_it(seed: int) -> None:
    found = mre_core.diagnose(campaign(CREEP, seed), "sinh", seed=1)
    assert [effect.id for effect in found.effects] == ["creep"]
