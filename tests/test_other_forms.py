"""Less common forms of an effect: the name is right, the law its own, and the model as good as the noise."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from numpy.typing import NDArray
from scipy.signal import lfilter  # type: ignore[import-untyped]

Array = NDArray[np.float64]
RATE = 200.0
FINE = 20
"""Steps of the simulated device between two samples."""
NOISE = 0.4
SINES = ((8, 1.0), (3, 0.7), (6, 2.6), (5, 0.4), (2, 1.7))
"""mm and Hz."""


def _relaxing(rate: Array, h: float, tau: float) -> Array:
    """Solution of z' = rate - z / tau from rest."""
    kept = np.exp(-h / tau)
    z: Array = lfilter([tau * (1 - kept)], [1, -kept], rate)
    return z


def saturated(x: Array, v: Array, h: float) -> Array:
    """An amplifier that bends over towards 190 N."""
    force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
    shown: Array = 190 * np.tanh(force / 190)
    return shown


def box(x: Array, v: Array, h: float) -> Array:
    """A stiffness relaxes alike over the decades from 0.5 s on."""
    slow = sum(_relaxing(v, h, tau) for tau in np.geomspace(0.5, 500, 40)) / 40
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 4.0 * slow
    return force


def worn(x: Array, v: Array, h: float) -> Array:
    """Every stroke wears the springs by its square."""
    strokes = np.cumsum(np.abs(x * v)) * h
    force: Array = 0.4 * v + (8 * x + 10 * np.sinh(0.3 * x)) / (1 + strokes / 6000)
    return force


def campaign(force: Callable[[Array, Array, float], Array]) -> list[Recording]:
    """Sines from rest, 10 s each."""
    h = 1 / (RATE * FINE)
    time = np.arange(2000 * FINE) * h
    found = []
    for i, (amplitude, frequency) in enumerate(SINES):
        x = amplitude * (1 - np.exp(-((2 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        noise = NOISE * np.random.default_rng([7, i]).normal(size=2000)
        measured = force(x, v, h)[::FINE] + noise
        found.append(Recording(time[::FINE], x[::FINE], measured, velocity=v[::FINE], name=f"r{i}"))
    return found


@pytest.mark.parametrize(
    ("force", "effect", "law"),
    [
        (saturated, "force_clipping", "gradual"),
        (box, "creep", "box spectrum"),
        (worn, "cyclic_degradation", "strokes, "),
    ],
)
def test_the_law_is_named(force: Callable[[Array, Array, float], Array], effect: str, law: str) -> None:
    found = mre_core.diagnose(campaign(force), "sinh", seed=1)
    assert [one.id for one in found.effects] == [effect]
    assert found.effects[0].law.startswith(law)
    assert found.verdict == "missing_physics"
    assert found.to_dict()["effects"][0]["form"] == "exact"
    assert found.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.05)
