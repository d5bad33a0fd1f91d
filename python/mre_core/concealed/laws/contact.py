"""Slip near the middle, free play and stops."""

from dataclasses import replace

import numpy as np

from ..devices import Device, Parts, bouc_wen_flow
from ..kinematics import Array
from ..law import Altered, Gap, Law, Response, Rig, Series, added, law, softening
from ..paths import followed, played
from ..track import Track


@law("pinching", "slip")
def slip(rng: np.random.Generator, rig: Rig) -> Law:
    """The elastic force is reduced around the middle position."""
    width = rig.stroke * float(rng.uniform(0.1, 0.3))

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * np.exp(-((track.x / width) ** 2))

    return softening({"width": width}, act, largest=1.0)


@law("pinching", "slip_whole")
def slip_whole(rng: np.random.Generator, rig: Rig) -> Law:
    width = rig.stroke * float(rng.uniform(0.1, 0.3))

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size / (1 + (track.x / width) ** 4)

    return softening({"width": width}, act, whole=True, largest=1.0)


@law("pinching", "baber_noori")
def baber_noori(rng: np.random.Generator, rig: Rig) -> Law:
    """On a Bouc-Wen base its state slips; other bases get a slipping Bouc-Wen element in parallel."""
    place, width = float(rng.uniform(0.0, 0.2)), float(rng.uniform(0.15, 0.4))
    shape = {"q_zu": place, "zeta_2": width}

    def act(device: Device, size: float) -> Device:
        return replace(device, pinch=(size, place, width))

    if rig.base == "bouc_wen":
        return Altered("zeta_1", "1", 0.3, 0.97, shape, act)
    rho, depth = 1 / (rig.stroke * float(rng.uniform(0.1, 0.3))), 0.85
    flow = bouc_wen_flow(1.0, 1.5, (depth, place, width))

    def parallel(track: Track, parts: Parts) -> Array:
        return followed(flow, track.path, rho)

    return added("k_w", "N", shape | {"rho": rho, "zeta_1": depth}, parallel)


@law("backlash", "dead_zone")
def dead_zone(rng: np.random.Generator, rig: Rig) -> Law:
    """The elastic part is reached only beyond a gap on either side."""

    def act(x: Array, size: float) -> Array:
        out: Array = np.sign(x) * np.maximum(np.abs(x) - size, 0)
        return out

    return Gap("gap", "mm", 0.05, 0.8 * rig.stroke, {}, act)


@law("backlash", "smooth_gap")
def smooth_gap(rng: np.random.Generator, rig: Rig) -> Law:
    def act(x: Array, size: float) -> Array:
        return x - size * np.tanh(x / max(size, 1e-9))

    return Gap("gap", "mm", 0.05, 0.8 * rig.stroke, {}, act)


@law("backlash", "series_play")
def series_play(rng: np.random.Generator, rig: Rig) -> Law:
    """The device is dragged with free play, so that it stands still after each reversal."""

    def act(track: Track, response: Response, size: float) -> Track:
        x = played(track.path, np.array([size]))[:, 0]
        carried = np.abs(np.abs(track.x - x) - size) < 1e-9
        return track.moved(x, np.where(carried, track.v, 0.0))

    return Series("gap", "mm", 0.02, 0.8 * rig.stroke, {}, act)


def _stop(rng: np.random.Generator, rig: Rig, power: float, sides: tuple[float, ...], unit: str) -> Law:
    gap = rig.stroke * float(rng.uniform(0.7, 0.9))

    def act(track: Track, parts: Parts) -> Array:
        total: Array = np.sum([side * np.maximum(side * track.x - gap, 0) ** power for side in sides], axis=0)
        return total

    return added("k_c", unit, {"gap": gap, "sides": float(sum(sides))}, act)


@law("end_stop", "two_sided")
def two_sided(rng: np.random.Generator, rig: Rig) -> Law:
    return _stop(rng, rig, 1.0, (1.0, -1.0), "N/mm")


@law("end_stop", "one_sided")
def one_sided(rng: np.random.Generator, rig: Rig) -> Law:
    return _stop(rng, rig, 1.0, (float(rng.choice([-1.0, 1.0])),), "N/mm")


@law("end_stop", "hertz")
def hertz(rng: np.random.Generator, rig: Rig) -> Law:
    return _stop(rng, rig, 1.5, (1.0, -1.0), "N/mm^1.5")
