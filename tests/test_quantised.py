"""A force measured in steps: the saw tooth of a steady motion repeats, and is no missing physics."""

import numpy as np
import pytest
from mre_core import Recording, diagnose


def campaign(seed: int) -> list[Recording]:
    """A repeated sine and a sweep on a sinh device, the force in steps of 3 % of its rms."""
    rng = np.random.default_rng([31, seed])
    frequency = rng.choice([1.25, 1.5, 2.0])
    largest, bend = rng.uniform(4.0, 8.0), rng.uniform(1.5, 2.5)
    t = np.arange(11_000) / 500
    start = np.minimum(1.0, t)
    motions = [
        largest * start * np.sin(2 * np.pi * frequency * t),
        0.5 * largest * start * np.sin(2 * np.pi * (0.2 * t + 0.1 * t**2)),
    ]
    recordings = []
    for name, x in zip(("sine", "sweep"), motions, strict=True):
        v = np.gradient(x, t, edge_order=2)
        force = 30 * x + 60 * largest * np.sinh(bend * x / largest) / np.sinh(bend) + 2 * v
        step = 0.03 * 50 * largest
        blurred = force + step / 14 * rng.normal(size=t.size)
        recordings.append(Recording(t, x, np.round(blurred / step) * step, name=name))
    return recordings


@pytest.mark.parametrize("seed", (3, 4, 5))
def test_steps_of_the_sensor_are_no_missing_physics(seed: int) -> None:
    found = diagnose(campaign(seed), base="sinh", seed=1)
    assert found.verdict == "adequate", found
