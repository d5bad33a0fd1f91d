"""A mismatch that looks like noise, but not everywhere: noise does not know the motion."""

import numpy as np
import pytest
from mre_core import Diagnosis, Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]

RATE, SECONDS, FREQUENCY, CHANGE = 500.0, 15.0, 2.5, 0.17
LENGTH = 0.06
"""Of the ripple, mm: a sixteenth of the largest displacement."""


def beating(ripple: float, seed: int) -> Diagnosis:
    """A sine of changing amplitude on a spring and a dashpot, with a ripple (N) over the displacement."""
    rng = np.random.default_rng([seed, 41])
    t = np.arange(round(RATE * SECONDS)) / RATE
    ramp = np.clip(t, 0, 1)
    amplitude = ramp**2 * (3 - 2 * ramp) * (0.55 + 0.45 * np.sin(2 * np.pi * CHANGE * t))
    x = amplitude * np.sin(2 * np.pi * FREQUENCY * t)
    v = np.gradient(x, t)
    slow = lfilter([np.sqrt(1 - 0.95**2)], [1, -0.95], rng.normal(size=t.size))
    noise = 0.05 * slow + 0.02 * rng.normal(size=t.size)
    force = 10 * x + 0.1 * v + ripple * np.sin(2 * np.pi * x / LENGTH) + noise
    return diagnose(Recording(t, x, force, velocity=v, name="beats"), base="kelvin_voigt", seed=1)


@pytest.mark.parametrize("seed", range(2))
def test_a_ripple_that_passes_for_noise_is_unexplained(seed: int) -> None:
    found = beating(0.08, seed)
    assert found.verdict == "unexplained", found
    assert found.unknown is not None
    assert found.unknown["p_even"] < 1e-6
    assert "What looks like noise is larger at some displacements" in found.unknown["statement"]


@pytest.mark.parametrize("seed", range(4))
def test_noise_alone_is_adequate(seed: int) -> None:
    assert beating(0.0, seed).verdict == "adequate"


@pytest.mark.parametrize("seed", range(3))
def test_noise_that_grows_with_the_speed_is_adequate_and_told(seed: int) -> None:
    """As that of a sensor may: its size follows the motion, and its neighbours do not go together."""
    rng = np.random.default_rng([seed, 43])
    recordings = []
    for frequency, amplitude in ((0.7, 4.0), (1.6, 6.0), (2.9, 5.0)):
        t = np.arange(3000) / 200
        x = amplitude * np.clip(t, 0, 1) * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        coloured = lfilter([0.8], [1, -0.6], rng.normal(size=t.size))
        force = 10 * x + 0.3 * v + 0.4 * (1 + 2 * np.abs(v) / np.abs(v).max()) * coloured
        recordings.append(Recording(t, x, force, velocity=v, name=f"{frequency} Hz"))
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
    assert found.p_values["even"] < 1e-6
    assert "The noise is larger at some displacements" in str(found)


def test_clipped_samples_are_no_quiet_noise() -> None:
    """Noise before the channel that clips: of a clipped sample nothing is left."""
    recordings = []
    for k, (frequency, amplitude) in enumerate(((0.7, 4.0), (1.6, 6.0), (2.9, 5.0))):
        rng = np.random.default_rng([k, 77])
        t = np.arange(3000) / 200
        x = amplitude * np.clip(t, 0, 1) * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        force = np.clip(10 * x + 0.3 * v + 0.5 * rng.normal(size=t.size), -35, 35)
        recordings.append(Recording(t, x, force, velocity=v, name=f"{frequency} Hz"))
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert (found.verdict, [e.id for e in found.effects]) == ("missing_physics", ["force_clipping"]), found
