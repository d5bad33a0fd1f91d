"""What noise and rounding of a displacement do to the force of a complete model is no missing physics."""

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]
from test_rests import holds, narrow
from test_sharp_corners import FINER, hysteretic

Array = np.ndarray

RINGING = 150.0
"""Samples in a second of quick releases."""


def trapezoid(t: Array, size: float, period: float, rise: float) -> Array:
    """Up in `rise`, a hold, down through zero, a hold, and up to zero again."""
    turns = np.array([0, rise, period / 2 - rise, period / 2 + rise, period - rise, period])
    return np.asarray(np.interp(t % period, turns, size * np.array([0, 1, 1, -1, -1, 0])))


@pytest.mark.parametrize(
    ("size", "period", "digits"), [(4, 5, 5), (4, 5, 3), (4, 5, 2), (4, 4.713, 5), (4, 4.713, 3)]
)
def test_flanks_and_rests_of_a_rounded_displacement_are_no_corners(
    size: float, period: float, digits: int
) -> None:
    rng = np.random.default_rng([83, digits])
    t = np.arange(4000) / 200
    x = trapezoid(t, size, period, 1.0)
    slope = (trapezoid(t + 1e-5, size, period, 1.0) - trapezoid(t - 1e-5, size, period, 1.0)) / 2e-5
    force = 3.5 * x + 0.3 * slope
    seen = force + 0.01 * np.std(force) * rng.normal(size=t.size)
    recording = Recording(t, np.round(x, digits), seen, name="trapezoid")
    found = diagnose(recording, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
    assert found.left_out["trapezoid"] < t.size / 4, found.left_out


@pytest.mark.parametrize("seed", range(3))
def test_faint_noise_of_a_displacement_beside_a_recorded_velocity_is_no_creep(seed: int) -> None:
    """A slow noise of the force has less than it from sample to sample."""
    rng = np.random.default_rng([89, seed])
    t = np.arange(4000) / 8
    turn = 2 * np.pi * 0.01
    rising = np.minimum(t / 500, 1)
    x = 4 * rising * np.sin(turn * t)
    v = 4 * (rising * turn * np.cos(turn * t) + np.sin(turn * t) / 500)
    slow = 0.0044 * lfilter([1], [1, -0.995], rng.normal(size=t.size + 3000))[3000:]
    seen = x + 1.2e-4 * rng.normal(size=t.size)
    recording = Recording(t, seen, 7.7 * x + 2 * v + slow, velocity=v, name="slow")
    found = diagnose(recording, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_where_a_noisy_triangle_turns_is_no_missing_physics(seed: int) -> None:
    """Its velocity is recorded, and the noise of the force has little beside its peak."""
    rng = np.random.default_rng([97, seed])
    recordings = []
    for k, rate in enumerate((60.0, 33.0, 21.0)):
        t = np.arange(620) / rate
        phase = t * rate / 30.5 + 0.02
        x = 4 * (1 - 4 * np.abs((phase + 0.25) % 1 - 0.5))
        v = 16 * rate / 30.5 * np.where((phase + 0.25) % 1 < 0.5, 1, -1)
        force = 0.5 * v + 9 * x + 4 * np.sinh(0.35 * x)
        noise = 0.005 * np.std(force) * narrow(rng, t.size, 0.08, 0.998)
        seen = x + 0.0025 * rng.normal(size=t.size)
        recordings.append(Recording(t, seen, force + noise, velocity=v, name=f"triangle {k}"))
    found = diagnose(recordings, base="sinh", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(4))
def test_a_state_that_turned_in_noise_and_was_held_is_no_missing_physics(seed: int) -> None:
    rng = np.random.default_rng([101, seed])
    recordings = []
    for k in range(2):
        t, fine = holds(rng, 0.4, 120.0)
        x = fine[::FINER]
        force = 5 * x + 20 * hysteretic(fine) + 0.5 * np.gradient(x, t[1])
        noise = 0.0025 * np.std(force) * rng.standard_t(3, size=t.size)
        seen = x + 0.001 * rng.normal(size=t.size)
        recordings.append(Recording(t, seen, force + noise, name=f"holds {k}"))
    found = diagnose(recordings, base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(4))
def test_what_smoothing_does_to_a_quick_release_is_no_missing_physics(seed: int) -> None:
    """Held, let go, and ringing: the acceleration jumps, and no velocity is recorded."""
    rng = np.random.default_rng([103, seed])
    recordings = []
    for k in range(3):
        turn, decay = 2 * np.pi * rng.uniform(0.8, 1.6), rng.uniform(0.4, 0.8)
        size, at = rng.uniform(3, 5), rng.uniform(2, 3)
        t = np.arange(int(RINGING * (at + 6))) / RINGING
        s = np.maximum(t - at, 0)
        left = size * np.exp(-decay * s)
        x = left * (np.cos(turn * s) + decay / turn * np.sin(turn * s))
        v = -left * (turn + decay**2 / turn) * np.sin(turn * s)
        noise = lfilter([1], [1, -0.9], rng.normal(size=t.size + 100))[100:]
        force = 8 * x + 1.5 * v
        seen = x + 6e-4 * size * rng.normal(size=t.size)
        recordings.append(Recording(t, seen, force + 0.004 * np.std(force) * noise, name=f"release {k}"))
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(2))
def test_what_a_drive_distorts_below_the_noise_is_motion(seed: int) -> None:
    """A third harmonic of less than a thousandth, which a stiff device shows and smoothing could take off."""
    rng = np.random.default_rng([101, seed])
    recordings = []
    for frequency, size in ((7.19, 1.7), (1.66, 2.3), (3.4, 1.0), (2.1, 2.8)):
        t = np.arange(5000) / 200
        turn = 2 * np.pi * frequency
        x = size * (np.sin(turn * t) + 7e-4 * np.sin(3 * turn * t + 0.7))
        v = size * turn * (np.cos(turn * t) + 21e-4 * np.cos(3 * turn * t + 0.7))
        force = 237 * x + 277 * np.sinh(0.54 * x) + 3.9 * v + 1.8 * rng.normal(size=t.size)
        seen = x + 0.003 * rng.normal(size=t.size)
        recordings.append(Recording(t, seen, force, name=f"{frequency} Hz"))
    found = diagnose(recordings, base="sinh", seed=1)
    assert found.verdict == "adequate", found
