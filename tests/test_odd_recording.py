"""A change that one recording alone has is said, not taken for its noise."""

import numpy as np
import pytest
from mre_core import Diagnosis, Recording, diagnose

RATE, SECONDS = 200.0, 14.0
FREQUENCIES = (0.6, 1.1, 1.9, 2.8, 0.9)


def campaign(more: float, seed: int) -> Diagnosis:
    """Steps of amplitude on a spring and a dashpot, which grows half way through the second recording."""
    rng = np.random.default_rng([seed, 57])
    t = np.arange(round(RATE * SECONDS)) / RATE
    recordings = []
    for place, frequency in enumerate(FREQUENCIES):
        level = np.interp(t, [0, 1, 5, 6, 9, 10, 13, 14], [0, 0.5, 0.5, 1, 1, 0.7, 0.7, 0])
        x = 6.0 / (1 + 0.3 * place) * level * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        damping = np.where((place == 1) & (t > SECONDS / 2), 1 + more, 1)
        force = 10 * x + 0.3 * damping * v
        noise = 0.4 * rng.normal(size=t.size)
        recordings.append(Recording(t, x, force + noise, velocity=v, name=f"steps {place}"))
    return diagnose(recordings, base="kelvin_voigt", seed=1)


@pytest.mark.parametrize("seed", range(2))
def test_a_damping_that_changes_in_one_recording_is_unexplained(seed: int) -> None:
    found = campaign(0.4, seed)
    assert found.verdict != "adequate", found
    assert "steps 1" in found.where[0]["what"]


@pytest.mark.parametrize("seed", range(3))
def test_without_the_change_nothing_is_missing(seed: int) -> None:
    assert campaign(0.0, seed).verdict == "adequate"
