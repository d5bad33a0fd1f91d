"""A stiffness or a gain that comes and goes at moments of its own is no noise, however much it looks so."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording, simulate
from rig import made_of, slow

RATE, SECONDS, NOISE = 200.0, 8.0, 0.25
SPRING = made_of("kelvin_voigt", {"c0": 0.3, "k0": 6.0, "F0": 0.5})

Share = Callable[[np.random.Generator, np.ndarray, np.ndarray], np.ndarray]


def moved(seed: int) -> Recording:
    """Some sines that swell for two seconds from rest."""
    rng = np.random.default_rng([seed, 1])
    t = np.arange(0.0, SECONDS, 1 / RATE)
    u = np.clip(t / 2.0, 0.0, 1.0)
    swell, growth = u**2 * (3 - 2 * u), 3 * u * (1 - u)
    turns, phases = 2 * np.pi * rng.uniform(0.5, 2.5, 4), rng.uniform(0, 2 * np.pi, 4)
    angle = np.outer(t, turns) + phases
    x, v = np.sin(angle).sum(axis=1), (turns * np.cos(angle)).sum(axis=1)
    return Recording(t, 2 * swell * x, np.zeros_like(t), velocity=2 * (growth * x + swell * v))


def steps(rng: np.random.Generator, t: np.ndarray, _: np.ndarray) -> np.ndarray:
    """Levels that change eight times, suddenly."""
    places = np.searchsorted(np.sort(rng.uniform(0, SECONDS, 8)), t)
    levels: np.ndarray = rng.uniform(-1, 1, 9)[places]
    return levels


def lost_contact(rng: np.random.Generator, t: np.ndarray, _: np.ndarray) -> np.ndarray:
    """Moments of a tenth of a second in which a part is lost."""
    share: np.ndarray = -1.0 * np.any(np.abs(t[:, None] - rng.uniform(0, SECONDS, 12)) < 0.05, axis=1)
    return share


def third_cycle(_: np.random.Generator, t: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Every third cycle is another."""
    cycle = np.concatenate([[0], np.cumsum((x[1:] > 0) & (x[:-1] <= 0))])
    return np.where(cycle % 3 == 0, 1.0, -0.5)


def diagnosed(share: Share | None, times: float, seed: int, memory: float = 0.9) -> Diagnosis:
    """A spring and a dashpot whose spring force has a share more that leaves so many times the noise."""
    recordings = []
    for k in range(5):
        motion = moved(10 * seed + k)
        rng = np.random.default_rng([seed, k])
        force = simulate(SPRING, motion)
        if share is not None:
            added = share(rng, motion.time, motion.displacement) * motion.displacement
            known = np.column_stack([motion.displacement, motion.velocity, np.ones_like(added)])
            left = added - known @ np.linalg.lstsq(known, added, rcond=None)[0]
            force = force + times * NOISE / np.sqrt(np.mean(left**2)) * added
        force = force + NOISE * slow(rng, len(force), memory)
        recordings.append(
            Recording(motion.time, motion.displacement, force, velocity=motion.velocity, name=f"r{k}")
        )
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


@pytest.mark.parametrize(
    ("share", "seed"), [(steps, 2), (lost_contact, 1), (lost_contact, 3), (third_cycle, 3)]
)
def test_it_is_seen_and_gets_no_name(share: Share, seed: int) -> None:
    found = diagnosed(share, 1.5, seed)
    assert found.verdict == "unexplained", [e.id for e in found.effects]
    assert found.unknown is not None
    assert {"moments", "time"} & {thing["on"] for thing in found.unknown["depends_on"]}


@pytest.mark.parametrize("memory", [0.0, 0.97, 0.995])
def test_steady_noise_is_noise(memory: float) -> None:
    assert diagnosed(None, 0.0, 3, memory).verdict == "adequate"
