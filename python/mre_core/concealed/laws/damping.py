"""Dampers whose force is no linear function of the velocity, and a mass on a flexible fixture."""

import numpy as np

from ..devices import Parts
from ..filters import second_order
from ..kinematics import Array
from ..law import Law, Rig, added, law
from ..track import Track


def _power(exponent: float) -> Law:
    def act(track: Track, parts: Parts) -> Array:
        return np.sign(track.v) * np.abs(track.v) ** exponent

    return added("c", "N (s/mm)^p", {"p": exponent}, act)


@law("quadratic_damping", "quadratic")
def quadratic(rng: np.random.Generator, rig: Rig) -> Law:
    return _power(2.0)


@law("quadratic_damping", "power_1.7")
def orifice(rng: np.random.Generator, rig: Rig) -> Law:
    return _power(1.7)


@law("quadratic_damping", "root")
def root(rng: np.random.Generator, rig: Rig) -> Law:
    return _power(0.5)


@law("quadratic_damping", "cubic")
def cubic(rng: np.random.Generator, rig: Rig) -> Law:
    return _power(3.0)


@law("inertia", "mass")
def mass(rng: np.random.Generator, rig: Rig) -> Law:
    return added("m", "N s^2/mm", {}, lambda track, parts: track.a)


@law("inertia", "flexible_mass")
def flexible_mass(rng: np.random.Generator, rig: Rig) -> Law:
    """A mass between device and load cell that rings at the fixture's own frequency."""
    frequency, damping = float(rng.uniform(25, 60)), float(rng.uniform(0.03, 0.15))

    def act(track: Track, parts: Parts) -> Array:
        return second_order(track.a, track.h, frequency, damping)

    return added("m", "N s^2/mm", {"frequency": frequency, "damping": damping}, act)
