"""What each reading of the paper's contradictory passages does to the result.

Replica of the test at 1 A and 4 mm; gap to the exact optimum of the same box, by variable projection.
"""

import statistics
from typing import Any

import mre_core
import numpy as np
from mre_core.replica import CAMPAIGN, record
from scipy.optimize import lsq_linear, minimize_scalar

SEEDS = range(20)
READINGS: dict[str, tuple[Any, dict[str, Any]]] = {
    "MAFSA, literal (default)": (mre_core.mafsa, {}),
    "crowd counted within sight": (mre_core.mafsa, {"crowd": "visual"}),
    "no crowd test": (mre_core.mafsa, {"crowd": "none"}),
    "centre and best within sight": (mre_core.mafsa, {"neighbourhood": "visual"}),
    "one step to the first better look": (mre_core.mafsa, {"search": "step"}),
    "within sight and one step": (mre_core.mafsa, {"neighbourhood": "visual", "search": "step"}),
    "eq. 8 as an assignment": (mre_core.mafsa, {"schedule": "recursive"}),
    "AFSA": (mre_core.afsa, {}),
    "PSO": (mre_core.pso, {}),
}


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


def main() -> None:
    """Print the table."""
    recording = record(CAMPAIGN[4], seed=1)
    problem = mre_core.Problem(recording, "sinh")
    best = exact_optimum(problem, recording)
    print(f"exact optimum {best:.6g} N^2; {len(SEEDS)} seeds each\n")
    print("| reading | median gap | largest gap | evaluations | search | swarm | follow | random |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    for name, (algorithm, options) in READINGS.items():
        runs = [algorithm(problem, seed=seed, **options) for seed in SEEDS]
        gaps = [100 * (run.fitness / best - 1) for run in runs]
        median = statistics.median(run.nfev for run in runs)
        fired = [round(statistics.mean(run.behaviours[b] for run in runs)) for b in runs[0].behaviours]
        cells = [f"{statistics.median(gaps):.3f} %", f"{max(gaps):.2f} %", f"{median:.0f}", *map(str, fired)]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
