"""What many runs of one swarm, which differ in their seeds alone, have in common."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .._core import Problem
from ..fits import exact
from ..results import SwarmResult

QUANTILES = {"smallest": 0.0, "lower": 0.1, "median": 0.5, "upper": 0.9, "largest": 1.0}
"""Names of quantiles; lower and upper hold 80 % of the runs between them."""
CLOSE = 0.01
"""Gap to the exact optimum up to which a run counts as having found it."""
SETTLED = 0.05
"""Share of the whole descent that is left when a run counts as settled: what a linear plot shows."""
CONVERGED = 0.01
"""Share of its final fitness by which a converged run still improves."""
_POINTS = 120
_ROUNDING = 1e-12
"""Share of the mean squared force below which a fitness is rounding."""


def best_known(problem: Problem) -> float:
    """Fitness at the exact optimum, or where that is as good as zero, what rounding makes of it."""
    power = np.mean([np.mean(np.square(r.force)) for r in problem.recordings if r.force is not None])
    return max(exact(problem, threads=1).fitness, float(_ROUNDING * power))


def seeds(first: int, count: int) -> list[int]:
    """Seeds of repeated runs, from the first on."""
    return [(first + i) % 2**64 for i in range(count)]


def spread(values: Sequence[float] | NDArray[Any]) -> dict[str, float]:
    """Quantiles by name."""
    return {name: float(np.quantile(np.asarray(values, float), q)) for name, q in QUANTILES.items()}


def summarise(runs: Sequence[SwarmResult], optimum: float) -> dict[str, Any]:
    """Describe the outcomes of runs.

    Parameters
    ----------
    runs : sequence of SwarmResult
        Of one algorithm with one setting on one problem.
    optimum : float
        Best fitness known for the problem, above zero.

    Returns
    -------
    dict
        Fitness (N^2), gap to the optimum as a share of it, share of runs that found it, evaluations,
        iterations and evaluations until a run has settled and has converged, mean counts of the behaviours.
    """
    settled = [_reached(run, run.fitness + SETTLED * (run.history["best"][0] - run.fitness)) for run in runs]
    converged = [_reached(run, (1 + CONVERGED) * run.fitness) for run in runs]
    gaps = np.array([run.fitness / optimum - 1 for run in runs])
    return {
        "runs": len(runs),
        "fitness": spread([run.fitness for run in runs]),
        "gap": spread(gaps),
        "found": float(np.mean(gaps <= CLOSE)),
        "evaluations": spread([run.n_evaluations for run in runs]),
        "settled": _iterations_and_evaluations(settled),
        "converged": _iterations_and_evaluations(converged),
        "behaviours": {
            name: float(np.mean([run.behaviours[name] for run in runs])) for name in runs[0].behaviours
        },
    }


def curve_by_iteration(runs: Sequence[SwarmResult]) -> dict[str, list[float]]:
    """Quantiles over the runs of the best fitness after each iteration, the initial swarm first."""
    best = np.array([run.history["best"] for run in runs])
    return {"iteration": [float(i) for i in range(best.shape[1])], **_bands(best)}


def curve_by_evaluations(runs: Sequence[SwarmResult]) -> dict[str, list[float]]:
    """Do the same after numbers of evaluations that every run reached, evenly spaced by their logarithm."""
    first = max(float(run.history["evaluations"][0]) for run in runs)
    last = min(float(run.history["evaluations"][-1]) for run in runs)
    at = np.geomspace(first, max(last, first), _POINTS)
    best = np.array([_at(run, at) for run in runs])
    return {"evaluations": at.tolist(), **_bands(best)}


def lower_share(one: Sequence[SwarmResult], other: Sequence[SwarmResult]) -> float:
    """Share of pairs, one run of each, in which the first ended lower; ties count half."""
    a = np.array([run.fitness for run in one])[:, None]
    b = np.array([run.fitness for run in other])[None, :]
    return float(np.mean((a < b) + 0.5 * (a == b)))


def in_words(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Cells of a table: median and largest gap, share that found the optimum, median evaluations."""
    gap = summary["gap"]
    return (
        f"{100 * gap['median']:.3f} %",
        f"{100 * gap['largest']:.2f} %",
        f"{100 * summary['found']:.0f} %",
        f"{summary['evaluations']['median']:.0f}",
    )


GAP_HEADER = ("median gap", "largest gap", f"within {100 * CLOSE:g} %", "evaluations")
"""Header for `in_words`."""


def _bands(best: NDArray[np.float64]) -> dict[str, list[float]]:
    return {
        name: np.quantile(best, QUANTILES[name], axis=0).tolist() for name in ("lower", "median", "upper")
    }


def _at(run: SwarmResult, evaluations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Best fitness known after given numbers of evaluations: that of the last iteration that was over."""
    places = np.searchsorted(run.history["evaluations"], evaluations + 0.5) - 1
    found: NDArray[np.float64] = run.history["best"][np.clip(places, 0, None)]
    return found


def _reached(run: SwarmResult, level: float) -> tuple[int, int]:
    """Find the iteration and evaluations after which the best fitness is at or below a level."""
    iteration = int(np.argmax(run.history["best"] <= level))
    return iteration, int(run.history["evaluations"][iteration])


def _iterations_and_evaluations(reached: Sequence[tuple[int, int]]) -> dict[str, dict[str, float]]:
    return {
        name: spread(row)
        for name, row in zip(("iteration", "evaluations"), zip(*reached, strict=True), strict=True)
    }
