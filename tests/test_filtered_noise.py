"""Noise behind a steep filter of the recorder: where it leaves next to none, no law is as exact as that."""

import mre_core
import numpy as np
import pytest
from missing import NOISE, SINES, record, with_series
from mre_core import Recording
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt  # type: ignore[import-untyped]

K_M, TAU = 3.0, 0.4
"""N/mm and s of the branch."""


def filtered(count: int, seed: int) -> NDArray[np.float64]:
    """N, of a filter of sixth order at a fifth of half the sampling rate."""
    white = np.random.default_rng(seed).normal(size=count + 500)
    noise = sosfilt(butter(6, 0.2, output="sos"), white)[500:]
    return np.asarray(NOISE * noise / np.std(noise))


def branch(r: Recording) -> NDArray[np.float64]:
    """A Maxwell branch by the trapezoidal rule, as many simulations take it."""
    z, step = np.zeros(len(r)), r.time[1] - r.time[0]
    for i in range(1, len(r)):
        entering = 0.5 * step * (r.velocity[i] + r.velocity[i - 1])
        z[i] = (z[i - 1] * (1 - 0.5 * step / TAU) + entering) / (1 + 0.5 * step / TAU)
    return z


def recordings(k_m: float, seed: int) -> list[Recording]:
    made = []
    for k, sine in enumerate(SINES):
        r = record(*sine)
        x, v = r.displacement, r.velocity
        force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + k_m * branch(r)
        made.append(with_series(r, force=force + filtered(len(r), 10 * seed + k)))
    return made


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_nothing_is_found_in_it(seed: int) -> None:
    assert mre_core.diagnose(recordings(0.0, seed), "sinh", seed=1).verdict == "adequate"


@pytest.mark.parametrize("seed", [4, 5])
def test_a_law_that_was_simulated_otherwise_is_named_in_it(seed: int) -> None:
    found = mre_core.diagnose(recordings(K_M, seed), "sinh", seed=1)
    assert found.verdict == "missing_physics"
    (effect,) = found.effects
    assert (effect.id, effect.law) == ("maxwell_relaxation", "one branch")
    assert effect.parameters["k_m"].value == pytest.approx(K_M, rel=0.03)
    assert effect.parameters["tau"].value == pytest.approx(TAU, rel=0.03)
