"""A stiffness that oscillates passes for noise, but in step with the motion it is a line."""

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording
from numpy.typing import NDArray
from scipy.signal import lfilter  # type: ignore[import-untyped]

RATE, SECONDS, FREQUENCY = 100.0, 25.0, 0.83


def random_motion(rng: np.random.Generator) -> tuple[NDArray[np.float64], ...]:
    """Time, and the displacement and velocity of many sines to 3 Hz, from rest."""
    t = np.arange(round(RATE * SECONDS)) / RATE
    frequencies = np.arange(0.2, 3.0, 0.04)
    turns = 2 * np.pi * (np.outer(t, frequencies) + rng.uniform(size=frequencies.size))
    swell, growth = np.clip(t, 0, 1), np.where(t < 1, 1.0, 0.0)
    sines = np.sin(turns).sum(axis=1)
    slopes = (2 * np.pi * frequencies * np.cos(turns)).sum(axis=1)
    return t, swell * sines, growth * sines + swell * slopes


def coloured(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Noise like 1/f over three decades."""
    noise = np.zeros(count)
    for a in (0.5, 0.95, 0.995):
        noise += lfilter([np.sqrt(1 - a**2)], [1, -a], rng.normal(size=count + 2000))[2000:]
    return noise


def diagnosed(ripple: float, tone: float = 0.0) -> Diagnosis:
    """A spring and a dashpot whose stiffness (N/mm) or whose force channel (N) has a wave in time."""
    recordings = []
    for seed in range(4):
        rng = np.random.default_rng([seed, 57])
        t, x, v = random_motion(rng)
        phase = rng.uniform(0, 2 * np.pi)
        force = (8 + ripple * np.sin(2 * np.pi * FREQUENCY * t + phase)) * x + 0.3 * v
        force += tone * np.sin(2 * np.pi * 16.7 * t + phase) + coloured(rng, t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"random {seed}"))
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


def oscillation(found: Diagnosis) -> float:
    """Frequency in Hz at which a mismatch is said to oscillate."""
    assert found.unknown is not None
    told = {d["on"]: d["size"] for d in found.unknown["depends_on"]}
    return float(told["oscillation"])


@pytest.mark.parametrize("ripple", [0.1, 0.5])
def test_a_stiffness_that_oscillates_gets_no_name(ripple: float) -> None:
    found = diagnosed(ripple)
    assert found.verdict == "unexplained", found
    assert oscillation(found) == pytest.approx(FREQUENCY, abs=0.03)
    assert found.unknown is not None
    assert "oscillates at 0.8" in found.unknown["statement"]


def test_neither_noise_nor_a_tone_is_one() -> None:
    assert diagnosed(0.0).verdict == "adequate"
    assert diagnosed(0.0, tone=1.0).unknown is None


@pytest.mark.parametrize("tone", [3.5, 6.5])
def test_a_tone_beside_a_sine_is_none(tone: float) -> None:
    """It is half of what an oscillating stiffness is there."""
    found = diagnosed_sine(tone=tone)
    assert found.verdict == "adequate", found


def test_a_stiffness_that_oscillates_under_a_sine_gets_no_name() -> None:
    found = diagnosed_sine(ripple=0.3)
    assert found.verdict == "unexplained", found
    assert oscillation(found) == pytest.approx(FREQUENCY, abs=0.01)


def test_a_stiffness_that_oscillates_about_an_offset_gets_no_name() -> None:
    """It has a tone of its own frequency too."""
    found = about_offsets(ripple=0.05)
    assert found.verdict == "unexplained", found
    assert oscillation(found) == pytest.approx(FREQUENCY, abs=0.03)


def test_tones_about_offsets_are_none() -> None:
    assert about_offsets(tone=0.3).verdict == "adequate"


def about_offsets(ripple: float = 0.0, tone: float = 0.0) -> Diagnosis:
    """Six seconds about each of three offsets; the stiffness has a wave or the force a tone."""
    rng = np.random.default_rng(59)
    recordings = []
    for drive, amplitude, offset in ((1.19, 4.0, 3.9), (1.19, 4.7, -3.9), (2.38, 5.4, -3.9)):
        t = np.arange(600) / 100
        turn = 2 * np.pi * drive
        x, v = offset + amplitude * np.sin(turn * t), amplitude * turn * np.cos(turn * t)
        wave = np.sin(2 * np.pi * FREQUENCY * t + 2.7)
        force = (8 + ripple * wave) * x + 0.3 * v + tone * wave + 0.17 * rng.normal(size=t.size)
        recordings.append(Recording(t, x, force, velocity=v, name=f"{drive} Hz, {offset} mm"))
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


def diagnosed_sine(ripple: float = 0.0, tone: float = 0.0) -> Diagnosis:
    """Three minutes of 2 Hz on a spring and a dashpot; the stiffness has a wave or the force a tone."""
    rng = np.random.default_rng(58)
    t = np.arange(18_000) / 100
    turn = 2 * np.pi * 2.0
    x, v = 3 * np.sin(turn * t), 3 * turn * np.cos(turn * t)
    force = (8 + ripple * np.sin(2 * np.pi * FREQUENCY * t)) * x + 0.3 * v + rng.normal(size=t.size)
    force += 0.15 * np.sin(2 * np.pi * tone * t) * (tone > 0)
    return mre_core.diagnose(Recording(t, x, force, velocity=v), "kelvin_voigt", seed=1)
