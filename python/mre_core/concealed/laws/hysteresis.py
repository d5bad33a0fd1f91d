"""Rate-independent memory by several classical constructions."""

import numpy as np

from ..devices import Parts, bouc_wen_flow
from ..kinematics import Array
from ..law import Law, Rig, added, law
from ..paths import followed, played
from ..track import Track
from .friction import dahl


@law("hysteresis", "bouc_wen")
def bouc_wen(rng: np.random.Generator, rig: Rig) -> Law:
    yielding = rig.stroke * float(rng.uniform(0.08, 0.3))
    sigma, n = float(rng.uniform(0.6, 1.4)), float(rng.uniform(1.0, 2.5))

    def act(track: Track, parts: Parts) -> Array:
        return followed(bouc_wen_flow(sigma, n), track.path, 1 / yielding)

    return added("k_w", "N", {"rho": 1 / yielding, "sigma": sigma, "n": n}, act)


@law("hysteresis", "jenkins")
def jenkins(rng: np.random.Generator, rig: Rig) -> Law:
    """Prandtl-Ishlinskii: a few springs in series with sliders."""
    radius = rig.stroke * np.sort(rng.uniform(0.06, 0.5, size=4))
    weight = rng.uniform(0.5, 1.5, size=4)
    return _stops(radius, weight / weight.sum())


@law("hysteresis", "iwan")
def iwan(rng: np.random.Generator, rig: Rig) -> Law:
    """Iwan's continuous distribution of sliders, here a power law of their strengths."""
    radius = rig.stroke * (np.arange(60) + 0.5) / 60 * float(rng.uniform(0.4, 0.9))
    weight = radius ** float(rng.uniform(-0.7, 0.0))
    return _stops(radius, weight / weight.sum())


def _stops(radius: Array, weight: Array) -> Law:
    def act(track: Track, parts: Parts) -> Array:
        total = np.zeros_like(track.x)
        for chunk in np.array_split(np.arange(len(radius)), max(1, len(radius) // 10)):
            total += (track.x[:, None] - played(track.path, radius[chunk])) @ weight[chunk]
        return total

    shape = (
        {f"radius_{i}": float(r) for i, r in enumerate(radius)}
        if len(radius) < 10
        else {"radius_max": float(radius[-1])}
    )
    return added("k", "N/mm", shape, act)


@law("hysteresis", "dahl")
def large_dahl(rng: np.random.Generator, rig: Rig) -> Law:
    presliding = rig.stroke * float(rng.uniform(0.1, 0.4))
    return added("F_d", "N", {"z_y": presliding}, lambda track, parts: dahl(track, presliding))


@law("hysteresis", "davidenkov")
def davidenkov(rng: np.random.Generator, rig: Rig) -> Law:
    """Hyperbolic backbone with Masing's rules and the memory of every open reversal."""
    reference = rig.stroke * float(rng.uniform(0.15, 0.6))
    return added("F_ult", "N", {"x_r": reference}, lambda track, parts: masing(track, reference))


def _backbone(x: Array, reference: float) -> Array:
    out: Array = x / (reference + np.abs(x))
    return out


def masing(track: Track, reference: float) -> Array:
    """Force of a Masing material with the backbone x / (reference + |x|)."""
    out = np.empty_like(track.x)
    turns: list[tuple[float, float]] = []
    for part in track.path.stretches:
        if abs(part.end - part.start) == 0 and not turns:
            out[part.first : part.last] = _backbone(track.x[part.first : part.last], reference)
            continue
        points = np.append(track.x[part.first : part.last], part.end)
        force = _branch(points, part.direction, turns, reference)
        out[part.first : part.last] = force[:-1]
        turns.append((part.end, float(force[-1])))
    return out


def _branch(x: Array, direction: float, turns: list[tuple[float, float]], reference: float) -> Array:
    """Forces of a monotone motion from the last turn; closed loops are dropped from `turns`."""
    force = np.empty_like(x)
    todo = np.ones(len(x), dtype=bool)
    while turns:
        at, level = turns[-1]
        bound = turns[-2][0] if len(turns) > 1 else -at
        inside = todo & (direction * (x - bound) <= 0)
        force[inside] = level + 2 * _backbone((x[inside] - at) / 2, reference)
        todo &= ~inside
        if not todo.any():
            return force
        del turns[-2:]
    force[todo] = _backbone(x[todo], reference)
    return force
