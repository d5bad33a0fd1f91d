"""What every swarm does: read a box and options, run, collect."""

import secrets
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Problem, Swarm
from .checks import check_text
from .errors import InputError, shown
from .results import StopReason, SwarmResult, collect

Function = Callable[[NDArray[np.float64]], ArrayLike]
Bounds = Mapping[str, tuple[float, float]] | Sequence[tuple[float, float]]
Box = tuple[list[str], NDArray[np.float64], NDArray[np.float64]]

ON_INTERRUPT = ("raise", "return")

# What makes a fish swarm AFSA, beside the settings that its function takes.
_FIXED: dict[str, dict[str, Any]] = {
    "afsa": {
        "visual_min": 0.0,
        "step_min": 0.0,
        "p": 1,
        "schedule": "constant",
        "neighbourhood": "visual",
    }
}


class RunOptions(TypedDict, total=False):
    """Options that every swarm takes."""

    x0: ArrayLike
    """Where the first fish or particle starts, shape (d,); outside the box: at the nearest bound."""
    max_evaluations: int
    """Most evaluations; kept to the last one."""
    time_limit: float
    """Most seconds; checked between generations."""
    target: float
    """Fitness that is good enough."""
    threads: int
    """Threads for a `Problem`; all cores by default. The result does not depend on it."""
    callback: Callable[[int, int, float], Any]
    """Called with (iteration, evaluations, best), for a `Problem` at most 20 times a second and once at
    the end, for a function after every generation; a true return value stops the run."""
    on_interrupt: Literal["raise", "return"]
    """What Ctrl-C does: raise KeyboardInterrupt, or return the best so far."""


def draw_seed(seed: int | None) -> int:
    """Take the seed as it is, or draw one that a person can type."""
    if seed is None:
        return secrets.randbelow(2**31)
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or not 0 <= seed < 2**64:
        raise InputError(f"seed is {shown(seed)}", wanted="a whole number from 0 to 2^64 - 1")
    return int(seed)


def check_options(function: str, run: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a run that are given, refused where no swarm knows them."""
    if unknown := sorted(set(run) - set(RunOptions.__annotations__)):
        raise TypeError(f"{function}() got an unexpected keyword argument '{unknown[0]}'")
    return {name: value for name, value in run.items() if value is not None}


def read_box(bounds: Bounds | None) -> Box:
    """Names, lower and upper bounds of a box for a function."""
    if bounds is None:
        raise InputError("bounds are missing", wanted="a pair (lower, upper) for each parameter")
    named = isinstance(bounds, Mapping)
    pairs = list(bounds.values()) if isinstance(bounds, Mapping) else list(bounds)
    names = [str(name) for name in bounds] if named else [f"x[{i}]" for i in range(len(pairs))]
    for name in names:
        check_text(name, "a name of bounds")
    if any(np.ma.is_masked(pair) for pair in pairs):
        raise InputError("bounds are masked", wanted="a pair (lower, upper) for each parameter")
    try:
        box = np.array(pairs, dtype=np.float64).reshape(len(pairs), 2)
    except (TypeError, ValueError):
        raise InputError("bounds cannot be read", wanted="a pair (lower, upper) for each parameter") from None
    return names, box[:, 0].copy(), box[:, 1].copy()


def _complete(algorithm: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    return {**settings, **_FIXED.get(algorithm, {})}


def in_box(
    algorithm: str, box: Box, seed: int, settings: Mapping[str, Any], start: ArrayLike | None
) -> Swarm:
    """Make a swarm for a function."""
    names, lower, upper = box
    complete = _complete(algorithm, settings)
    return Swarm(algorithm, complete, seed, lower=lower, upper=upper, names=names, start=start)


def minimise(
    algorithm: str,
    problem: Problem | Function,
    bounds: Bounds | None,
    seed: int | None,
    settings: Mapping[str, Any],
    run: RunOptions,
) -> SwarmResult:
    """Run a swarm on a problem or a function."""
    options = check_options(algorithm, run)
    seed = draw_seed(seed)
    start = options.pop("x0", None)
    if isinstance(problem, Problem):
        if bounds is not None:
            raise InputError("bounds are given beside a Problem", wanted="Problem(..., bounds=...)")
        box = (problem.names, problem.lower, problem.upper)
        swarm = Swarm(algorithm, _complete(algorithm, settings), seed, problem=problem, start=start)
        reason = swarm.run_problem(problem, **options)
    elif callable(problem):
        box = read_box(bounds)
        swarm = in_box(algorithm, box, seed, settings, start)
        options.pop("threads", None)  # the function runs on this thread
        reason = swarm.run_function(problem, **options)
    else:
        kind = type(problem).__name__
        raise TypeError(f"problem is a {kind}: wanted a Problem or a function of a generation")
    return collect(
        algorithm,
        swarm,
        StopReason(reason),
        problem=problem if isinstance(problem, Problem) else None,
        box=box,
        seed=seed,
        settings=settings,
    )
