"""The fixture that gives way in series with the device."""

from collections.abc import Callable

import numpy as np

from ..filters import lag
from ..kinematics import Array
from ..law import Law, Response, Rig, Series, law
from ..track import Track

GiveWay = Callable[[Array, Array, float], Array]
"""Set of the fixture (mm) under a force history, with the step (s)."""


def _solved(track: Track, response: Response, stiffness: float, give: GiveWay) -> Track:
    """Motion x_d with x_d + give(F(x_d)) = x by fixed points on the part that a stiff linear device leaves.

    A linear device c v + k x on a spring s obeys c e' + (k + s) e = c v + k x for the set e; the rest of
    the force is carried over from one round to the next.
    """
    moved = track
    set_of = np.zeros_like(track.x)
    speed = np.zeros_like(track.x)
    k, c = _tangent(track, response)
    for _ in range(40):
        force = response(moved)
        target = give(force, track.v, track.h)
        linear = c * moved.v + k * moved.x
        drive = stiffness * target - linear + c * track.v + k * track.x
        new = lag(drive / c, track.h, c / (k + stiffness), float(drive[0]) / (k + stiffness))
        speed = drive / c - new * (k + stiffness) / c
        change = float(np.max(np.abs(new - set_of)))
        set_of = new
        moved = track.moved(track.x - set_of, track.v - speed)
        if change < 1e-9 * float(np.max(np.abs(track.x))):
            break
    return moved


def _tangent(track: Track, response: Response) -> tuple[float, float]:
    """Stiffness and damping of the linear device nearest to the response."""
    matrix = np.column_stack([track.x, track.v, np.ones_like(track.x)])[::8]
    k, c, _ = np.linalg.lstsq(matrix, response(track)[::8], rcond=None)[0]
    return 1.2 * float(k), max(float(c), 1e-4 * float(k))


def _stiffness(rig: Rig, size: float) -> float:
    return rig.stiffness / size


@law("rig_compliance", "spring")
def spring(rng: np.random.Generator, rig: Rig) -> Law:
    """The size is the device's stiffness over the fixture's."""

    def act(track: Track, response: Response, size: float) -> Track:
        s = _stiffness(rig, size)
        return _solved(track, response, s, lambda force, v, h: force / s)

    return Series("k/k_r", "1", 0.05, 0.5, {"k": rig.stiffness}, act)


@law("rig_compliance", "spring_dashpot")
def spring_dashpot(rng: np.random.Generator, rig: Rig) -> Law:
    """A spring in parallel with a dashpot."""
    tau = rig.log(rng, 0.001, 0.01)

    def act(track: Track, response: Response, size: float) -> Track:
        s = _stiffness(rig, size)
        return _solved(
            track, response, s, lambda force, v, h: lag(force / (s * tau), h, tau, float(force[0]) / s)
        )

    return Series("k/k_r", "1", 0.05, 0.5, {"k": rig.stiffness, "tau": tau}, act)


@law("rig_compliance", "contact")
def contact(rng: np.random.Generator, rig: Rig) -> Law:
    """A joint that stiffens as it is loaded: set ~ F^(2/3) beyond a preload."""
    preload = 0.1 * rig.force

    def act(track: Track, response: Response, size: float) -> Track:
        s = _stiffness(rig, size)

        def give(force: Array, v: Array, h: float) -> Array:
            return np.sign(force) * ((np.abs(force) / preload + 1) ** (2 / 3) - 1) * 1.5 * preload / s

        return _solved(track, response, s, give)

    return Series("k/k_r", "1", 0.1, 0.6, {"k": rig.stiffness, "preload": preload}, act)
