"""A low-pass filter of tens of milliseconds on the force: no delay, though at 1 Hz much like one."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from scipy.signal import butter, lfilter  # type: ignore[import-untyped]

RATE = 200.0
FINE = 40
"""Steps of the simulated device and filter between two samples."""
NOISE = 0.3


def filtered(law: str, slowness: float) -> list[Recording]:
    """Three sines of the sinh model from rest, the force through a filter of this time constant in s."""
    h = 1 / (RATE * FINE)
    if law == "first order":
        decay = np.exp(-h / slowness)
        filter = ([1 - decay], [1, -decay])
    else:
        filter = butter(2, 1 / (2 * np.pi * slowness), fs=1 / h)
    recordings = []
    for i, (amplitude, frequency) in enumerate([(8, 1), (4, 1), (6, 3)]):
        time = np.arange(2000 * FINE) * h
        x = amplitude * (1 - np.exp(-((2 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        force = lfilter(*filter, 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x))[::FINE]
        force = force + NOISE * np.random.default_rng([1, i]).normal(size=len(force))
        recordings.append(Recording(time[::FINE], x[::FINE], force, velocity=v[::FINE], name=f"r{i}"))
    return recordings


@pytest.mark.parametrize(
    ("law", "slowness", "unit"), [("first order", 0.03, "s"), ("Butterworth", 0.018, "Hz")]
)
def test_a_slow_filter_is_named_with_its_size(law: str, slowness: float, unit: str) -> None:
    found = mre_core.diagnose(filtered(law, slowness), "sinh", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("filter_lag", f"force, {law}")]
    assert found.verdict == "missing_physics"
    (size,) = found.effects[0].parameters.values()
    assert size.unit == unit
    wanted = slowness if unit == "s" else 1 / (2 * np.pi * slowness)
    assert size.value == pytest.approx(wanted, rel=0.02)
