"""What no effect of the catalogue has gets no name, and noise of the displacement is no physics."""

from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Recording, simulate
from rig import made_of, slow

Law = Callable[[np.ndarray, np.ndarray], np.ndarray]

RATE = 200.0
SPRING = made_of("kelvin_voigt", {"c0": 0.3, "k0": 6.0, "F0": 0.5})


def moved(frequency: float, amplitude: float) -> Recording:
    """A sine that swells for two seconds from rest."""
    t = np.arange(0.0, 10.0, 1 / RATE)
    u = np.clip(t / 2.0, 0.0, 1.0)
    swell, growth = u**2 * (3 - 2 * u), 3 * u * (1 - u)
    turn = 2 * np.pi * frequency
    v = amplitude * (growth * np.sin(turn * t) + swell * turn * np.cos(turn * t))
    return Recording(t, amplitude * swell * np.sin(turn * t), np.zeros_like(t), velocity=v)


MOTIONS = [moved(f, a) for f, a in ((0.5, 4.0), (1.0, 2.0), (1.0, 6.0), (2.0, 4.0), (3.0, 2.0))]


def growing(x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Damping force that grows with the square of the displacement."""
    force: np.ndarray = x**2 * v
    return force


def diagnosed(size: float, law: Law = growing, *, shaken: float = 0.0, coloured: bool = False) -> Diagnosis:
    """A spring and a dashpot, and a further force."""
    recordings = []
    for seed, motion in enumerate(MOTIONS):
        rng = np.random.default_rng(seed)
        force = simulate(SPRING, motion) + size * law(motion.displacement, motion.velocity)
        count = len(force)
        noise = slow(rng, count, 0.97) if coloured else rng.normal(size=count)
        force = force + 0.2 * noise
        shown = motion.displacement + shaken * rng.normal(size=count)
        recordings.append(Recording(motion.time, shown, force, velocity=motion.velocity, name=f"r{seed}"))
    return mre_core.diagnose(recordings, "kelvin_voigt", seed=1)


@pytest.mark.parametrize("size", [0.003, 0.01])
def test_a_viscosity_that_grows_with_the_displacement_gets_no_name(size: float) -> None:
    found = diagnosed(size)
    assert found.verdict == "unexplained", [e.id for e in found.effects]
    assert found.unknown is not None
    assert found.unknown["depends_on"][0]["on"] == "state"


@pytest.mark.parametrize("size", [0.01, 0.1])
@pytest.mark.parametrize(
    "law", [lambda _, v: np.abs(v), lambda _, v: v**2 / 15, lambda _, v: np.maximum(v, 0) ** 2 / 15]
)
def test_a_damping_of_another_size_in_each_direction_is_no_drift(size: float, law: Law) -> None:
    found = diagnosed(size, law)
    assert [e.id for e in found.effects] == ["quadratic_damping"], found.verdict
    assert found.verdict == "missing_physics"


def test_noise_of_the_displacement_is_taken_off() -> None:
    assert diagnosed(0.0, shaken=0.003, coloured=True).verdict == "adequate"


@pytest.mark.parametrize("draw", [100, 200])
def test_a_stiffness_that_wanders_in_each_recording_on_its_own_gets_no_name(draw: int) -> None:
    recordings = []
    for place, motion in enumerate([*MOTIONS, *MOTIONS]):
        rng = np.random.default_rng(draw + place)
        knots = np.linspace(0.0, 10.0, 8)
        wander = 0.06 * np.interp(motion.time, knots, rng.normal(size=len(knots)))
        force = simulate(SPRING, motion) + wander * motion.displacement + 0.2 * slow(rng, len(wander), 0.97)
        recordings.append(
            Recording(motion.time, motion.displacement, force, velocity=motion.velocity, name=f"r{place}")
        )
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    assert found.verdict == "unexplained", [e.id for e in found.effects]
