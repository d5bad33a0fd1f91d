"""What the measuring chain adds: delay, lag, drift, clipping, interference."""

import numpy as np
from scipy.interpolate import CubicSpline  # type: ignore[import-untyped]

from ..devices import Parts
from ..filters import lag, second_order
from ..kinematics import TURN, Array
from ..law import Added, Channel, Late, Law, Rig, Seen, law
from ..track import Track


@law("time_delay", "force")
def force_delay(rng: np.random.Generator, rig: Rig) -> Law:
    return Late("delay", "s", 1e-3, 0.1, {}, lambda size: size)


@law("time_delay", "displacement")
def displacement_delay(rng: np.random.Generator, rig: Rig) -> Law:
    """The displacement is late, so that the force seems to lead."""
    return Late("lead", "s", 1e-3, 0.1, {}, lambda size: -size)


@law("filter_lag", "first_order")
def first_order(rng: np.random.Generator, rig: Rig) -> Law:
    def act(track: Track, force: Array, size: float) -> Array:
        return lag(force / size, track.h, size, float(force[0]))

    return Channel("tau", "s", 2e-3, 0.3, {}, act)


@law("filter_lag", "butterworth")
def butterworth(rng: np.random.Generator, rig: Rig) -> Law:
    def act(track: Track, force: Array, size: float) -> Array:
        return second_order(force, track.h, 1 / (TURN * size), float(np.sqrt(0.5)))

    return Channel("1/w_c", "s", 2e-3, 0.3, {}, act)


@law("filter_lag", "displacement")
def displacement_lag(rng: np.random.Generator, rig: Rig) -> Law:
    def act(track: Track, size: float) -> tuple[Array, Array]:
        x = lag(track.x / size, track.h, size, float(track.x[0]))
        return x, (track.x - x) / size

    return Seen("tau", "s", 2e-3, 0.3, {}, act)


def _in_each(size: str, unit: str, shape: dict[str, float], wave: list[Array], times: Array) -> Added:
    """A course of its own in each recording, by splines through given times."""
    splines = [CubicSpline(times, one) for one in wave]

    def act(track: Track, parts: Parts) -> Array:
        out: Array = splines[track.index](np.clip(track.t, 0, times[-1]))
        return out

    return Added(size, unit, 1.0, np.inf, shape, act)


def _drift_sizes(rng: np.random.Generator, rig: Rig) -> Array:
    return rng.choice([-1.0, 1.0], rig.recordings) * rng.uniform(0.5, 1.0, rig.recordings)


@law("force_drift", "linear")
def linear_drift(rng: np.random.Generator, rig: Rig) -> Law:
    times = np.linspace(0, rig.duration, 5)
    return _in_each("drift", "N", {}, [a * times / rig.duration for a in _drift_sizes(rng, rig)], times)


@law("force_drift", "exponential")
def exponential_drift(rng: np.random.Generator, rig: Rig) -> Law:
    tau = rig.duration * rig.log(rng, 0.1, 0.6)
    times = np.linspace(0, rig.duration, 400)
    return _in_each(
        "drift", "N", {"tau": tau}, [-a * np.expm1(-times / tau) for a in _drift_sizes(rng, rig)], times
    )


@law("force_drift", "random_walk")
def wandering(rng: np.random.Generator, rig: Rig) -> Law:
    times = np.linspace(0, rig.duration, 9)
    walks = [np.concatenate([[0.0], np.cumsum(rng.normal(size=8))]) / 2 for _ in range(rig.recordings)]
    return _in_each("drift", "N", {}, walks, times)


@law("force_clipping", "hard")
def hard(rng: np.random.Generator, rig: Rig) -> Law:
    """The size is the share of the peak force that is cut away."""

    def act(track: Track, force: Array, size: float) -> Array:
        level = rig.force * (1 - size)
        return np.clip(force, -level, level)

    return Channel("cut", "1", 0.2, 0.9, {"peak": rig.force}, act)


@law("force_clipping", "one_sided")
def one_sided(rng: np.random.Generator, rig: Rig) -> Law:
    side = float(rng.choice([-1.0, 1.0]))

    def act(track: Track, force: Array, size: float) -> Array:
        return side * np.minimum(side * force, rig.force * (1 - size))

    return Channel("cut", "1", 0.2, 0.9, {"peak": rig.force, "side": side}, act)


@law("force_clipping", "soft_knee")
def soft_knee(rng: np.random.Generator, rig: Rig) -> Law:
    """Linear up to a knee, then bent over into a level a quarter higher."""

    def act(track: Track, force: Array, size: float) -> Array:
        knee = rig.force * (1 - size)
        room = 0.25 * knee
        above = np.maximum(np.abs(force) - knee, 0)
        return np.sign(force) * (np.minimum(np.abs(force), knee) + room * np.tanh(above / room))

    return Channel("cut", "1", 0.2, 0.9, {"peak": rig.force}, act)


def _hum(rng: np.random.Generator, rig: Rig, line: float, shares: tuple[float, ...]) -> Law:
    phases = rng.uniform(0, TURN, (rig.recordings, len(shares)))
    sizes = rng.uniform(0.5, 1.0, rig.recordings)

    def act(track: Track, force: Array, size: float) -> Array:
        wave = np.zeros_like(force)
        for i, share in enumerate(shares):
            wave += share * np.sin(TURN * line * (i + 1) * track.t + phases[track.index, i])
        return force + size * float(sizes[track.index]) * wave

    return Channel("amplitude", "N", 0.02 * rig.force, np.inf, {"line": line}, act)


@law("mains_interference", "line_50")
def line_50(rng: np.random.Generator, rig: Rig) -> Law:
    return _hum(rng, rig, 50.0, (1.0,))


@law("mains_interference", "line_60")
def line_60(rng: np.random.Generator, rig: Rig) -> Law:
    return _hum(rng, rig, 60.0, (1.0,))


@law("mains_interference", "harmonics")
def harmonics(rng: np.random.Generator, rig: Rig) -> Law:
    """A line off its nominal frequency, with harmonics."""
    return _hum(rng, rig, 50.0 + float(rng.uniform(-0.1, 0.1)), (1.0, 0.3, 0.5))
