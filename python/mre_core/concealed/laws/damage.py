"""Softening that does not recover: by the largest strain, by travel and energy, and at one moment."""

import numpy as np
from scipy.special import erf  # type: ignore[import-untyped]

from ..devices import Parts
from ..kinematics import Array
from ..law import Law, Rig, law, softening
from ..track import Track


def _energy(track: Track, parts: Parts) -> Array:
    """Stored elastic energy by the fourth-order trapezoid rule along the motion, zero at the start."""
    power = parts.elastic * track.v
    return np.maximum(_integral(power, track.h), 0)


def _integral(rate: Array, h: float) -> Array:
    slope = np.gradient(rate, h)
    steps = h / 2 * (rate[1:] + rate[:-1]) - h**2 / 12 * (slope[1:] - slope[:-1])
    return np.concatenate([[0.0], np.cumsum(steps)])


def _ogden_roxburgh(rng: np.random.Generator, rig: Rig, whole: bool) -> Law:
    reference = rig.stiffness * rig.stroke**2 / 2
    m, spread = reference * rig.log(rng, 0.05, 0.3), float(rng.uniform(0.0, 0.3))

    def act(track: Track, parts: Parts, size: float) -> Array:
        energy = _energy(track, parts)
        largest = np.maximum.accumulate(energy)
        factor: Array = 1 - size * erf((largest - energy) / (m + spread * largest))
        return factor

    return softening({"m": m, "beta": spread}, act, whole=whole)


@law("mullins_softening", "ogden_roxburgh")
def ogden_roxburgh(rng: np.random.Generator, rig: Rig) -> Law:
    return _ogden_roxburgh(rng, rig, False)


@law("mullins_softening", "ogden_roxburgh_whole")
def ogden_roxburgh_whole(rng: np.random.Generator, rig: Rig) -> Law:
    return _ogden_roxburgh(rng, rig, True)


def _largest(track: Track) -> Array:
    return np.maximum.accumulate(np.abs(track.x))


@law("mullins_softening", "exponential")
def exponential(rng: np.random.Generator, rig: Rig) -> Law:
    """The whole elastic curve falls with the largest strain so far, towards a floor."""
    length = rig.stroke * float(rng.uniform(0.3, 0.8))

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * -np.expm1(-_largest(track) / length)

    return softening({"length": length}, act)


@law("mullins_softening", "linear")
def linear(rng: np.random.Generator, rig: Rig) -> Law:
    stroke = rig.stroke

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * (_largest(track) - np.abs(track.x)) / stroke

    return softening({"stroke": stroke}, act)


@law("mullins_softening", "power")
def power(rng: np.random.Generator, rig: Rig) -> Law:
    """Reloading below the largest strain follows a power of the share of it."""
    exponent = float(rng.uniform(0.7, 2.0))

    def act(track: Track, parts: Parts, size: float) -> Array:
        share = np.abs(track.x) / np.maximum(_largest(track), 1e-9)
        return 1 - size * (1 - share) ** exponent

    return softening({"exponent": exponent}, act)


def _path_life(rig: Rig, rng: np.random.Generator) -> float:
    return rig.speed * rig.duration * float(rng.uniform(0.05, 0.3))


def _by_path(rng: np.random.Generator, rig: Rig, whole: bool) -> Law:
    life = _path_life(rig, rng)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * -np.expm1(-track.path.travelled / life)

    return softening({"path": life}, act, whole=whole)


@law("cyclic_degradation", "path")
def path(rng: np.random.Generator, rig: Rig) -> Law:
    return _by_path(rng, rig, False)


@law("cyclic_degradation", "path_whole")
def path_whole(rng: np.random.Generator, rig: Rig) -> Law:
    return _by_path(rng, rig, True)


@law("cyclic_degradation", "path_linear")
def path_linear(rng: np.random.Generator, rig: Rig) -> Law:
    life = rig.speed * rig.duration

    def act(track: Track, parts: Parts, size: float) -> Array:
        return np.maximum(1 - size * track.path.travelled / life, 0.05)

    return softening({"path": life}, act, largest=2.0)


@law("cyclic_degradation", "energy")
def energy(rng: np.random.Generator, rig: Rig) -> Law:
    life = rig.force * rig.speed * rig.duration * float(rng.uniform(0.005, 0.05))

    def act(track: Track, parts: Parts, size: float) -> Array:
        spent = np.maximum.accumulate(_integral((parts.viscous + parts.hysteretic) * track.v, track.h))
        return 1 - size * -np.expm1(-spent / life)

    return softening({"energy": life}, act)


@law("cyclic_degradation", "cycles")
def cycles(rng: np.random.Generator, rig: Rig) -> Law:
    """Degradation by the number of passed reversals, weighted with the square of their stroke."""
    life = float(rng.uniform(3, 15)) * rig.stroke**2

    def act(track: Track, parts: Parts, size: float) -> Array:
        work = _integral(np.abs(track.x * track.v), track.h)
        return 1 / (1 + size * work / life)

    return softening({"x^2": life}, act, largest=10.0)


def _jump(rng: np.random.Generator, rig: Rig, ramp: float, struck: int, whole: bool) -> Law:
    moment = rig.duration * float(rng.uniform(0.3, 0.7))

    def act(track: Track, parts: Parts, size: float) -> Array:
        if track.index != struck:
            return np.full_like(track.x, 1 - size * (track.index > struck))
        if ramp == 0:
            return np.where(track.t >= moment, 1 - size, 1.0)
        return 1 - size * np.clip((track.t - moment) / ramp, 0, 1)

    return softening({"moment": moment, "recording": float(struck)}, act, whole=whole)


@law("stiffness_jump", "step")
def step(rng: np.random.Generator, rig: Rig) -> Law:
    """In the last recording, so that nobody has to say what state a later one starts from."""
    return _jump(rng, rig, 0.0, rig.recordings - 1, False)


@law("stiffness_jump", "ramp")
def ramp(rng: np.random.Generator, rig: Rig) -> Law:
    return _jump(rng, rig, 0.05, rig.recordings - 1, False)


@law("stiffness_jump", "lasting")
def lasting(rng: np.random.Generator, rig: Rig) -> Law:
    """In a recording in the middle of the campaign; the later ones stay changed."""
    return _jump(rng, rig, 0.0, rig.recordings // 2, False)


@law("stiffness_jump", "whole")
def jump_whole(rng: np.random.Generator, rig: Rig) -> Law:
    return _jump(rng, rig, 0.0, rig.recordings - 1, True)
