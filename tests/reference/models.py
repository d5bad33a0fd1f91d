"""Plain twins of the models, the velocity and the fitness: slow, scalar, written from the equations."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import NDArray
from scipy.optimize import brentq  # type: ignore[import-untyped]

Array = NDArray[np.float64]
Levels = Sequence[tuple[float | None, Sequence[float]]]

# Table 2 of Yu, Li, Li (ISARC 2014): 0 A, 1 Hz, 2 mm; c0, k0, alpha, beta, F0.
TABLE_2 = (0.354, 3.572, 4.579, 0.302, 0.001)

# Sub-steps of one interval beyond which a candidate counts as impossible to simulate.
MOST_SUBSTEPS = 1000


@dataclass(frozen=True)
class Motion:
    """Displacement in mm and its exact velocity in mm/s over the time in s."""

    time: Array
    displacement: Array
    velocity: Array

    def __len__(self) -> int:
        return len(self.time)


def sine(amplitude: float, frequency: float, rate: float, duration: float) -> Motion:
    t = np.arange(round(rate * duration)) / rate
    omega = 2.0 * math.pi * frequency
    return Motion(t, amplitude * np.sin(omega * t), amplitude * omega * np.cos(omega * t))


def multisine(seed: int, peak: float, frequencies: Array, time: Array) -> Motion:
    """Sines of falling amplitude and random phase, scaled to a peak displacement."""
    phases = np.random.default_rng(seed).uniform(0.0, 2.0 * math.pi, len(frequencies))
    x, v = np.zeros(len(time)), np.zeros(len(time))
    for frequency, phase in zip(frequencies, phases, strict=True):
        omega = 2.0 * math.pi * frequency
        x += np.sin(omega * time + phase) / frequency
        v += omega * np.cos(omega * time + phase) / frequency
    scale = peak / np.abs(x).max()
    return Motion(time, scale * x, scale * v)


def jittered(seed: int, rate: float, duration: float) -> Array:
    """Increasing times, each up to 0.3 sampling periods away from its place."""
    n = round(rate * duration)
    away = np.random.default_rng(seed).uniform(-0.3, 0.3, n)
    times: Array = (np.arange(n) + away) / rate
    return times


def local_slope(time: Array, displacement: Array, half: int) -> Array:
    """Slope of the polynomial of degree 7 fitted to 2 half + 1 samples, shifted inwards at both ends."""
    n = len(time)
    v = np.empty(n)
    for i in range(n):
        first = min(max(0, i - half), n - 2 * half - 1)
        near = slice(first, first + 2 * half + 1)
        v[i] = Chebyshev.fit(time[near], displacement[near], min(7, 2 * half - 1)).deriv()(time[i])
    return v


def kelvin_voigt(p: Sequence[float], motion: Motion) -> Array:
    c0, k0, offset = p
    return np.array(
        [c0 * v + k0 * x + offset for x, v in zip(motion.displacement, motion.velocity, strict=True)]
    )


def sinh(p: Sequence[float], motion: Motion) -> Array:
    c0, k0, alpha, beta, offset = p
    return np.array(
        [
            c0 * v + k0 * x + alpha * math.sinh(beta * x) + offset
            for x, v in zip(motion.displacement, motion.velocity, strict=True)
        ]
    )


class Piece(NamedTuple):
    """A time between two samples, or a part of it, in which the velocity keeps its sign."""

    sample: int
    """The sample before."""
    velocity: Callable[[float], float]
    """By the share of the time."""
    duration: float


def pieces(motion: Motion) -> list[Piece]:
    """Between two samples the velocity is a parabola; where it turns, one piece ends and another begins.

    Where it jumps, one constant velocity follows another. Where the parabola leaves the displacement, and
    another with the same ends meets it, that one; or two constants where it would turn back.
    """
    found = []
    corners = jumps(motion)
    halves = halfway(motion)
    strays = []
    for i, half in enumerate(halves):
        v0, v1 = float(motion.velocity[i]), float(motion.velocity[i + 1])
        area = float(motion.time[i + 1] - motion.time[i]) * (v0 + 4.0 * half + v1) / 6.0
        strays.append(float(motion.displacement[i + 1] - motion.displacement[i]) - area)
    sizes = np.sort([abs(stray) for i, stray in enumerate(strays) if stray and i not in corners])
    much = 5.0 / 0.6745 * float(sizes[len(sizes) // 2]) if len(sizes) else 0.0
    for i, half in enumerate(halves):
        v0, v1 = float(motion.velocity[i]), float(motion.velocity[i + 1])
        if i not in corners and abs(strays[i]) > much:
            dt = float(motion.time[i + 1] - motion.time[i])
            mean = float(motion.displacement[i + 1] - motion.displacement[i]) / dt
            wide = 0.25 * max(abs(v0), abs(v1))
            if min(v0, v1) - wide <= mean <= max(v0, v1) + wide:
                half = 1.5 * mean - 0.25 * (v0 + v1)
                lowest = 0.25 * (math.sqrt(abs(v0)) - math.sqrt(abs(v1))) ** 2
                share = (v1 - mean) / (v1 - v0) if v1 != v0 else math.inf
                if v0 * v1 >= 0.0 and math.copysign(half, half * (v0 + v1)) < lowest and 0.0 <= share <= 1.0:
                    corners[i] = share
        if i in corners:
            dt = float(motion.time[i + 1] - motion.time[i])
            found.append(Piece(i, lambda _, v=v0: v, dt * corners[i]))  # type: ignore[misc]
            found.append(Piece(i, lambda _, v=v1: v, dt * (1.0 - corners[i])))  # type: ignore[misc]
            continue
        parabola = np.polynomial.Polynomial([v0, 4 * half - 3 * v0 - v1, 2 * v0 + 2 * v1 - 4 * half])
        dt = float(motion.time[i + 1] - motion.time[i])
        turn = float(brentq(parabola, 0.0, 1.0, xtol=1e-16, rtol=1e-15)) if v0 * v1 < 0.0 else 0.0
        ends = [0.0, turn, 1.0] if 0.0 < turn < 1.0 else [0.0, 1.0]
        for begin, end in pairwise(ends):
            known = {0.0: v0, turn: 0.0, 0.5: half, 1.0: v1} if turn else {0.0: v0, 0.5: half, 1.0: v1}

            def velocity(
                share: float,
                begin: float = begin,
                end: float = end,
                parabola: Callable[[float], float] = parabola,
                known: dict[float, float] = known,
            ) -> float:
                place = begin + share * (end - begin)
                return known[place] if place in known else float(parabola(place))

            found.append(Piece(i, velocity, dt * (end - begin)))
    return found


def substeps(rho: float, sigma: float, n: float, motion: Motion) -> list[int]:
    """Equal sub-steps of every piece."""
    rate = rho * n * max(1.0, 2.0 * sigma - 1.0)
    # Rounded up to a power of two; what is zero or beyond all numbers stays so.
    stiffness = 2.0 ** math.ceil(math.log2(rate)) if 0.0 < rate < 1e300 else rate
    counts = []
    for piece in pieces(motion):
        fastest = max(abs(piece.velocity(share)) for share in (0.0, 0.5, 1.0))
        counts.append(max(1, math.ceil(stiffness * fastest * piece.duration / 0.5)))
    return counts


def jumps(motion: Motion) -> dict[int, float]:
    """Intervals in which the velocity jumps, with the share of each that passes before."""
    t, x, v = motion.time, motion.displacement, motion.velocity
    change, largest = np.diff(v), float(np.max(np.abs(v)))
    found: dict[int, float] = {}

    def corner(i: int) -> dict[int, float]:
        share = float((v[i + 1] - (x[i + 1] - x[i]) / (t[i + 1] - t[i])) / change[i])
        return {i: min(max(share, 0.0), 1.0)} if -0.25 < share < 1.25 else {}

    def sharp(i: int, wide: int, times: float) -> bool:
        if i + wide >= len(change):
            return False
        jump = float(abs(v[i + wide] - v[i]))
        near = range(max(0, i - 2), min(len(change), i + wide + 2))
        beside = [k for k in near if not i <= k < i + wide]
        return all(float(abs(change[k])) > 0.05 * largest for k in range(i, i + wide)) and all(
            jump > times * float(abs(change[k])) for k in beside
        )

    def even(i: int, wide: int) -> bool:
        steps = np.diff(t[max(0, i - 2) : min(len(t), i + wide + 3)])
        return bool(np.all(abs(steps - (t[i + 1] - t[i])) < 0.01 * (t[i + 1] - t[i])))

    least = 12.0 * float(np.sort(np.abs(change))[len(change) // 2])
    for i in range(1, len(change)):
        wide = next((w for w, times in ((1, 4.0), (2, 8.0)) if sharp(i, w, times) and even(i, w)), 0)
        places = [corner(k) for k in range(i, i + wide)]
        stands_out = float(abs(v[i + wide] - v[i])) > least
        if wide and stands_out and all(places) and max(found, default=-1) < i:
            for place in places:
                found |= place
    return found


def halfway(motion: Motion) -> list[float]:
    """Velocity halfway between samples: the mean of the parabolas through three, where there are two.

    Where it jumps between two of the three, that parabola does not count.
    """
    t, v = motion.time, motion.velocity
    corners = jumps(motion)
    found = []
    for i in range(len(motion) - 1):
        middle, line = 0.5 * (t[i] + t[i + 1]), 0.5 * (v[i] + v[i + 1])
        values = []
        for first in (i - 1, i):
            broken = first in corners or first + 1 in corners
            if first >= 0 and first + 2 < len(motion) and not broken:
                at, three = t[first : first + 3], v[first : first + 3]
                weights = [
                    math.prod((middle - at[k]) / (at[j] - at[k]) for k in range(3) if k != j)
                    for j in range(3)
                ]
                values.append(float(np.dot(weights, three)))
        most = 0.25 * max(abs(v[i]), abs(v[i + 1]))
        away = float(np.mean(values)) - line if values else 0.0
        found.append(float(line + min(max(away, -most), most)))
    return found


def runge_kutta(slope: Callable[[float, float], float], counts: Sequence[int], motion: Motion) -> Array:
    """State from rest at every sample; `slope(velocity, state)`, and the sub-steps of every piece."""
    w = 0.0
    states = [0.0] * len(motion)
    for piece, count in zip(pieces(motion), counts, strict=True):
        h = piece.duration / count
        for j in range(count):
            begin, middle, end = (piece.velocity((j + part) / count) for part in (0.0, 0.5, 1.0))
            k1 = slope(begin, w)
            k2 = slope(middle, w + 0.5 * h * k1)
            k3 = slope(middle, w + 0.5 * h * k2)
            k4 = slope(end, w + h * k3)
            w += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        states[piece.sample + 1] = w
    return np.array(states)


def bouc_wen(p: Sequence[float], motion: Motion) -> Array:
    c0, kx, kw, rho, sigma, n, offset = p

    def slope(v: float, w: float) -> float:
        hardening = sigma * abs(v) * math.pow(abs(w), n - 1.0) * w
        return rho * (v - hardening + (sigma - 1.0) * v * math.pow(abs(w), n))

    counts = substeps(rho, sigma, n, motion)
    if max(counts) > MOST_SUBSTEPS:
        raise OverflowError("too many sub-steps")
    w = runge_kutta(slope, counts, motion)
    force: Array = c0 * motion.velocity + kx * motion.displacement + kw * w + offset
    return force


def classical_bouc_wen(
    p: tuple[float, float, float, float, float],
    n: float,
    c0: float,
    counts: Sequence[int],
    motion: Motion,
    scale: float = 1.0,
) -> Array:
    """Eq. 1 and 2 of the paper, with z, A, beta and gamma rescaled to give the same force."""
    k0, alpha, a, beta, gamma = p
    shrink = math.pow(scale, 1.0 - n)
    a, beta, gamma = a * scale, beta * shrink, gamma * shrink

    def slope(v: float, z: float) -> float:
        hardening = beta * abs(v) * math.pow(abs(z), n - 1.0) * z
        return a * v - hardening - gamma * v * math.pow(abs(z), n)

    z = runge_kutta(slope, counts, motion) / scale
    force: Array = c0 * motion.velocity + alpha * k0 * motion.displacement + (1.0 - alpha) * k0 * z
    return force


MODELS: dict[str, Callable[[Sequence[float], Motion], Array]] = {
    "kelvin_voigt": kelvin_voigt,
    "sinh": sinh,
    "bouc_wen": bouc_wen,
}


def simulate(model: str, levels: Levels, motion: Motion, current: Array | float | None = None) -> Array:
    """Force at every sample, linear in the current between the neighbouring levels."""
    if len(levels) == 1:
        return MODELS[model](levels[0][1], motion)
    rows = sorted((float("nan") if at is None else at, list(p)) for at, p in levels)
    at = [a for a, _ in rows]
    forces = [MODELS[model](p, motion) for _, p in rows]
    assert current is not None
    currents = np.broadcast_to(current, len(motion))
    out = np.empty(len(motion))
    for i, amps in enumerate(currents):
        if amps <= at[0]:
            out[i] = forces[0][i]
        elif amps >= at[-1]:
            out[i] = forces[-1][i]
        else:
            j = max(k for k in range(len(at)) if at[k] <= amps)
            share = (amps - at[j]) / (at[j + 1] - at[j])
            out[i] = (1.0 - share) * forces[j][i] + share * forces[j + 1][i]
    return out


def fitness(
    forces: Sequence[tuple[Array, Array]], scored: Sequence[tuple[int, int]], weights: Sequence[float]
) -> float:
    """H = sum w SSE / sum w n in N^2 over the scored samples of (measured, simulated) forces."""
    above = below = 0.0
    for (measured, simulated), (start, stop), weight in zip(forces, scored, weights, strict=True):
        above += weight * math.fsum((measured[i] - simulated[i]) ** 2 for i in range(start, stop))
        below += weight * (stop - start)
    return above / below
