"""Hysteretic devices at forty samples a second: what a path between samples misses stays in their state."""

from collections.abc import Callable

import numpy as np
import pytest
from mre_core import Recording, diagnose
from test_sharp_corners import FINER, hysteretic

Array = np.ndarray
Motion = Callable[[np.random.Generator], tuple[Array, Array]]

RATE = 40.0


def cosine_ramps(rng: np.random.Generator) -> tuple[Array, Array]:
    """Time, and displacement on a finer grid, of ramps that start and end with a jump of the acceleration."""
    step = 1 / RATE / FINER
    t = np.arange(round(50 / step) + 1) * step
    x, level = np.zeros(t.size), 0.0
    for place in np.arange(0.7, 47.0, 1.6):
        new = rng.uniform(-4, 4)
        x += (new - level) * (0.5 - 0.5 * np.cos(np.pi * np.clip((t - place) / 0.61, 0, 1)))
        level = new
    return t[::FINER], x


def rounded_cycles(_: np.random.Generator) -> tuple[Array, Array]:
    """Triangles of rising and falling size whose corners are rounded over three samples."""
    step = 1 / RATE / FINER
    t = np.arange(round(60 / step) + 1) * step
    sizes = np.repeat([1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 2, 2, 1, 1], 2) * np.tile([1.0, -1.0], 14)
    corners = 0.5 + 1.9 * np.arange(1, 29)
    places = np.concatenate([[0.0, 0.5], corners, [corners[-1] + 0.95, 100.0]])
    sharp = np.interp(t, places, np.concatenate([[0.0, 0.0], sizes, [0.0, 0.0]]))
    width = round(0.08 / step)
    before = np.concatenate([np.zeros(width), sharp])
    return t[::FINER], np.convolve(before, np.full(width, 1 / width), "valid")[: t.size]


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
def test_nothing_is_missing(motion: Motion, given: bool, seed: int) -> None:
    rng = np.random.default_rng([131, seed])
    t, fine = motion(rng)
    x, v = fine[::FINER], np.gradient(fine, t[1] / FINER)[::FINER]
    force = 5 * x + 20 * hysteretic(fine) + 0.5 * v
    noise = 0.002 * np.std(force) * rng.normal(size=t.size)
    recorded = {"velocity": v} if given else {}
    found = diagnose(Recording(t, x, force + noise, name="coarse", **recorded), base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found
