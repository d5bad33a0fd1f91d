"""Physics that no catalogue holds, for trials of the answer 'unknown'."""

import numpy as np
from scipy.interpolate import PchipInterpolator  # type: ignore[import-untyped]

from ..devices import Parts
from ..kinematics import TURN, Array
from ..law import Law, Rig, added, law
from ..track import Track


@law("unknown", "ripple")
def ripple(rng: np.random.Generator, rig: Rig) -> Law:
    """Cogging: a force periodic in the displacement."""
    pitch, phase = rig.stroke * float(rng.uniform(0.12, 0.3)), float(rng.uniform(0, TURN))

    def act(track: Track, parts: Parts) -> Array:
        wave: Array = np.sin(TURN * track.x / pitch + phase) - np.sin(phase)
        return wave

    return added("F", "N", {"pitch": pitch, "phase": phase}, act)


@law("unknown", "bump")
def bump(rng: np.random.Generator, rig: Rig) -> Law:
    """A ridge at one position, felt in one direction only."""
    place, width = rig.stroke * float(rng.uniform(0.1, 0.5)), rig.stroke * float(rng.uniform(0.03, 0.08))
    side = float(rng.choice([-1.0, 1.0]))

    def act(track: Track, parts: Parts) -> Array:
        ridge = side * np.exp(-(((side * track.x - place) / width) ** 2))
        felt: Array = ridge * (1 + np.tanh(side * track.v / 1.0)) / 2
        return felt

    return added("F", "N", {"place": side * place, "width": width, "side": side}, act)


@law("unknown", "viscosity")
def viscosity(rng: np.random.Generator, rig: Rig) -> Law:
    """Damping that grows with the square of the displacement."""
    return added("c_2", "N s/mm^3", {}, lambda track, parts: track.x**2 * track.v)


@law("unknown", "stiffness_walk")
def stiffness_walk(rng: np.random.Generator, rig: Rig) -> Law:
    """The stiffness changes at random, up and down, in each recording."""
    times = np.arange(0, rig.duration + 1.0, 0.8)
    courses = [PchipInterpolator(times, rng.normal(size=len(times))) for _ in range(rig.recordings)]

    def act(track: Track, parts: Parts) -> Array:
        course: Array = courses[track.index](np.clip(track.t, 0, times[-1]))
        return course * track.x

    return added("k", "N/mm", {}, act)
