"""How the magnetic field follows the current, and how the device follows the field."""

from collections.abc import Callable

import numpy as np

from ..devices import Parts
from ..filters import lag, second_order
from ..kinematics import Array
from ..law import Field, Law, Rig, Scaled, law
from ..paths import Path, played
from ..track import Track


@law("field_lag", "first_order")
def first_order(rng: np.random.Generator, rig: Rig) -> Law:
    def act(track: Track, size: float) -> Array:
        return lag(track.current / size, track.h, size, float(track.current[0]))

    return Field("tau", "s", 0.03, 1.0, {}, act)


@law("field_lag", "second_order")
def coil(rng: np.random.Generator, rig: Rig) -> Law:
    damping = float(rng.uniform(0.6, 1.2))

    def act(track: Track, size: float) -> Array:
        return second_order(track.current, track.h, 1 / (2 * np.pi * size), damping)

    return Field("1/w", "s", 0.03, 1.0, {"damping": damping}, act)


@law("field_remanence", "largest_current")
def largest_current(rng: np.random.Generator, rig: Rig) -> Law:
    """A share of the largest past current stays as the current falls."""

    def act(track: Track, size: float) -> Array:
        return track.current + size * (np.maximum.accumulate(track.current) - track.current)

    return Field("share", "1", 0.1, 0.9, {}, act)


@law("field_remanence", "preisach")
def preisach(rng: np.random.Generator, rig: Rig) -> Law:
    """Magnetisation by play operators on the current."""
    radius = rig.largest_current * np.linspace(0.05, 0.5, 8)

    def act(track: Track, size: float) -> Array:
        rate = np.gradient(track.current, track.h)
        slow = played(Path(track.current, rate, track.h), radius) + np.minimum(radius, track.current[:, None])
        felt: Array = (1 - size) * track.current + size * slow.mean(axis=1)
        return felt

    return Field("share", "1", 0.1, 0.95, {}, act)


def _follows(law_of: Callable[[Array], Array], shape: dict[str, float], damping: bool) -> Law:
    def act(track: Track, parts: Parts, size: float) -> tuple[Array, Array]:
        factor = 1 + size * law_of(track.current)
        return (np.ones_like(factor), factor) if damping else (factor, np.ones_like(factor))

    return Scaled("size", "1", 0.05, 5.0, shape, act)


def _quadratic(rig: Rig) -> Callable[[Array], Array]:
    return lambda current: (current / rig.largest_current) ** 2


def _tanh(rng: np.random.Generator, rig: Rig) -> tuple[Callable[[Array], Array], dict[str, float]]:
    saturation = rig.largest_current * float(rng.uniform(0.2, 0.5))
    return lambda current: np.tanh(current / saturation), {"I_s": saturation}


@law("field_dependence", "quadratic")
def quadratic(rng: np.random.Generator, rig: Rig) -> Law:
    return _follows(_quadratic(rig), {"I_ref": rig.largest_current}, False)


@law("field_dependence", "tanh")
def saturating(rng: np.random.Generator, rig: Rig) -> Law:
    return _follows(*_tanh(rng, rig), False)


@law("field_dependence", "damping_quadratic")
def damping_quadratic(rng: np.random.Generator, rig: Rig) -> Law:
    return _follows(_quadratic(rig), {"I_ref": rig.largest_current}, True)


@law("field_dependence", "damping_tanh")
def damping_tanh(rng: np.random.Generator, rig: Rig) -> Law:
    return _follows(*_tanh(rng, rig), True)
