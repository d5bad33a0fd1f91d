"""What SciPy can do with the structure of the sinh model: least squares for every beta."""

import mre_core
import numpy as np
from scipy.optimize import lsq_linear, minimize_scalar


def exact_optimum(problem: mre_core.Problem, recording: mre_core.Recording) -> float:
    """Global optimum of eq. 5 in the box: linear least squares for each beta, the best beta by search."""
    x, v, force = recording.displacement, recording.velocity, recording.force
    assert force is not None
    linear = [0, 1, 2, 4]
    box = (problem.lower[linear], problem.upper[linear])

    def cost(beta: float) -> float:
        columns = np.column_stack([v, x, np.sinh(beta * x), np.ones_like(x)])
        return float(2 * lsq_linear(columns, force, bounds=box, tol=1e-12).cost / len(x))

    grid = np.linspace(problem.lower[3], problem.upper[3], 200)
    costs = [cost(beta) for beta in grid]
    k = int(np.argmin(costs))
    ends = (grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)])
    refined = minimize_scalar(cost, bounds=ends, method="bounded", options={"xatol": 1e-10})
    return min(float(refined.fun), costs[k])
