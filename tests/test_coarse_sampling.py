"""Hysteretic devices under ramps and cycles with kinks: what a path misses of them stays in their state."""

from collections.abc import Callable

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]
from test_sharp_corners import FINER, hysteretic

Array = np.ndarray
Motion = Callable[[np.random.Generator, float], tuple[Array, Array]]


def grid(rate: float, seconds: float) -> tuple[Array, float]:
    """Times finer than the samples, and their step."""
    step = 1 / rate / FINER
    return np.arange(round(seconds / step) + 1) * step, step


def cosine_ramps(rng: np.random.Generator, rate: float) -> tuple[Array, Array]:
    """Time, and displacement on a finer grid, of ramps that start and end with a jump of the acceleration."""
    t, _ = grid(rate, 50)
    x, level = np.zeros(t.size), 0.0
    for place in np.arange(0.7, 47.0, 1.6):
        new = rng.uniform(-4, 4)
        x += (new - level) * (0.5 - 0.5 * np.cos(np.pi * np.clip((t - place) / 0.61, 0, 1)))
        level = new
    return t[::FINER], x


def rounded_cycles(_: np.random.Generator, rate: float) -> tuple[Array, Array]:
    """Triangles of rising and falling size whose corners are rounded over three samples at 40 Hz."""
    t, step = grid(rate, 60)
    sizes = np.repeat([1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 2, 2, 1, 1], 2) * np.tile([1.0, -1.0], 14)
    corners = 0.5 + 1.9 * np.arange(1, 29)
    places = np.concatenate([[0.0, 0.5], corners, [corners[-1] + 0.95, 100.0]])
    sharp = np.interp(t, places, np.concatenate([[0.0, 0.0], sizes, [0.0, 0.0]]))
    width = round(0.08 / step)
    before = np.concatenate([np.zeros(width), sharp])
    return t[::FINER], np.convolve(before, np.full(width, 1 / width), "valid")[: t.size]


def lagging_triangle(_: np.random.Generator, rate: float) -> tuple[Array, Array]:
    """A triangle behind a lag of the first order: a jump of the acceleration at each corner."""
    t, step = grid(rate, 60)
    share = step / (0.08 + step)
    sharp = 3 * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * 0.35 * t))
    return t[::FINER], np.asarray(lfilter([share], [1, share - 1], sharp))


def device(fine: Array, t: Array, rng: np.random.Generator, noise: list[float]) -> tuple[Array, Array]:
    """Velocity, and force with noise through a filter of these coefficients."""
    x, v = fine[::FINER], np.gradient(fine, t[1] / FINER)[::FINER]
    force = 5 * x + 20 * hysteretic(fine) + 0.5 * v
    return v, force + np.std(force) * lfilter(noise[:1], [1, *noise[1:]], rng.normal(size=t.size))


@pytest.mark.parametrize(
    ("motion", "given", "seed"),
    [
        (cosine_ramps, True, 2),
        (cosine_ramps, False, 1),
        (cosine_ramps, False, 2),
        (rounded_cycles, False, 0),
        (rounded_cycles, False, 1),
        (rounded_cycles, False, 3),
    ],
)
def test_nothing_is_missing_at_few_samples(motion: Motion, given: bool, seed: int) -> None:
    rng = np.random.default_rng([131, seed])
    t, fine = motion(rng, 40.0)
    v, force = device(fine, t, rng, [0.002])
    recorded = {"velocity": v} if given else {}
    found = diagnose(Recording(t, fine[::FINER], force, name="coarse", **recorded), base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize(
    ("motion", "rate", "noise"),
    [
        (cosine_ramps, 100.0, 2e-3),
        (cosine_ramps, 250.0, 2e-3),
        (lagging_triangle, 100.0, 3e-4),
        (lagging_triangle, 250.0, 2e-3),
    ],
)
def test_nothing_is_missing_beside_noise_of_the_displacement(
    motion: Motion, rate: float, noise: float
) -> None:
    """A play as large as the noise of the displacement would hold the state where the motion rests."""
    rng = np.random.default_rng([161, 0])
    t, fine = motion(rng, rate)
    _, force = device(fine, t, rng, [0.0024, -0.6])
    x = fine[::FINER]
    seen = x + noise * np.abs(x).max() * rng.normal(size=t.size)
    found = diagnose(Recording(t, seen, force, name="noisy"), base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found


def test_a_play_well_beyond_the_noise_is_named() -> None:
    rng = np.random.default_rng([171, 0])
    t, fine = cosine_ramps(rng, 100.0)
    noise = 5e-4 * np.abs(fine).max()
    gap, played, place = 10 * noise, np.empty_like(fine), 0.0
    for i, x in enumerate(fine):
        place = max(x - gap, min(x + gap, place))
        played[i] = place
    _, force = device(played, t, rng, [0.0024, -0.6])
    seen = fine[::FINER] + noise * rng.normal(size=t.size)
    found = diagnose(Recording(t, seen, force, name="play"), base="bouc_wen", seed=1)
    plays = [effect.parameters["g"].value for effect in found.effects if effect.id == "backlash"]
    assert len(plays) == 1 and abs(plays[0] / gap - 1) < 0.2, found
