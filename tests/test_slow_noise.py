"""1/f noise of the force in a few short recordings is no missing physics, and conceals no strong one."""

from collections.abc import Callable

import numpy as np
import pytest
from mre_core import Recording, diagnose

Force = Callable[[np.ndarray], np.ndarray]


def one_over_f(rng: np.random.Generator, count: int) -> np.ndarray:
    """Noise of unit rms whose power falls with the frequency, cut from a longer series."""
    turns = np.fft.rfft(rng.normal(size=4 * count))
    turns[1:] /= np.sqrt(np.arange(1, turns.size))
    noise = np.fft.irfft(turns)[:count]
    return noise / np.std(noise)


def campaign(seed: int, more: Force = np.zeros_like) -> list[Recording]:
    """Four sweeps of 8 s on a Kelvin-Voigt device, mm and N."""
    rng = np.random.default_rng([43, seed])
    t = np.arange(2400) / 300
    recordings = []
    for k in range(4):
        slow, fast = rng.uniform(0.3, 0.8), rng.uniform(2, 5)
        angle = 2 * np.pi * (slow * t + (fast - slow) * t**2 / 2 / t[-1]) + rng.uniform(0, 2 * np.pi)
        x = 8 / (1 + k) * np.sin(angle)
        v = 8 / (1 + k) * 2 * np.pi * (slow + (fast - slow) * t / t[-1]) * np.cos(angle)
        force = 10 * x + 0.3 * v + more(x) + 0.5 * one_over_f(rng, t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"sweep {k}"))
    return recordings


@pytest.mark.parametrize("seed", [0, 1, 2, 4, 36, 56])
def test_slow_noise_is_no_missing_physics(seed: int) -> None:
    found = diagnose(campaign(seed), base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_what_is_missing_beside_it_is_named_alone(seed: int) -> None:
    recordings = campaign(seed, lambda x: 1e-2 * x**3)
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics", found
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"], found
