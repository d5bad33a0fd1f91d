"""PSO over Bouc-Wen as eq. 1 and 2 write it: eight parameters, one of them redundant."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Problem
from ..results import SwarmResult
from ..swarms import pso

_SHAPE = 2.0
"""Largest A, beta and gamma (1, mm^-n); the paper gives no bounds."""


def classical_pso(problem: Problem, *, seed: int, **options: Any) -> SwarmResult:
    """Search k0, c0, alpha, A, beta, gamma, n and F0.

    Parameters
    ----------
    problem : Problem
        A `bouc_wen` problem of one recording.
    seed : int
        Of the swarm.
    **options
        Keywords of `pso`.

    Returns
    -------
    SwarmResult
        Fitness in N^2, on the same samples as the problem's own form. Points that are not physically
        admissible (beta + gamma <= 0, or gamma outside -beta to beta) cost infinity.
    """
    upper = dict(zip(problem.names, problem.upper.tolist(), strict=True))
    lower = dict(zip(problem.names, problem.lower.tolist(), strict=True))
    box = {
        "k0": (0.0, upper["kx"]),
        "c0": (0.0, upper["c0"]),
        "alpha": (0.0, 1.0),
        "A": (0.0, _SHAPE),
        "beta": (-_SHAPE, _SHAPE),
        "gamma": (-_SHAPE, _SHAPE),
        "n": (1.0, upper["n"]),
        "F0": (lower["F0"], upper["F0"]),
    }

    def fitness(points: NDArray[np.float64]) -> NDArray[np.float64]:
        admissible, normalised = _normalise(points)
        costs = np.full(len(points), np.inf)
        if admissible.any():
            costs[admissible] = problem.fitness(normalised[admissible], threads=1)
        return costs

    return pso(fitness, box, seed=seed, **options)


def _normalise(points: NDArray[np.float64]) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Which points are admissible, and all in the form without the redundant parameter."""
    k0, c0, alpha, a, beta, gamma, n, offset = points.T
    total = beta + gamma
    admissible = (total > 0) & (a > 0) & (np.abs(gamma) <= beta)
    total, a = np.where(admissible, total, 1.0), np.where(admissible, a, 1.0)
    largest = (a / total) ** (1 / n)
    columns = (c0, alpha * k0, (1 - alpha) * k0 * largest, a / largest, beta / total, n, offset)
    return admissible & np.isfinite(largest), np.column_stack(columns)
