"""Fits that solve the linear coefficients exactly (variable projection)."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, Literal, Unpack

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._core import Problem
from .checks import choice, workers
from .minimise import ON_INTERRUPT, RunOptions, check_options, draw_seed
from .results import StopReason, SwarmResult, parameters_at, to_records
from .swarms import defaults


def exact(
    problem: Problem, *, threads: int | None = None, on_interrupt: Literal["raise", "return"] = "raise"
) -> SwarmResult:
    """Find the best parameters in the box by projection, a scan of the shapes, and descent.

    For given shapes (beta; rho, sigma, n) the best coefficients in their box are known exactly, so only
    the shapes are searched: on a grid, then downhill from the best separate places of it. For
    `kelvin_voigt` there is nothing to search, for `sinh` one variable. For `bouc_wen` the grid can miss
    the best of several minima when the hysteresis is as small as the noise.

    Parameters
    ----------
    problem : Problem
        Recordings and a model.
    threads : int, optional
        All cores by default. The result does not depend on it.
    on_interrupt : {"raise", "return"}
        What Ctrl-C does.

    Returns
    -------
    SwarmResult
        With `n_evaluations` counting shapes; without history.

    References
    ----------
    Golub and Pereyra 1973, https://doi.org/10.1137/0710036
    """
    choice(on_interrupt, "on_interrupt", ON_INTERRUPT)
    found = _core.fit_exact(problem, threads=workers(threads), on_interrupt=on_interrupt)
    return _at_best(_result("exact", problem, found, 0, {}))


def hybrid(
    problem: Problem,
    *,
    seed: int | None = None,
    n_fish: int = 12,
    max_iterations: int = 15,
    try_number: int = 12,
    **run: Unpack[RunOptions],
) -> SwarmResult:
    """Search the shapes by a small MAFSA with exact coefficients, then go downhill.

    A swarm that went through all its iterations gives way to `exact` where that is better.

    Parameters
    ----------
    problem : Problem
        Recordings and a model.
    seed : int, optional
        Same seed, same result. Drawn and reported where not given.
    n_fish, max_iterations, try_number : int
        Size of the swarm, which has few variables to search; other settings as in `mafsa`.
    **run
        See `RunOptions`; budgets hold for the swarm, not for the descent and `exact` after it.

    Returns
    -------
    SwarmResult
        With `n_evaluations` counting shapes.
    """
    options = check_options("hybrid", run)
    seed = draw_seed(seed)
    settings = {
        **defaults("mafsa"),
        "n_fish": n_fish,
        "max_iterations": max_iterations,
        "try_number": try_number,
    }
    start = options.pop("x0", None)
    found = _core.fit_hybrid(problem, settings, seed, start=start, **options)
    run_through = _result("hybrid", problem, found, seed, settings)
    # Stopped before, it was not compared with `exact`.
    return _at_best(run_through) if run_through.reason is StopReason.MAX_ITERATIONS else run_through


def _at_best(found: SwarmResult) -> SwarmResult:
    """Mark a result as the best known one, unless it was interrupted."""
    return found if found.reason is StopReason.INTERRUPTED else replace(found, optimum=found.fitness)


def _result(
    algorithm: str,
    problem: Problem,
    found: tuple[NDArray[np.float64], float, int, str, dict[str, NDArray[Any]]],
    seed: int,
    settings: Mapping[str, Any],
) -> SwarmResult:
    x, fitness, evaluations, reason, history = found
    return SwarmResult(
        algorithm=algorithm,
        parameters=parameters_at(x, problem, (problem.names, problem.lower, problem.upper)),
        fitness=fitness,
        unit="N^2",
        reason=StopReason(reason),
        seed=seed,
        n_iterations=max(len(history["best"]) - 1, 0),
        n_evaluations=evaluations,
        n_failures=0,
        history=to_records(history),
        behaviours={},
        settings=settings,
    )
