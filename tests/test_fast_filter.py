"""A low-pass filter faster than the spacing of the samples, behind a device that turns between them."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from mre_core.concealed import effects
from numpy.typing import NDArray
from scipy.signal import lfilter  # type: ignore[import-untyped]

RATE = 200.0
FINE = 50
"""Steps of the simulated device and filter between two samples."""
SLOWNESS = 1.3e-3
"""Time constant of the filter, s: a quarter of the spacing."""
NOISE = 0.05


def hysteretic_variable(velocity: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """w' = rho (v - sigma |v| |w| w + (sigma - 1) v |w|^2), n = 2, by Heun's method."""
    rho, sigma = 0.8, 0.8

    def rate(v: float, w: float) -> float:
        return rho * (v - sigma * abs(v) * abs(w) * w + (sigma - 1) * v * w * w)

    w = np.zeros(len(velocity))
    for i in range(len(velocity) - 1):
        first = rate(velocity[i], w[i])
        w[i + 1] = w[i] + step / 2 * (first + rate(velocity[i + 1], w[i] + step * first))
    return w


@pytest.fixture(scope="module")
def recordings() -> list[Recording]:
    h = 1 / (RATE * FINE)
    decay = np.exp(-h / SLOWNESS)
    # Exact for straight lines between the steps.
    early = (1 - decay) / (h / SLOWNESS)
    channel = [1 - early, early - decay], [1, -decay]
    found = []
    for i, (amplitude, frequency) in enumerate([(2.5, 10), (6, 4), (6, 1)]):
        time = np.arange(600 * FINE) * h
        rising = 1 - np.exp(-((2 * time) ** 3))
        x = amplitude * rising * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        device = 0.05 * v + 10 * x + 20 * hysteretic_variable(v, h)
        force = lfilter(*channel, device)[::FINE]
        force = force + NOISE * np.random.default_rng([3, i]).normal(size=len(force))
        found.append(Recording(time[::FINE], x[::FINE], force, velocity=v[::FINE], name=f"r{i}"))
    return found


def test_it_is_told_from_a_delay(recordings: list[Recording]) -> None:
    others = sorted({*effects()} - {"filter_lag", "time_delay", "unknown"})
    found = mre_core.diagnose(recordings, "bouc_wen", seed=1, without=others)
    (effect,) = found.effects
    assert (effect.id, effect.law) == ("filter_lag", "force, first order")
    assert effect.indistinguishable_from == ()
    assert effect.parameters["T"].value == pytest.approx(SLOWNESS, rel=0.02)
    # What the samples alone tell of a force that turns sharply leaves several times the noise.
    assert found.fit.train_rms_after == pytest.approx(NOISE, rel=0.05)
