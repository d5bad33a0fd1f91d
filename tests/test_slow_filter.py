"""A low-pass filter of tens of milliseconds on the force: no delay, though at 1 Hz much like one."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from scipy.signal import butter, lfilter  # type: ignore[import-untyped]

RATE = 200.0
FINE = 40
"""Steps of the simulated device and filter between two samples."""
STEP = 1 / (RATE * FINE)
NOISE = 0.3

Filter = tuple[np.ndarray, np.ndarray]


def first_order(slowness: float) -> Filter:
    """A filter of this time constant in s."""
    decay = np.exp(-STEP / slowness)
    return np.array([1 - decay]), np.array([1, -decay])


def butterworth(corner: float) -> Filter:
    """One of this corner frequency in Hz."""
    over, under = butter(2, corner, fs=1 / STEP)
    return over, under


def filtered(*filters: Filter) -> list[Recording]:
    """Three sines of the sinh model from rest, the force through filters in a row."""
    recordings = []
    for i, (amplitude, frequency) in enumerate([(8, 1), (4, 1), (6, 3)]):
        time = np.arange(2000 * FINE) * STEP
        x = amplitude * (1 - np.exp(-((2 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
        for each in filters:
            force = lfilter(*each, force)
        force = force[::FINE]
        force = force + NOISE * np.random.default_rng([1, i]).normal(size=len(force))
        recordings.append(Recording(time[::FINE], x[::FINE], force, velocity=v[::FINE], name=f"r{i}"))
    return recordings


@pytest.mark.parametrize(
    ("filters", "law", "sizes"),
    [
        ([first_order(0.03)], "first order", [0.03]),
        ([first_order(0.02), first_order(0.006)], "two of first order", [0.006, 0.02]),
        ([butterworth(9.0)], "Butterworth", [9.0]),
    ],
)
def test_a_slow_filter_is_named_with_its_size(filters: list[Filter], law: str, sizes: list[float]) -> None:
    found = mre_core.diagnose(filtered(*filters), "sinh", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("filter_lag", f"force, {law}")]
    assert found.verdict == "missing_physics"
    fitted = found.effects[0].parameters.values()
    assert {size.unit for size in fitted} == {"Hz" if law == "Butterworth" else "s"}
    assert sorted(size.value for size in fitted) == pytest.approx(sizes, rel=0.05)
