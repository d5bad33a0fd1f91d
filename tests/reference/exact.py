"""The global optimum of the sinh model over a box, by means that have nothing to do with swarms.

For a fixed beta the force is linear in c0, k0, alpha and F0 (variable projection).
"""

import numpy as np
from mre_core import Problem, Recording
from scipy.optimize import lsq_linear, minimize_scalar  # type: ignore[import-untyped]


def sinh_optimum(recording: Recording, problem: Problem) -> float:
    """Smallest mean squared error in N^2: a fine grid over beta, refined around its best points."""
    assert recording.force is not None
    force = recording.force
    x, v = recording.displacement, recording.velocity
    lower, upper = problem.lower, problem.upper
    linear = [0, 1, 2, 4]

    def error(beta: float) -> float:
        columns = np.column_stack([v, x, np.sinh(beta * x), np.ones_like(x)])
        # Columns of one size: sinh grows by orders of magnitude over the grid.
        size = np.linalg.norm(columns, axis=0)
        found = lsq_linear(
            columns / size, force, (lower[linear] * size, upper[linear] * size), method="bvls", tol=1e-14
        )
        return float(np.mean((columns / size @ found.x - force) ** 2))

    grid = np.linspace(lower[3], upper[3], 201)
    errors = np.array([error(beta) for beta in grid])
    best = float(errors.min())
    for i in np.argsort(errors)[:5]:
        ends = (float(grid[max(i - 1, 0)]), float(grid[min(i + 1, len(grid) - 1)]))
        best = min(
            best, float(minimize_scalar(error, bounds=ends, method="bounded", options={"xatol": 1e-9}).fun)
        )
    return best
