"""A base model with laws over the current or the temperature is diagnosed with its laws."""

import mre_core
import numpy as np
import pytest
from mre_core import InputError, Model, Recording
from mre_core.current_laws.law import Dependence, Law
from mre_core.model import Level
from numpy.typing import NDArray
from rig import rms

RATE = 200.0
SINES = ((0.5, 6.0), (2.0, 4.0), (1.0, 8.0))
"""Hz and mm."""
ROOMS = (5.0, 23.0, 38.0)
K, C = 20.0, 0.8


def constant(value: float, at: float) -> Dependence:
    return Dependence(Law.of("constant", [at]), (value,))


def over_temperature() -> Model:
    laws = {
        "c0": constant(C, 5.0),
        "k0": Dependence(Law.of("quadratic", ROOMS), (1.1 * K, K, 0.98 * K)),
        "F0": constant(0.0, 5.0),
    }
    middle = {"c0": C, "k0": K, "F0": 0.0}
    return Model("kelvin_voigt", (Level(None, middle),), laws=laws, over="temperature")


def over_current() -> Model:
    law = Law.of("saturating", (0.0, 1.0, 2.0), 0.5)
    laws = {"c0": constant(C, 0.0), "k0": Dependence(law, (K, 2 * K)), "F0": constant(0.0, 0.0)}
    levels = tuple(Level(at, {name: float(laws[name].at(at)[0]) for name in laws}) for at in (0.0, 1.0, 2.0))
    return Model("kelvin_voigt", levels, laws=laws)


def swelling(hertz: float, amplitude: float, seconds: float = 12.0) -> list[NDArray[np.float64]]:
    """Time, displacement and velocity of a sine that begins slowly."""
    t = np.arange(round(seconds * RATE)) / RATE
    ramp, turn = np.clip(t, 0, 1), 2 * np.pi * hertz
    share, slope = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
    x = amplitude * share * np.sin(turn * t)
    return [t, x, amplitude * (slope * np.sin(turn * t) + share * turn * np.cos(turn * t))]


def noisy(force: NDArray[np.float64], *place: int) -> NDArray[np.float64]:
    size = 0.005 * float(force.std())
    return force + size * np.random.default_rng(place).normal(size=force.size)


def rooms(cubic: float = 0.0) -> list[Recording]:
    """Tests in three rooms; quadratic from 1.1 to 0.98 of the stiffness, and a cubic spring."""
    recordings = []
    for room in ROOMS:
        u = (room - ROOMS[0]) / (ROOMS[-1] - ROOMS[0])
        stiffness = K * (1.1 * (1 - u) * (1 - 2 * u) + 4 * u * (1 - u) + 0.98 * u * (2 * u - 1))
        for place, sine in enumerate(SINES):
            t, x, v = swelling(*sine)
            force = noisy(stiffness * x + C * v + cubic * x**3, int(room), place)
            name = f"{room:g}C_{place}"
            recordings.append(Recording(t, x, force, velocity=v, temperature=room, name=name))
    return recordings


def currents(*, cubic: float = 0.0) -> list[Recording]:
    """A current that goes up and down within each test; the stiffness saturates with it."""
    recordings = []
    for place, sine in enumerate(SINES):
        t, x, v = swelling(*sine)
        current = 1 - np.cos(2 * np.pi * t / (3.1 + place))
        stiffness = K * (1 + np.expm1(-current / 0.5) / np.expm1(-4.0))
        force = noisy(stiffness * x + C * v + cubic * x**3, 7, place)
        recordings.append(Recording(t, x, force, velocity=v, current=current, name=f"{place}"))
    return recordings


def test_kept_laws_leave_nothing() -> None:
    for model, recordings in ((over_temperature(), rooms()), (over_current(), currents())):
        found = mre_core.diagnose(recordings, model, fixed=True, seed=1)
        assert (found.verdict, found.effects) == ("adequate", ())
        assert found.base_model == model


@pytest.mark.parametrize("of", [rooms, currents])
def test_what_is_missing_beside_kept_laws_is_named_and_the_model_keeps_them(of: object) -> None:
    recordings = of(cubic=0.02)  # type: ignore[operator]
    model = over_temperature() if of is rooms else over_current()
    found = mre_core.diagnose(recordings, model, fixed=True, seed=1)
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"]
    assert (found.model.laws, found.model.over) == (model.laws, model.over)
    for recording in recordings:
        error = np.asarray(recording.force) - mre_core.simulate(found.model, recording)
        assert rms(error) < 0.007 * rms(np.asarray(recording.force))


def test_fitted_laws_over_the_temperature_are_free() -> None:
    found = mre_core.diagnose(rooms(cubic=0.02), over_temperature(), seed=1)
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"]
    assert found.model.over == "temperature"
    expected = over_temperature().laws["k0"].at(ROOMS)
    np.testing.assert_allclose(found.model.laws["k0"].at(ROOMS), expected, rtol=5e-3)


def test_laws_that_a_fit_would_not_follow_are_refused() -> None:
    with pytest.raises(
        InputError, match=r"the current changes within recording '0'.*wanted the base as it is"
    ):
        mre_core.diagnose(currents(), over_current(), seed=1)
    t, x, v = swelling(1.0, 4.0)
    warming = Recording(t, x, K * x, velocity=v, temperature=20 + t, name="warming")
    with pytest.raises(InputError, match="the temperature changes within recording 'warming'"):
        mre_core.diagnose(warming, over_temperature(), seed=1)
    two = [
        Recording(t, x, K * x + i, velocity=v, temperature=20.0, current=float(i), name=f"{i}")
        for i in range(2)
    ]
    with pytest.raises(InputError, match="laws over the temperature, and the recordings 2 currents"):
        mre_core.diagnose(two, over_temperature(), seed=1)
