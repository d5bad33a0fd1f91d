"""Dry friction with and without pre-sliding and velocity weakening."""

import math
from collections.abc import Callable

import numpy as np

from ..devices import Parts
from ..kinematics import Array
from ..law import Law, Rig, added, law
from ..track import Track


@law("coulomb_friction", "sign")
def sign(rng: np.random.Generator, rig: Rig) -> Law:
    return added("F_c", "N", {}, lambda track, parts: np.sign(track.v))


def dahl(track: Track, presliding: float) -> Array:
    """The share of the friction force that has built up, solved exactly along the path."""
    z = np.empty_like(track.x)
    now = 0.0
    for part in track.path.stretches:
        here, d = slice(part.first, part.last), part.direction
        z[here] = d - (d - now) * np.exp(-np.abs(track.x[here] - part.start) / presliding)
        now = d - (d - now) * float(np.exp(-abs(part.end - part.start) / presliding))
    return z


@law("coulomb_friction", "dahl")
def small_dahl(rng: np.random.Generator, rig: Rig) -> Law:
    presliding = rig.stroke * rig.log(rng, 0.001, 0.01)
    return added("F_c", "N", {"z_y": presliding}, lambda track, parts: dahl(track, presliding))


@law("coulomb_friction", "tanh")
def regularised(rng: np.random.Generator, rig: Rig) -> Law:
    slow = rig.log(rng, 0.3, 2.0)
    return added("F_c", "N", {"v_r": slow}, lambda track, parts: np.tanh(track.v / slow))


@law("coulomb_friction", "lugre")
def small_lugre(rng: np.random.Generator, rig: Rig) -> Law:
    presliding = rig.stroke * rig.log(rng, 0.001, 0.006)
    micro = rig.log(rng, 1e-5, 1e-4)

    def act(track: Track, parts: Parts) -> Array:
        z = dahl(track, presliding)
        return z + micro * (track.v - np.abs(track.v) * z) / presliding

    return added("F_c", "N", {"z_y": presliding, "sigma_1": micro}, act)


def _weakening(rng: np.random.Generator, rig: Rig) -> tuple[float, float]:
    """Static over sliding friction, and the speed of the transition."""
    return float(rng.uniform(1.4, 2.2)), rig.log(rng, 3.0, 25.0)


def _stribeck(rng: np.random.Generator, rig: Rig, fall: Callable[[Array], Array]) -> Law:
    ratio, speed = _weakening(rng, rig)

    def act(track: Track, parts: Parts) -> Array:
        return (1 + (ratio - 1) * fall(np.abs(track.v) / speed)) * np.sign(track.v)

    return added("F_c", "N", {"F_s/F_c": ratio, "v_s": speed}, act)


@law("stribeck_friction", "gaussian")
def gaussian(rng: np.random.Generator, rig: Rig) -> Law:
    return _stribeck(rng, rig, lambda r: np.exp(-(r**2)))


@law("stribeck_friction", "exponential")
def exponential(rng: np.random.Generator, rig: Rig) -> Law:
    return _stribeck(rng, rig, lambda r: np.exp(-r))


@law("stribeck_friction", "lorentzian")
def lorentzian(rng: np.random.Generator, rig: Rig) -> Law:
    return _stribeck(rng, rig, lambda r: 1 / (1 + r**2))


@law("stribeck_friction", "lugre")
def lugre(rng: np.random.Generator, rig: Rig) -> Law:
    """Bristles that follow the weakening: z' = v - |v| z / g(v), force z + sigma_1 z', z in units of F_c."""
    ratio, speed = _weakening(rng, rig)
    presliding = rig.stroke * rig.log(rng, 0.002, 0.008)

    def act(track: Track, parts: Parts) -> Array:
        level = 1 + (ratio - 1) * np.exp(-((track.v / speed) ** 2))
        z = np.empty_like(track.x)
        now = 0.0
        for part in track.path.stretches:
            here = slice(part.first, part.last)
            target = part.direction * level[here]
            path = np.abs(np.diff(track.x[here], prepend=part.start))
            before = np.concatenate([[part.direction * ratio], target[:-1]])
            z[here] = _following(now, before, target, path / presliding)
            left = abs(part.end - track.x[part.last - 1]) / presliding
            final = part.direction * ratio
            now = float(_following(z[part.last - 1], target[-1:], np.array([final]), np.array([left]))[0])
        return z

    return added("F_c", "N", {"F_s/F_c": ratio, "v_s": speed, "z_y": presliding}, act)


def _following(start: float, before: Array, after: Array, path: Array) -> Array:
    """State that relaxes to (target - z) / target_size along the path, the target linear over each step."""
    out = np.empty_like(path)
    z = start
    for i, (a, b, s) in enumerate(zip(before.tolist(), after.tolist(), path.tolist(), strict=True)):
        r = 2 * s / (abs(a) + abs(b))
        if r > 1e-12:
            decay = math.exp(-r)
            mean = (1 - decay) / r
            z = decay * z + (mean - decay) * a + (1 - mean) * b
        out[i] = z
    return out
