"""Motions that rest, without a recorded velocity, and slow rates: nothing is missing, nothing is found."""

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]
from test_sharp_corners import FINER, hysteretic

Array = np.ndarray


def narrow(rng: np.random.Generator, samples: int, place: float, sharpness: float) -> Array:
    """Noise of unit variance around a frequency in cycles per sample."""
    past = [1, -2 * sharpness * np.cos(2 * np.pi * place), sharpness**2]
    noise = np.asarray(lfilter([1], past, rng.normal(size=samples + 3000)))[3000:]
    return np.asarray(noise / np.std(noise))


def holds(rng: np.random.Generator, ramp: float, rate: float) -> tuple[Array, Array]:
    """Time, and displacement on a finer grid, of ramps with round ends between levels that are held."""
    step = 1 / rate / FINER
    t = np.arange(round(30 / step) + 1) * step
    x, level = np.zeros(t.size), 0.0
    for place in np.arange(1.0, 28.0, 2.5):
        new = rng.uniform(-5, 5)
        s = np.clip((t - place) / ramp, 0, 1)
        x += (new - level) * (s - np.sin(2 * np.pi * s) / (2 * np.pi))
        level = new
    return t[::FINER], x


@pytest.mark.parametrize("seed", range(3))
def test_noise_of_a_displacement_at_rest_moves_no_state(seed: int) -> None:
    rng = np.random.default_rng([61, seed])
    t, fine = holds(rng, 0.5, 120.0)
    x = fine[::FINER]
    force = 5 * x + 20 * hysteretic(fine) + 0.5 * np.gradient(x, t[1])
    noise = 0.006 * np.std(force) * lfilter([0.8], [1, -0.6], rng.normal(size=t.size))
    seen = x + 0.001 * rng.normal(size=t.size)
    found = diagnose(Recording(t, seen, force + noise, name="holds"), base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_stairs_with_round_ends_have_no_gap(seed: int) -> None:
    """Under noise whose floor beside its peak is below what the noise of the displacement does."""
    rng = np.random.default_rng([67, seed])
    t = np.arange(6000) / 160
    x, rounding = np.zeros(t.size), 0.1
    for k, place in enumerate(np.arange(0.6, 36.0, 2.2)):
        rise = 0.55 if k // 4 in (0, 3) else -0.55
        # A ramp whose slope rises and falls within the rounding.
        slopes = np.interp(t, place + np.array([0, rounding, 0.4, 0.4 + rounding]), [0, 1, 1, 0])
        x += rise * np.cumsum(slopes) / 160 / 0.4
    force = 4 * x + 4 * np.sinh(0.4 * x) + 0.5 * np.gradient(x, 1 / 160)
    noise = 0.004 * np.std(force) * narrow(rng, t.size, 0.1, 0.97)
    seen = x + 0.001 * np.abs(x).max() * rng.normal(size=t.size)
    found = diagnose(Recording(t, seen, force + noise, name="stairs"), base="sinh", seed=1)
    assert "backlash" not in [effect.id for effect in found.effects], found


@pytest.mark.parametrize("place", [0.05, 0.2])
def test_a_resonance_at_a_slow_rate_is_noise(place: float) -> None:
    """At 5 Hz a resonance takes more samples than what is as long at a usual rate."""
    rng = np.random.default_rng(71)
    recordings = []
    for k in range(2):
        t = np.arange(2000) / 5
        x = 4 * np.sin(2 * np.pi * 0.011 * t + k) * (1 + 0.3 * np.sin(2 * np.pi * 0.004 * t))
        v = np.gradient(x, 0.2)
        force = 8 * x + 0.6 * v
        noise = 0.01 * np.std(force) * narrow(rng, t.size, place, 0.99)
        recordings.append(Recording(t, x, force + noise, velocity=v, name=f"slow {k}"))
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
