"""The two identification problems of the comparison."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import mre_core
import numpy as np
from mre_core.replica import CAMPAIGN
from numpy.typing import NDArray

Array = NDArray[np.float64]
Kernel = Callable[[Array], Array]
"""Candidates, shape (n, d), to their mean squared errors in N^2, shape (n,)."""

SAMPLES = 1000
RATE = 256.0
NOISE = 0.01  # of the largest force
CONDITION = CAMPAIGN[4]  # 1 A, 1 Hz, 4 mm
TRUTH: dict[str, dict[str, float]] = {
    "sinh": dict(zip(("c0", "k0", "alpha", "beta", "F0"), CONDITION.values, strict=True)),
    "bouc_wen": {"c0": 1.1, "kx": 12, "kw": 30, "rho": 0.8, "sigma": 0.7, "n": 1.3, "F0": 0},
}
LOGARITHMIC = ("rho", "n")
STEP = 0.5  # largest sub-step of RK4 times the rate of w, as in mre_core


def stiffness(rows: Array) -> Array:
    """Rate of w per mm of each Bouc-Wen candidate, rounded up to a power of two as in mre_core."""
    rho, sigma, n = rows[:, 3], rows[:, 4], rows[:, 5]
    return np.exp2(np.ceil(np.log2(rho * n * np.maximum(2 * sigma - 1, 1))))


class Intervals(NamedTuple):
    """Those from first[i] to first[i + 1] lie between samples i and i + 1."""

    first: NDArray[np.uintp]
    velocity: Array
    """At the beginning, halfway, at the end; shape (m, 3)."""
    step: Array
    demand: Array
    """Sub-steps per unit of stiffness."""


@dataclass(frozen=True)
class Case:
    """A problem of mre_core with its recording as plain arrays: mm, mm/s, N."""

    problem: mre_core.Problem
    x: Array
    v: Array
    f: Array

    @property
    def model(self) -> str:
        return self.problem.model

    @property
    def dimension(self) -> int:
        return len(self.problem.names)

    @cached_property
    def intervals(self) -> "Intervals":
        """Times between samples, cut where the velocity turns."""
        begin, end = self.v[:-1], self.v[1:]
        around = np.pad(np.diff(self.v, 2), 1, mode="edge")
        middle = 0.5 * (begin + end) - (around[:-1] + around[1:]) / 16  # cubic, at the ends quadratic
        first, velocity, step = [0], [], []
        for known in zip(begin, middle, end, strict=True):
            parabola = np.polynomial.Polynomial.fit((0, 0.5, 1), known, 2, domain=(0, 1), window=(0, 1))
            cuts = [r.real for r in parabola.roots() if 0 < r.real < 1] if known[0] * known[2] < 0 else []
            for part in pairwise((0, *cuts, 1)):
                velocity.append(parabola(np.array((part[0], sum(part) / 2, part[1]))))
                step.append((part[1] - part[0]) / RATE)
            first.append(len(step))
        speeds, steps = np.array(velocity), np.array(step)
        demand = np.maximum(abs(speeds[:, 0]), abs(speeds[:, 2])) * steps / STEP
        return Intervals(np.array([*first, len(step)], dtype=np.uintp), speeds, steps, demand)

    @cached_property
    def _scale(self) -> tuple[Array, Array, NDArray[np.intp]]:
        """Lower end and width of the box, in the logarithm where a parameter is spread so, and which are."""
        log = np.flatnonzero([name in LOGARITHMIC for name in self.problem.names])
        lower, upper = _logarithm(self.problem.lower, log), _logarithm(self.problem.upper, log)
        return lower, upper - lower, log

    def physical(self, unit: Array) -> Array:
        """From the unit box, in which every optimiser moves, to parameters; outside: the nearest bound."""
        low, width, log = self._scale
        values = low + np.minimum(np.maximum(unit, 0.0), 1.0) * width
        if len(log):
            values[..., log] = np.exp(values[..., log])
        return values

    def candidates(self, count: int, *, spread: float = 1.0) -> Array:
        """Candidates evenly at random in the box, or (spread below 1) about the truth."""
        unit = np.random.default_rng(2).random((count, self.dimension))
        low, width, log = self._scale
        middle = (_logarithm(np.array(list(TRUTH[self.model].values())), log) - low) / width
        return self.physical(unit if spread == 1.0 else middle + spread * (unit - 0.5))


def _logarithm(values: Array, where: NDArray[np.intp]) -> Array:
    result = np.array(values, dtype=float)
    result[where] = np.log(result[where])
    return result


def case(model: str, bounds: dict[str, tuple[float, float]] | None = None, samples: int = SAMPLES) -> Case:
    """A 4 mm, 1 Hz test with 1 % noise on the force, and the default box."""
    time = np.arange(samples) / RATE
    turn = 2 * np.pi
    x = CONDITION.amplitude * np.sin(turn * time)
    v = CONDITION.amplitude * turn * np.cos(turn * time)
    clean = mre_core.Recording(time, x, np.zeros(samples), velocity=v)
    truth = mre_core.Model(model, (mre_core.Level(None, TRUTH[model]),))
    f = mre_core.simulate(truth, clean)
    f = f + np.random.default_rng(1).normal(0, NOISE * float(abs(f).max()), samples)
    recording = mre_core.Recording(time, x, f, velocity=v, current=CONDITION.current, name=CONDITION.name)
    return Case(mre_core.Problem(recording, model, bounds), x, v, f)
