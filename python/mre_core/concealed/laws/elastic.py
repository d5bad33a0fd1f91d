"""Elastic laws that the base models lack."""

import numpy as np

from ..devices import Parts
from ..kinematics import Array
from ..law import Law, Rig, added, law
from ..track import Track


@law("cubic_stiffness", "cubic")
def cubic(rng: np.random.Generator, rig: Rig) -> Law:
    sign = _sign(rng)
    return added("k_3", "N/mm^3", {"sign": sign}, lambda track, parts: sign * track.x**3)


@law("cubic_stiffness", "quintic")
def quintic(rng: np.random.Generator, rig: Rig) -> Law:
    sign = _sign(rng)
    return added("k_5", "N/mm^5", {"sign": sign}, lambda track, parts: sign * track.x**5)


@law("cubic_stiffness", "locking")
def locking(rng: np.random.Generator, rig: Rig) -> Law:
    """Stiffening towards a limit of the stroke."""
    limit = rig.stroke * float(rng.uniform(1.2, 1.8))

    def act(track: Track, parts: Parts) -> Array:
        return track.x / (1 - (track.x / limit) ** 2) - track.x

    return added("k", "N/mm", {"limit": limit}, act)


@law("cubic_stiffness", "saturating")
def saturating(rng: np.random.Generator, rig: Rig) -> Law:
    """Softening spring x / sqrt(1 + (x/L)^2)."""
    length = rig.stroke * float(rng.uniform(0.3, 0.8))
    return added(
        "k", "N/mm", {"length": length}, lambda track, parts: track.x / np.sqrt(1 + (track.x / length) ** 2)
    )


@law("asymmetric_stiffness", "quadratic")
def quadratic(rng: np.random.Generator, rig: Rig) -> Law:
    sign = _sign(rng)
    return added("k_2", "N/mm^2", {"sign": sign}, lambda track, parts: sign * track.x**2)


@law("asymmetric_stiffness", "bilinear")
def bilinear(rng: np.random.Generator, rig: Rig) -> Law:
    """Another stiffness in one direction."""
    sign = _sign(rng)
    return added("k", "N/mm", {"side": sign}, lambda track, parts: sign * np.maximum(sign * track.x, 0))


@law("asymmetric_stiffness", "quartic")
def quartic(rng: np.random.Generator, rig: Rig) -> Law:
    sign = _sign(rng)
    return added("k_4", "N/mm^4", {"sign": sign}, lambda track, parts: sign * track.x**4)


def _sign(rng: np.random.Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))
