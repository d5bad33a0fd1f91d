"""The fitness as an optimiser of another package sees it: over the unit box, counted, and stopped in time."""

import time

import numpy as np
from problems import Array, Case, Kernel


class TimeIsUp(Exception):
    """Raised by an objective whose run has taken long enough."""


class Objective:
    """Counts evaluations and keeps the best one, whatever the optimiser makes of it."""

    def __init__(self, case: Case, kernel: Kernel, limit: float) -> None:
        self.dimension = case.dimension
        self.evaluations = 0
        self.best = np.inf
        self._case, self._kernel = case, kernel
        self._end = time.perf_counter() + limit

    def batch(self, unit: Array) -> Array:
        """Costs of candidates, shape (n, d) to (n,)."""
        if time.perf_counter() > self._end:
            raise TimeIsUp
        costs = self._kernel(self._case.physical(np.asarray(unit)))
        self.evaluations += len(costs)
        self.best = min(self.best, float(costs.min()))
        return costs

    def one(self, unit: Array) -> float:
        """Cost of one candidate, shape (d,)."""
        return float(self.batch(np.asarray(unit)[None])[0])
