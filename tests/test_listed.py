"""An effect is named or listed if any law of its fits as well as the best, or better by more than chance."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording
from mre_core.next_test import command
from rig import slow
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]
from scipy.signal import butter, lfilter  # type: ignore[import-untyped]

RATE, FINE = 200, 10

Device = Callable[[np.ndarray, np.ndarray], np.ndarray]


def moved(seed: int, highest: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sines that swell from rest, at ten times the rate of recordings: time, displacement, velocity."""
    rng = np.random.default_rng([seed, 1])
    t = np.arange(0.0, 8.0, 1 / (RATE * FINE))
    x = np.zeros_like(t)
    for frequency in rng.uniform(0.3, highest, 6):
        x += np.sin(2 * np.pi * frequency * t + rng.uniform(0, 2 * np.pi)) / frequency**0.5
    x *= np.sin(np.pi * np.clip(t / 4.0, 0.0, 0.5)) ** 2
    x *= 5.0 / np.abs(x).max()
    return t, x, np.gradient(x, t, edge_order=2)


def filtered(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A spring and a dashpot, their force through a filter of second order."""
    b, a = butter(2, 65.0, fs=RATE * FINE)
    force: np.ndarray = lfilter(b, a, 12.0 * x + 0.15 * v)
    return force


def relaxing(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A spring, a dashpot and two Maxwell branches."""
    force = 6.0 * x + 0.3 * v
    for tau in (0.17, 1.1):
        decay = np.exp(-1 / (RATE * FINE * tau))
        force = force + 0.6 * tau * lfilter([1 - decay], [1, -decay], v)
    return force


def dragging(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A spring, a dashpot and dry friction that is reached over a displacement (Dahl)."""
    z = np.zeros_like(x)
    for i, dx in enumerate(np.diff(x)):
        end = np.sign(dx)
        z[i + 1] = end + (z[i] - end) * np.exp(-abs(dx) / 0.03)
    force: np.ndarray = 6.0 * x + 0.3 * v + 1.5 * z
    return force


def moving_a_mass(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """A spring, a dashpot and a mass on a lever, the more the further it moves."""
    force: np.ndarray = 6.0 * x + 0.3 * v + (0.004 + 0.00024 * x**2) * np.gradient(v, 1 / (RATE * FINE))
    return force


def recorded(
    device: Device, motion: tuple[np.ndarray, np.ndarray, np.ndarray], noise: np.ndarray, name: str
) -> Recording:
    """A motion at ten times the rate, and the force of the device with noise."""
    t, x, v = motion
    force = device(x, v)[::FINE] + noise
    return Recording(t[::FINE], x[::FINE], force, velocity=v[::FINE], name=name)


def campaign(device: Device, *, highest: float, noise: float, memory: float, seed: int) -> list[Recording]:
    """Four recordings of 8 s."""
    found = []
    for k in range(4):
        motion = moved(10 * seed + k, highest)
        rest = noise * slow(np.random.default_rng([seed, k]), len(motion[0][::FINE]), memory)
        found.append(recorded(device, motion, rest, f"r{k}"))
    return found


def in_the_place_of_one(
    device: Device, *, highest: float, noise: float, memory: float, seed: int
) -> set[str]:
    """The one effect named, and those that are not told from it."""
    recordings = campaign(device, highest=highest, noise=noise, memory=memory, seed=seed)
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics"
    (effect,) = found.effects
    return {effect.id, *effect.indistinguishable_from}


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_a_law_that_is_not_among_the_first_of_its_effect(seed: int) -> None:
    """Filters of first order fit worse than a delay by far, and the one of second order as well or better."""
    assert "filter_lag" in in_the_place_of_one(filtered, highest=8.0, noise=0.07, memory=0.97, seed=seed)


def test_a_law_with_more_parameters_that_fits_better() -> None:
    """Two branches fit better than a power law, if not by what two parameters more cost for a name."""
    assert "maxwell_relaxation" in in_the_place_of_one(relaxing, highest=2.0, noise=0.2, memory=0.9, seed=2)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_larger_form_of_the_one_named_is_no_other_effect(seed: int) -> None:
    """Friction that falls with the speed by nothing fits as well as one that does not, and is the same."""
    named = in_the_place_of_one(dragging, highest=2.0, noise=0.2, memory=0.0, seed=seed)
    assert named == {"coulomb_friction"}


def beside(found: Diagnosis, effect: str) -> tuple[str, ...]:
    """Effects that are not told from one that was named."""
    (others,) = [one.indistinguishable_from for one in found.effects if one.id == effect]
    return others


def test_a_test_is_proposed_where_no_law_is_exact_and_tells() -> None:
    """A delay is nearly as good as a mass that grows, as long as neither is exact."""
    recordings = campaign(moving_a_mass, highest=1.5, noise=0.07, memory=0.0, seed=6)
    before = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    assert beside(before, "inertia") == ("time_delay",)
    proposed = before.next_test
    assert proposed is not None
    assert "time_delay" in proposed["separates"] and proposed["leaves"]["inertia"] == []

    signal = command(proposed)
    t = np.arange(0.0, signal.time[-1], 1 / (RATE * FINE))
    x = CubicSpline(signal.time, signal.displacement)
    noise = 0.07 * np.random.default_rng(9).standard_normal(len(t[::FINE]))
    test = recorded(moving_a_mass, (t, x(t), x(t, 1)), noise, "test")
    assert beside(mre_core.diagnose([*recordings, test], "kelvin_voigt", seed=1), "inertia") == ()
