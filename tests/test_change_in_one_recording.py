"""A spring that breaks in one of several recordings is no slow noise of that recording."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording

RATE, QUANTUM = 250.0, 6.5
SINES = ((5.0, 1.3), (15.0, 0.5), (15.0, 1.0), (9.0, 0.8), (15.0, 1.5))
"""mm and Hz; the second grows."""


def campaign(share: float, seed: int) -> list[Recording]:
    """Short sines and one that grows, on a stiffening spring that loses a share of its force there."""
    rng = np.random.default_rng([seed, 3])
    found = []
    for place, (amplitude, frequency) in enumerate(SINES):
        t = np.arange(1250) / RATE
        swell = t / t[-1] if place == 1 else np.minimum(t, 1)
        x = amplitude * swell * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        lost = share * np.clip((t - 1.8) / 0.1, 0, 1) if place == 1 else 0
        force = (1 - lost) * (9 * x + 20 * np.sinh(0.15 * x) + 0.5 * v)
        force = QUANTUM * np.round((force + 0.3 * rng.normal(size=t.size)) / QUANTUM)
        found.append(Recording(t, x, force, velocity=v, name=f"r{place}"))
    return found


@pytest.mark.parametrize("seed", range(2))
def test_the_jump_is_named(seed: int) -> None:
    found = mre_core.diagnose(campaign(0.1, seed), "sinh", seed=1)
    assert [effect.id for effect in found.effects] == ["stiffness_jump"], found.verdict


def test_without_it_nothing_is_missing() -> None:
    assert mre_core.diagnose(campaign(0.0, 2), "sinh", seed=1).verdict == "adequate"
