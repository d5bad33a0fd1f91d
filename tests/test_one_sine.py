"""One short sine: its harmonics are lines, and still no noise where they follow the motion."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording
from rig import made_of

RATE, FREQUENCY, AMPLITUDE, CYCLES = 1000.0, 1.5, 16.0, 7
NOISE = 4.0
DEVICE = made_of("kelvin_voigt", {"c0": 0.2, "k0": 28.0, "F0": 3.0})

Force = Callable[[Recording], np.ndarray]


def diagnosed(further: Force, seed: int) -> Diagnosis:
    """A spring and a dashpot and a further force in a sine that begins at its end."""
    t = np.arange(0.0, CYCLES / FREQUENCY, 1 / RATE)
    turn = 2 * np.pi * FREQUENCY
    x, v = -AMPLITUDE * np.cos(turn * t), AMPLITUDE * turn * np.sin(turn * t)
    motion = Recording(t, x, np.zeros_like(t), velocity=v)
    force = mre_core.simulate(DEVICE, motion) + further(motion)
    force = force + NOISE * np.random.default_rng(seed).normal(size=len(t))
    return mre_core.diagnose([Recording(t, x, force, velocity=v)], "kelvin_voigt", seed=1)


@pytest.mark.parametrize("seed", [1, 2])
def test_damping_that_goes_with_the_displacement_is_no_noise(seed: int) -> None:
    # A line at twice the frequency, three times the noise: an autoregression predicts it like a narrow band.
    turn = 2 * np.pi * FREQUENCY
    found = diagnosed(lambda r: 24.0 * r.displacement * r.velocity / (AMPLITUDE**2 * turn), seed)
    assert found.verdict == "unexplained"
    assert found.p_values["base"] < 1e-6
    assert found.unknown is not None
    assert found.unknown["depends_on"][0]["on"] in ("state", "velocity")


@pytest.mark.parametrize("seed", [1, 2])
def test_a_spring_that_hardens_is_named_by_its_third_multiple(seed: int) -> None:
    found = diagnosed(lambda r: 0.012 * r.displacement**3, seed)
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"]


def resonance(seed: int, frequency: float, size: float) -> Force:
    """A narrow band of noise about a frequency, of a size beside white noise."""

    def force(r: Recording) -> np.ndarray:
        turn, damping = 2 * np.pi * frequency / RATE, 0.998
        found, shocks = np.zeros(len(r) + 2000), np.random.default_rng(seed).normal(size=len(r) + 2000)
        for i in range(2, len(found)):
            found[i] = 2 * damping * np.cos(turn) * found[i - 1] - damping**2 * found[i - 2] + shocks[i]
        return np.asarray(size * NOISE * found[2000:] / np.std(found))

    return force


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize(("multiple", "size"), [(1.9, 3.0), (2.0, 1.0), (2.0, 3.0), (3.0, 1.0)])
def test_a_narrow_band_near_a_multiple_is_noise(seed: int, multiple: float, size: float) -> None:
    assert diagnosed(resonance(100 + seed, multiple * FREQUENCY, size), seed).verdict == "adequate"
