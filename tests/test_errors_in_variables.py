"""Noise of a displacement whose velocity is derived is no missing physics, and conceals no strong one."""

from collections.abc import Callable

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]

Force = Callable[[np.ndarray], np.ndarray]


def campaign(seed: int, more: Force = np.zeros_like) -> list[Recording]:
    """Four multisines on a Kelvin-Voigt device, mm and N: slow noise on the force, white on the motion."""
    rng = np.random.default_rng([41, seed])
    t = np.arange(1400) / 200
    recordings = []
    for k in range(4):
        turns = 2 * np.pi * rng.uniform(0.4, 4.5, 6)
        angles = rng.uniform(0, 2 * np.pi, 6)
        size = 8 / (1 + k) / 2
        x = size * sum(np.sin(turn * t + angle) for turn, angle in zip(turns, angles, strict=True))
        v = size * sum(turn * np.cos(turn * t + angle) for turn, angle in zip(turns, angles, strict=True))
        slow = 0.02 * lfilter([1], [1, -0.995], rng.normal(size=t.size + 3000))[3000:]
        force = 10 * x + 0.3 * v + more(x) + slow
        recordings.append(Recording(t, x + 0.01 * rng.normal(size=t.size), force, name=f"multisine {k}"))
    return recordings


@pytest.mark.parametrize("seed", range(10))
def test_noise_of_a_displacement_is_no_missing_physics(seed: int) -> None:
    found = diagnose(campaign(seed), base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_what_is_missing_beside_it_is_named_alone(seed: int) -> None:
    recordings = campaign(seed, lambda x: 1e-3 * x**3)
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics", found
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"], found
